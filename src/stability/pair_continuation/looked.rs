//! Estimated zero of σ² or ω² from one or two speeds.

/// σ² and ω² of a pair at a speed.
pub struct Looked {
    /// Rotation speed Ω.
    pub speed: f64,
    /// σ² and ω², in 1/s².
    pub squares: [f64; 2],
    /// Slopes of both squares over the speed, in 1/s.
    pub slopes: [f64; 2],
}

impl Looked {
    /// Distance to the root of the tangent, if the square falls in that direction; negative beyond the root.
    pub fn root_of_tangent(&self, k: usize, direction: f64) -> Option<f64> {
        let falls = self.slopes[k] * direction < 0.0;
        falls.then(|| -self.squares[k] / self.slopes[k])
    }

    /// Distance to the root of the cubic through both speeds: ahead if the square is positive, back if it is
    /// negative. σ² over a band is nearly a parabola, for which a tangent is inaccurate. `None` if the root
    /// is too far away.
    pub fn root_of_cubic(&self, other: &Looked, k: usize, direction: f64) -> Option<f64> {
        let width = other.speed - self.speed;
        let (value, slope) = (self.squares[k], self.slopes[k] * width);
        let (rise, end_slope) = (other.squares[k] - value, other.slopes[k] * width);
        let square = 3.0 * rise - 2.0 * slope - end_slope;
        let cube = slope + end_slope - 2.0 * rise;
        let is_ahead = |t: &f64| (t * width * direction > 0.0) == (value > 0.0);
        // Newton's method for the cubic starts at the nearest root of the parabola without the cubic term.
        // The roots are written in the form that avoids cancellation.
        let discriminant = slope * slope - 4.0 * square * value;
        let q = -0.5 * (slope + slope.signum() * discriminant.sqrt());
        let roots = [q / square, value / q].into_iter();
        let nearest = roots
            .filter(|t| t.is_finite() && is_ahead(t))
            .min_by(|x, y| x.abs().total_cmp(&y.abs()))?;
        let newton = |t: f64| {
            let tangent = slope + t * (2.0 * square + 3.0 * t * cube);
            t - (value + t * (slope + t * (square + t * cube))) / tangent
        };
        let root = (0..CUBIC_STEPS).fold(nearest, |t, _| newton(t));
        let is_near = root.abs() <= FARTHEST;
        (is_near && is_ahead(&root)).then_some(root * width)
    }
}

/// Number of Newton steps from the root of the parabola to that of the cubic.
const CUBIC_STEPS: usize = 4;
/// Distance of a root, relative to the distance of the two speeds, beyond which the tangent is better than
/// the cubic.
const FARTHEST: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// σ² = (Ω − 2)(7 − Ω), with ω² far from zero: two speeds determine the parabola, and its root is found
    /// from both sides.
    #[test]
    fn two_speeds_give_the_root_of_a_parabola() {
        let at = |speed: f64| Looked {
            speed,
            squares: [(speed - 2.0) * (7.0 - speed), 100.0],
            slopes: [9.0 - 2.0 * speed, 0.0],
        };
        for (before, here) in [(3.0, 4.0), (4.0, 6.0), (6.0, 7.5), (8.0, 6.5)] {
            let left = at(here).root_of_cubic(&at(before), 0, 1.0).unwrap();
            assert!((here + left - 7.0).abs() < 1e-12, "{before} {here}: {left}");
        }
        let left = at(4.0).root_of_cubic(&at(5.0), 0, -1.0).unwrap();
        assert!((4.0 + left - 2.0).abs() < 1e-12, "{left}");
        assert!(at(4.0).root_of_tangent(0, 1.0).is_none());
        let left = at(5.0).root_of_tangent(0, 1.0).unwrap();
        assert_eq!(left, 6.0);
    }
}
