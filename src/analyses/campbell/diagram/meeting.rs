//! Interpolation of two modes near their coalescence, between computed speeds.
//!
//! The square of the growth rate inside the band, and minus the square of half the difference of the angular
//! frequencies outside, are one function, which passes smoothly through zero at both ends of the band. Curves of
//! the growth that are interpolated by its square are steep at the ends, as they should be, even with few samples.

/// The square of the growth rate of a pair of modes, over the rotation speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Coalescence {
    /// First and last speed of the band in rpm.
    ends: [f64; 2],
    /// Whether the modes coalesce at each end, so that the square is zero there.
    closed: [bool; 2],
    /// Speed and square divided by `weight`, ascending by speed.
    factors: Vec<[f64; 2]>,
}

impl Coalescence {
    /// Interpolates between squares at some speeds in rpm; a square is positive within the band and negative outside.
    /// `None` for an empty band, and without a usable square.
    pub fn new(
        ends: [f64; 2],
        closed: [bool; 2],
        squares: impl IntoIterator<Item = [f64; 2]>,
    ) -> Option<Self> {
        if ends[0].is_nan() || ends[1].is_nan() || ends[0] >= ends[1] {
            return None;
        }
        let mut found = Self {
            ends,
            closed,
            factors: Vec::new(),
        };
        // Near closed ends `square` and `weight` are both almost zero, so that rounding errors dominate their
        // ratio.
        const CLOSE: f64 = 0.01;
        for [rpm, square] in squares {
            let weight = found.weight(rpm);
            let factor = square / weight;
            if weight.abs() > CLOSE && factor.is_finite() && factor >= 0.0 {
                found.factors.push([rpm, factor]);
            }
        }
        found.factors.sort_by(|a, b| a[0].total_cmp(&b[0]));
        found.factors.dedup_by(|next, kept| next[0] == kept[0]);
        (!found.factors.is_empty()).then_some(found)
    }

    /// A function of the speed that is zero at closed ends, positive within the band and negative outside.
    fn weight(&self, rpm: f64) -> f64 {
        let [from, to] = self.ends;
        let from_end = |closed: bool, way: f64| if closed { way / (to - from) } else { 1.0 };
        from_end(self.closed[0], rpm - from) * from_end(self.closed[1], to - rpm)
    }

    /// The square at a speed, in 1/s².
    fn square(&self, rpm: f64) -> f64 {
        self.weight(rpm) * interpolate(&self.factors, rpm)
    }

    /// Speeds in rpm from the first to the last of the band, with growth rates in 1/s.
    pub fn growth(&self) -> Vec<[f64; 2]> {
        let point = |rpm: f64| [rpm, self.square(rpm).max(0.0).sqrt()];
        between(self.ends).map(point).collect()
    }
}

/// 65 speeds from the first to the last, with the smallest distances at both ends.
fn between([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    const STEPS: u32 = 64;
    (0..=STEPS).map(move |i| match i {
        0 => from,
        STEPS => to,
        _ => {
            let angle = std::f64::consts::PI * f64::from(i) / f64::from(STEPS);
            from + (to - from) * (1.0 - angle.cos()) / 2.0
        }
    })
}

/// Linear interpolation between points of ascending abscissa, constant beyond them.
fn interpolate(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|point| point[0] <= x);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some([x0, y0]), Some([x1, y1])) => y0 + (x - x0) / (x1 - x0) * (y1 - y0),
        (Some([_, y]), None) | (None, Some(&[_, y])) => y,
        (None, None) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_zero_at_the_ends_and_goes_through_the_samples() {
        let samples = [[10.5, 1.0], [12.0, 4.0], [13.9, 0.2], [16.0, -9.0]];
        let found = Coalescence::new([10.0, 14.0], [true; 2], samples).unwrap();
        for [rpm, square] in samples {
            assert!((found.square(rpm) - square).abs() < 1e-12);
        }
        let growth = found.growth();
        assert_eq!(growth.first(), Some(&[10.0, 0.0]));
        assert_eq!(growth.last(), Some(&[14.0, 0.0]));
        assert!(growth.iter().any(|[_, g]| *g > 1.9));
    }

    #[test]
    fn a_band_cut_short_by_the_sweep_does_not_end_at_zero() {
        let found = Coalescence::new([10.0, 14.0], [true, false], [[14.0, 9.0]]).unwrap();
        assert_eq!(found.square(14.0), 9.0);
        let unknown = [([10.0, f64::NAN], 1.0), ([10.0, 14.0], f64::NAN)];
        for (ends, square) in unknown {
            assert_eq!(Coalescence::new(ends, [true; 2], [[11.0, square]]), None);
        }
    }
}
