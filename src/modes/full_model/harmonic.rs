//! The waves of one number of nodal diameters, in the body frame.

use nalgebra::DMatrix;

use crate::model::linalg::{SymmetricEigen, symmetric_eigenvalues, view};
use crate::model::plate::HarmonicBlock;

/// One harmonic in the body frame.
#[derive(Debug)]
pub struct Harmonic {
    /// Number n of nodal diameters.
    pub diameters: usize,
    /// Index of the first unknown in the basis of the plate.
    pub first: usize,
    /// K_b + K_m.
    pub rest: DMatrix<f64>,
    /// Membrane stiffness K_σ.
    pub tension: DMatrix<f64>,
    /// Magnitude of the lowest eigenvalue of K_σ if it is negative, which is rounding; otherwise 0.
    pub shortfall: f64,
    /// Weights of the waves at rest, in 1/s²: a term that is small compared with them is negligible. They are
    /// T = B(0) + σ > 0, and more for waves so stiff that even a large change of their stiffness has no
    /// effect.
    pub weights: Vec<f64>,
    /// Shift σ, in 1/s².
    pub shift: f64,
    /// Eigenvectors of K_b + K_m: the waves at rest, which approximate those at every speed.
    pub resting: SymmetricEigen,
    /// K_σ in the waves at rest.
    pub resting_tension: DMatrix<f64>,
}

/// Most lines lie below this multiple of the blade's frequency scale; lines above it are proven less often.
const HIGH_LINE: f64 = 6.0;
/// Largest ratio of the weight of a wave to its T: the flexibility of so stiff a wave is negligible, so that a
/// larger share of its stiffness may be neglected.
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
        // Numbers that are not finite make every count inconclusive.
        let resting = SymmetricEigen::or_nan(view(&rest));
        let least_tension = symmetric_eigenvalues(view(&tension)).map_or(f64::NAN, |all| all[0]);
        let shift = frequency_scale.powi(2) + 2.0 * (-resting.values[0]).max(0.0);
        let turned = resting.vectors.transpose() * view(&tension) * &resting.vectors;
        let resting_tension = DMatrix::from_fn(radial, radial, |i, k| turned[(i, k)]);
        Harmonic {
            diameters: block.diameters,
            first,
            shortfall: (-least_tension).max(0.0),
            weights: resting
                .values
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

    /// (ω + nΩ)² of a line at high frequency, in 1/s².
    pub fn fast_turning(&self, speed_rad_per_s: f64) -> f64 {
        (HIGH_LINE * self.shift.sqrt() + self.diameters as f64 * speed_rad_per_s).powi(2)
    }

    /// Indices of the waves: 0 for e^{inθ}, 1 for e^{−inθ}, which is absent for n = 0.
    pub fn signs(&self) -> impl Iterator<Item = usize> + use<> {
        0..if self.diameters == 0 { 1 } else { 2 }
    }
}

/// Weight of a wave with the stiffness T = `own` at rest.
fn weight(own: f64, shift: f64) -> f64 {
    let stiffer = own / (HIGH_LINE.powi(2) * shift);
    own * stiffer.clamp(1.0, MOST_WEIGHT)
}
