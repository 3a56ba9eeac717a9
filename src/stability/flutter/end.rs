//! Begin and end of a quadruple.

use faer::c64;

use crate::modes::DoubleEigenvalue;
use crate::stability::evaluator::SignatureEvaluator;
use crate::stability::maximum::Sample;
use crate::stability::quadruples::{Bound, Stretch};
use crate::stability::signature::SignedMode;

/// An end whose distance from the expected end exceeds this share of the way to the nearest known speed belongs to another
/// quadruple.
const SAME_END: f64 = 0.1;
/// Allowed shift of an edge in the models of the search, relative to the speed.
pub const VICINITY: f64 = 3e-5;

/// A quadruple at a speed.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    pub speed: f64,
    pub mode: SignedMode,
}

/// Coalescence of a + and a − wave or of two real λ.
#[derive(Debug, Clone, Copy)]
pub struct Edge {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// λ, imaginary or real, in 1/s.
    pub lambda: c64,
    /// dσ²/dΩ, in 1/s; not finite if unknown.
    pub growth_square_slope: f64,
}

/// Begin or end of a band.
#[derive(Debug, Clone, Copy)]
pub enum End {
    /// Coalescence of two waves or of two real λ.
    Edge(Edge),
    /// End of the range inside the band.
    Range(f64),
    /// Estimated end of a quadruple that could not be followed to it.
    Unknown(f64),
}

impl End {
    /// Rotation speed Ω.
    pub fn speed(&self) -> f64 {
        match self {
            End::Edge(edge) => edge.speed_rad_per_s,
            End::Range(speed) | End::Unknown(speed) => *speed,
        }
    }

    /// σ² at the end, if it is a coalescence.
    pub fn sample(&self) -> Option<Sample> {
        match self {
            End::Edge(edge) => Some(Sample {
                at: edge.speed_rad_per_s,
                value: edge.lambda.re.powi(2),
                slope: edge.growth_square_slope,
            }),
            End::Range(_) | End::Unknown(_) => None,
        }
    }

    /// End of an interval whose quadruple is known at an inner speed.
    pub fn new(
        evaluator: &SignatureEvaluator<'_>,
        stretch: &Stretch<'_>,
        bound: Bound,
        point: Point,
    ) -> Self {
        let Point {
            speed: inside,
            mode,
        } = point;
        let (expected, outside) = match bound {
            Bound::Coalescence {
                expected_rad_per_s,
                outside_rad_per_s,
            } => (expected_rad_per_s, outside_rad_per_s),
            Bound::Range(speed) => return End::Range(speed),
            Bound::Height(speed) => return End::Unknown(speed),
        };
        let square = stretch
            .square(expected)
            .unwrap_or(mode.lambda * mode.lambda)
            .re;
        let lambda = c64::new(square, 0.0).sqrt();
        let is_real = square > 0.0;
        let direction = (outside - inside).signum();
        let margin = VICINITY * expected;
        let is_same = |found: &DoubleEigenvalue| {
            let off = (found.speed_rad_per_s - expected).abs();
            let beyond = (found.speed_rad_per_s - outside) * direction;
            let before = (inside - found.speed_rad_per_s) * direction;
            // ((λ₁ − λ₂)/2)² is σ² next to a coalescence of waves and −ω² next to one of real λ.
            let sign = if is_real { 1.0 } else { -1.0 };
            let is_outwards = found.square_slope * direction * sign > 0.0;
            let way = (expected - inside).abs();
            off <= SAME_END * way + margin && before.max(beyond) <= margin && is_outwards
        };
        let found = evaluator.double_eigenvalue(expected, lambda);
        let edge = found.filter(is_same).map(|found| Edge {
            speed_rad_per_s: found.speed_rad_per_s,
            lambda: found.lambda,
            growth_square_slope: if is_real {
                2.0 * found.lambda.re * found.mean_slope.re
            } else {
                found.square_slope
            },
        });
        End::Edge(edge.unwrap_or(Edge {
            speed_rad_per_s: expected,
            lambda,
            growth_square_slope: f64::NAN,
        }))
    }
}
