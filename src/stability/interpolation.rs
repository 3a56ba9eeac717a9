//! Cubic interpolation between two speeds.

use super::root::place_of_zero;

/// Cubic Hermite polynomial on [0, 1]: values and slopes at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Values at 0 and 1.
    pub values: [f64; 2],
    /// Slopes at 0 and 1.
    pub slopes: [f64; 2],
}

impl Cubic {
    /// Value of the cubic at t.
    pub fn at(&self, t: f64) -> f64 {
        let ([f0, f1], [d0, d1]) = (self.values, self.slopes);
        let u = 1.0 - t;
        u * u * ((1.0 + 2.0 * t) * f0 + t * d0) + t * t * ((1.0 + 2.0 * u) * f1 - u * d1)
    }

    /// Points in (0, 1) with zero slope.
    fn stationary(&self) -> impl Iterator<Item = f64> {
        let ([f0, f1], [d0, d1]) = (self.values, self.slopes);
        // The slope is f′(t) = a t² + b t + d0.
        let (a, b) = (
            6.0 * (f0 - f1) + 3.0 * (d0 + d1),
            -6.0 * (f0 - f1) - 4.0 * d0 - 2.0 * d1,
        );
        let discriminant = (b * b - 4.0 * a * d0).max(-0.0);
        // This form of the roots avoids cancellation (Press et al., Numerical Recipes, 5.6).
        let q = -0.5 * (b + b.signum() * discriminant.sqrt());
        let roots = [q / a, d0 / q];
        roots.into_iter().filter(|t| *t > 0.0 && *t < 1.0)
    }
}

/// Sign changes of a cubic in (0, 1), ascending.
pub fn sign_changes(cubic: &Cubic) -> Vec<f64> {
    let mut bounds: Vec<f64> = cubic.stationary().collect();
    bounds.sort_by(f64::total_cmp);
    bounds.insert(0, 0.0);
    bounds.push(1.0);
    let differ = |pair: &&[f64]| cubic.at(pair[0]) * cubic.at(pair[1]) < 0.0;
    let within = bounds.windows(2).filter(differ);
    let zero = |pair: &[f64]| place_of_zero([pair[0], pair[1]], |t| cubic.at(t));
    within.map(zero).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_has_the_values_at_its_ends() {
        let line = Cubic {
            values: [2.0, 5.0],
            slopes: [1.0, 1.0],
        };
        assert_eq!((line.at(0.0), line.at(1.0)), (2.0, 5.0));
        let bend = Cubic {
            values: [0.0, 1.0],
            slopes: [1.0, 1.0],
        };
        assert_eq!(bend.at(0.5), 0.5);
    }

    /// t(1 − t)(2 − t) has its maximum at 1 − 1/√3, and its zeros at both ends.
    #[test]
    fn the_extremes_of_a_cubic_are_exact() {
        let hump = Cubic {
            values: [0.0, 0.0],
            slopes: [2.0, -1.0],
        };
        let places: Vec<f64> = hump.stationary().collect();
        let [place] = places[..] else {
            panic!("{places:?}")
        };
        let value = hump.at(place);
        assert!((place - (1.0 - 1.0 / 3.0_f64.sqrt())).abs() < 1e-12);
        assert!((value - 2.0 / 27.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_straight_line_has_no_extreme_inside() {
        let line = Cubic {
            values: [1.0, 3.0],
            slopes: [2.0, 2.0],
        };
        assert_eq!(line.stationary().count(), 0);
        assert!(sign_changes(&line).is_empty());
    }

    /// (t − 0.2)(t − 0.5)(t − 0.9).
    #[test]
    fn all_three_zeros_of_a_cubic_are_found() {
        let cubic = Cubic {
            values: [-0.09, 0.04],
            slopes: [0.73, 0.53],
        };
        let at = |t: f64| (t - 0.2) * (t - 0.5) * (t - 0.9);
        assert!((cubic.at(0.3) - at(0.3)).abs() < 1e-12);
        let zeros = sign_changes(&cubic);
        assert_eq!(zeros.len(), 3);
        for (zero, exact) in zeros.iter().zip([0.2, 0.5, 0.9]) {
            assert!((zero - exact).abs() < 1e-12, "{zero}");
        }
    }
}
