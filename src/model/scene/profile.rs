//! A quantity tabulated over the radius, linear between the rows.

/// Values at ascending radii, linear between them and constant beyond the first and the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    radius_m: Vec<f64>,
    value: Vec<f64>,
}

impl Profile {
    /// The profile through rows [radius, value] with ascending radii; `None` without rows.
    pub(super) fn new(rows: &[[f64; 2]]) -> Option<Self> {
        (!rows.is_empty()).then(|| Profile {
            radius_m: rows.iter().map(|row| row[0]).collect(),
            value: rows.iter().map(|row| row[1]).collect(),
        })
    }

    /// Radii at which the slope changes.
    pub fn knots_m(&self) -> &[f64] {
        &self.radius_m
    }

    /// Value at a radius.
    pub fn at(&self, r: f64) -> f64 {
        let next = self.radius_m.partition_point(|knot| *knot < r);
        let last = self.value.len() - 1;
        match next {
            0 => self.value[0],
            _ if next > last => self.value[last],
            _ => {
                let (from, to) = (self.radius_m[next - 1], self.radius_m[next]);
                let share = (r - from) / (to - from);
                (1.0 - share) * self.value[next - 1] + share * self.value[next]
            }
        }
    }

    /// The value of largest magnitude between two radii; of equal magnitudes, the first.
    pub fn peak(&self, from: f64, to: f64) -> f64 {
        let values = self.pieces(from, to).into_iter().flatten();
        values.fold(0.0, |top: f64, r| {
            let value = self.at(r);
            if value.abs() > top.abs() { value } else { top }
        })
    }

    /// Integral ∫ f dr from one radius to a larger one.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let trapezium = |[low, high]: [f64; 2]| 0.5 * (high - low) * (self.at(low) + self.at(high));
        self.pieces(from, to).into_iter().map(trapezium).sum()
    }

    /// Integral ∫ |f| dr from one radius to a larger one.
    pub fn size(&self, from: f64, to: f64) -> f64 {
        let pieces = self.pieces(from, to).into_iter();
        pieces
            .map(|[low, high]| {
                let (start, end) = (self.at(low), self.at(high));
                let signs_differ = start * end < 0.0;
                let mean = if signs_differ {
                    // The profile f changes its sign between the ends, so that the area under |f| consists of
                    // two triangles.
                    (start * start + end * end) / (start - end).abs()
                } else {
                    (start + end).abs()
                };
                0.5 * (high - low) * mean
            })
            .sum()
    }

    /// Integral ∫ f r dr from one radius to a larger one.
    pub fn moment(&self, from: f64, to: f64) -> f64 {
        let pieces = self.pieces(from, to).into_iter();
        // Simpson's rule is exact: f r is a parabola on each piece.
        pieces
            .map(|[low, high]| {
                let middle = 0.5 * (low + high);
                let value = |r: f64| self.at(r) * r;
                (high - low) / 6.0 * (value(low) + 4.0 * value(middle) + value(high))
            })
            .sum()
    }

    /// The profile with a constant added to all values.
    pub(super) fn raised(&self, by: f64) -> Self {
        Profile {
            radius_m: self.radius_m.clone(),
            value: self.value.iter().map(|value| value + by).collect(),
        }
    }

    /// Intervals between two radii on which the profile is linear.
    fn pieces(&self, from: f64, to: f64) -> Vec<[f64; 2]> {
        let inside = self.radius_m.iter().filter(|r| from < **r && **r < to);
        let mut ends = vec![from];
        ends.extend(inside);
        ends.push(to);
        ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tent_has_the_area_and_the_moment_of_a_triangle() {
        let tent = Profile::new(&[[1.0, 0.0], [2.0, 3.0], [3.0, 0.0]]).unwrap();
        assert_eq!([tent.at(0.5), tent.at(1.5), tent.at(4.0)], [0.0, 1.5, 0.0]);
        assert!((tent.integral(0.5, 4.0) - 3.0).abs() < 1e-15);
        // Its centre of area is at r = 2.
        assert!((tent.moment(0.5, 4.0) - 6.0).abs() < 1e-14);
        assert_eq!(tent.peak(0.5, 4.0), 3.0);
        assert_eq!(tent.peak(2.5, 4.0), 1.5);
    }

    #[test]
    fn beyond_its_ends_it_is_constant() {
        let step = Profile::new(&[[1.0, -2.0], [2.0, 4.0]]).unwrap();
        assert!((step.integral(0.0, 3.0) - (-2.0 + 1.0 + 4.0)).abs() < 1e-15);
        // Between 1 and 2 the areas of two triangles are added: −2 to 0 over a third, 0 to 4 over two thirds.
        let crossing = 0.5 * (2.0 / 3.0) * (1.0 + 0.0) + 0.5 * 4.0 * (2.0 / 3.0);
        assert!((step.size(1.0, 2.0) - crossing).abs() < 1e-15);
        assert!((step.raised(2.0).at(0.0)).abs() < 1e-15);
    }
}
