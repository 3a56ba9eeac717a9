//! Factor of the cutting stiffness at a frequency, which follows from the surface that the preceding tooth has
//! left.

use faer::c64;

use crate::model::scene::Washboarding;

/// h(λ) = 1 − μ/p Σ e^(−λτ_j) over the p pitches that repeat around the blade: every tooth passes a given
/// place of the wood once a turn.
#[derive(Debug, Clone)]
pub struct Delay {
    overlap: f64,
    delays_s: Vec<f64>,
}

impl Delay {
    /// The delay at a speed.
    pub fn new(washboarding: &Washboarding, speed_rad_per_s: f64) -> Self {
        Delay {
            overlap: washboarding.typed.overlap,
            delays_s: washboarding.delays_s(speed_rad_per_s),
        }
    }

    /// h(λ), the factor of the cutting stiffness for a motion e^(λt).
    pub fn at(&self, lambda: c64) -> c64 {
        let left = self.delays_s.iter().map(|delay| (-lambda * *delay).exp());
        c64::new(1.0, 0.0) - left.sum::<c64>() * self.weight()
    }

    /// Derivative dh/dλ.
    pub fn slope(&self, lambda: c64) -> c64 {
        let slopes = self
            .delays_s
            .iter()
            .map(|delay| (-lambda * *delay).exp() * *delay);
        slopes.sum::<c64>() * self.weight()
    }

    /// Upper bound 1 + μ of |h(λ)| for Re λ ≥ 0.
    pub fn bound(&self) -> f64 {
        1.0 + self.overlap
    }

    /// Longest delay, in s.
    pub fn longest_s(&self) -> f64 {
        self.delays_s.iter().copied().fold(0.0, f64::max)
    }

    fn weight(&self) -> f64 {
        self.overlap / self.delays_s.len() as f64
    }
}
