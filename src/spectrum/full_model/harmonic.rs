//! The waves of one number of nodal diameters, in the body frame.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

use crate::plate::HarmonicBlock;

/// One harmonic in the body frame.
#[derive(Debug)]
pub struct Harmonic {
    /// Number n of nodal diameters.
    pub diameters: usize,
    /// Index of its first unknown in the basis of the plate.
    pub first: usize,
    /// K_b + K_m.
    pub rest: DMatrix<f64>,
    /// Membrane stiffness K_σ.
    pub tension: DMatrix<f64>,
    /// Largest negative eigenvalue of K_σ in magnitude, which is rounding.
    pub shortfall: f64,
    /// Weights of the waves at rest, in 1/s²: a term that is small compared with them is negligible.
    /// T = B(0) + σ, which is positive, and more for waves so stiff that a large share of their stiffness
    /// has no effect.
    pub weights: Vec<f64>,
    /// Shift σ.
    pub shift: f64,
    /// The waves at rest, of K_b + K_m, which approximate those at every speed.
    pub resting: SymmetricEigen<f64, Dyn>,
    /// K_σ in the waves at rest.
    pub resting_tension: DMatrix<f64>,
}

/// Most lines lie below this multiple of the blade's frequency scale; those above are counted with less
/// certainty.
const HIGH_LINE: f64 = 6.0;
/// The weight of a wave with this ratio of its stiffness to that of the waves in question may be increased by
/// a thousand times the share allowed for those, because its flexibility is negligible.
const MOST_WEIGHT: f64 = 100.0;

impl Harmonic {
    pub fn new(block: &HarmonicBlock, first: usize, frequency_scale: f64) -> Self {
        let radial = block.bending.nrows();
        let n2 = (block.diameters * block.diameters) as f64;
        let tension = &block.spin + DMatrix::from_diagonal_element(radial, radial, n2);
        let mut rest = block.bending.clone();
        if let Some(membrane) = &block.membrane {
            rest += membrane;
        }
        let least = |matrix: &DMatrix<f64>| matrix.symmetric_eigenvalues().min();
        let resting = rest.clone().symmetric_eigen();
        let shift = frequency_scale.powi(2) + 2.0 * (-resting.eigenvalues.min()).max(0.0);
        let resting_tension = resting.eigenvectors.tr_mul(&tension) * &resting.eigenvectors;
        Harmonic {
            diameters: block.diameters,
            first,
            shortfall: (-least(&tension)).max(0.0),
            weights: resting
                .eigenvalues
                .iter()
                .map(|own| weight(own + shift, shift))
                .collect(),
            rest,
            tension,
            shift,
            resting,
            resting_tension,
        }
    }

    /// B_n = K_b + K_m + Ω²K_σ.
    pub fn stiffness(&self, speed_rad_per_s: f64) -> DMatrix<f64> {
        &self.rest + &self.tension * speed_rad_per_s.powi(2)
    }

    /// Number J of radial functions.
    pub fn radial(&self) -> usize {
        self.rest.nrows()
    }

    /// Index of the first cosine, and of the first sine.
    pub fn firsts(&self) -> impl Iterator<Item = usize> + use<> {
        let (first, radial) = (self.first, self.radial());
        let phases = if self.diameters == 0 { 1 } else { 2 };
        (0..phases).map(move |phase| first + phase * radial)
    }

    /// (ω + nΩ)² of a line at high frequency.
    pub fn fast_turning(&self, speed_rad_per_s: f64) -> f64 {
        (HIGH_LINE * self.shift.sqrt() + self.diameters as f64 * speed_rad_per_s).powi(2)
    }

    /// Indices of its waves among e^{inθ} and e^{−inθ}; for n = 0 there is one.
    pub fn signs(&self) -> impl Iterator<Item = usize> + use<> {
        0..if self.diameters == 0 { 1 } else { 2 }
    }
}

/// Weight of a wave with T at rest.
fn weight(own: f64, shift: f64) -> f64 {
    let stiffer = own / (HIGH_LINE.powi(2) * shift);
    own * stiffer.clamp(1.0, MOST_WEIGHT)
}
