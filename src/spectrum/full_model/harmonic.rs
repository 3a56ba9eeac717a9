//! The waves of one number of nodal diameters, in the frame of the blade.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

use crate::plate::HarmonicBlock;

/// One harmonic in the frame of the blade.
#[derive(Debug)]
pub struct Harmonic {
    /// n.
    pub diameters: usize,
    /// Index of its first unknown in the basis of the plate.
    pub first: usize,
    /// K_b + K_m.
    pub rest: DMatrix<f64>,
    /// K_σ.
    pub tension: DMatrix<f64>,
    /// By how much K_σ falls short of being positive: rounding.
    pub shortfall: f64,
    /// Of the waves at rest, in 1/s²: what is small beside it may be left out. T = B(0) + σ, which is positive, and more
    /// for waves so stiff that a good share of their stiffness changes nothing.
    pub weights: Vec<f64>,
    /// σ.
    pub shift: f64,
    /// The waves at rest, near those of every speed: of K_b + K_m.
    pub resting: SymmetricEigen<f64, Dyn>,
    /// K_σ in these.
    pub resting_tension: DMatrix<f64>,
}

/// Lines lie below this multiple of the blade's frequency scale, for the most part: those above are counted, with less
/// certainty.
const HIGH_LINE: f64 = 6.0;
/// A wave that is so many times as stiff as those that lines meet may be made stiffer by a thousand times the share that these
/// may: its flexibility hardly counts.
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

    /// J.
    pub fn radial(&self) -> usize {
        self.rest.nrows()
    }

    /// Index of the first cosine, and of the first sine.
    pub fn firsts(&self) -> impl Iterator<Item = usize> + use<> {
        let (first, radial) = (self.first, self.radial());
        let phases = if self.diameters == 0 { 1 } else { 2 };
        (0..phases).map(move |phase| first + phase * radial)
    }

    /// (ω + nΩ)² of a line high up.
    pub fn fast_turning(&self, speed_rad_per_s: f64) -> f64 {
        (HIGH_LINE * self.shift.sqrt() + self.diameters as f64 * speed_rad_per_s).powi(2)
    }

    /// Indices of its waves among e^{inθ} and e^{−inθ}: for n = 0 they are one.
    pub fn signs(&self) -> impl Iterator<Item = usize> + use<> {
        0..if self.diameters == 0 { 1 } else { 2 }
    }
}

/// Of a wave with T at rest.
fn weight(own: f64, shift: f64) -> f64 {
    let stiffer = own / (HIGH_LINE.powi(2) * shift);
    own * stiffer.clamp(1.0, MOST_WEIGHT)
}
