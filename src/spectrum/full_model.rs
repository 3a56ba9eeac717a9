//! The full model of a saw by its structure: blocks of one number of nodal diameters, and few columns.
//!
//! Seen from the blade, a wave of n nodal diameters that turns at frequency ω in space has frequency
//! ω + nΩ, and −n for the opposite one. Without guides
//!
//! L(λ) = λ² + λ D(Ω) + K(Ω)
//!
//! is therefore block diagonal, with B_n(Ω) + μ² + ηK_b μ + c(λ + insΩ), μ = λ + inΩ, for the wave (c − is)/√2 of
//! cosines c and sines s, and −n for the opposite one; B_n = K_b + K_m + Ω²K_σ. Guides add PWPᵀ, few columns P for all
//! of them, W(λ) being 1 for springs and λ for dampers. So a solve, a determinant and an inertia cost O(NJ² + Nr²) for
//! J functions of each harmonic and r columns, in place of O(N³). Loads at the rim couple every wave with every
//! other: there only the inertia is known, by a factorization of the whole matrix.

mod coupling;
mod damping;
mod elimination;
mod harmonic;
mod inertia;
mod product;
mod unlisted;

use faer::{Mat, c64};
use nalgebra::DMatrix;

pub use self::elimination::Elimination;
pub use self::inertia::AtSpeed;

use self::coupling::{Columns, Coupling, Kept, in_waves};
use self::damping::Damping;
use self::elimination::{PairInverse, Shift};
use self::harmonic::Harmonic;
use super::scale::frequency_scale;
use crate::plate::{HarmonicBlock, Plate};

/// The blade, and what couples its harmonics.
#[derive(Debug)]
pub struct FullModel {
    harmonics: Vec<Harmonic>,
    coupling: Coupling,
    /// `None` where what acts besides has no such structure: forces without a potential, and dampers of too many columns.
    damping: Option<Damping>,
}

impl FullModel {
    /// Of a plate.
    pub fn new(plate: &Plate) -> Self {
        Self::with_columns(plate, Kept::All)
    }

    /// The same, to be solved and multiplied with to a millionth: in a third of the time.
    pub fn nearly(plate: &Plate) -> Self {
        Self::with_columns(plate, Kept::Few)
    }

    fn with_columns(plate: &Plate, kept: Kept) -> Self {
        let scale = frequency_scale(plate);
        let harmonic =
            |block: &HarmonicBlock| Harmonic::new(block, plate.offset(block.diameters), scale);
        let harmonics: Vec<Harmonic> = plate.harmonics.iter().map(harmonic).collect();
        let order = plate.degrees_of_freedom();
        let guides = plate.contact.stiffness();
        let columns = match (&plate.edge_stiffness, guides) {
            (None, Some(guides)) => Columns::new(guides, &harmonics, kept),
            (None, None) => Columns::new(&Mat::zeros(order, order), &harmonics, kept),
            (Some(_), _) => None,
        };
        let coupling = columns.map_or_else(
            || {
                let mut sum = Mat::zeros(order, order);
                for term in [guides, plate.edge_stiffness.as_ref()]
                    .into_iter()
                    .flatten()
                {
                    sum += term;
                }
                Coupling::Dense(in_waves(&sum, &harmonics))
            },
            |columns| Coupling::Columns(Box::new(columns)),
        );
        FullModel {
            damping: Damping::of(plate, &harmonics),
            harmonics,
            coupling,
        }
    }

    /// Whether a count needs a factorization of the order of the basis.
    pub fn is_dense(&self) -> bool {
        matches!(self.coupling, Coupling::Dense(_))
    }

    /// Whether L(λ) can be eliminated: no loads at the rim, no forces without a potential.
    pub fn is_structured(&self) -> bool {
        !self.is_dense() && self.damping.is_some()
    }

    /// Whether the columns leave out no more than rounding.
    pub fn is_exact(&self) -> bool {
        matches!(&self.coupling, Coupling::Columns(columns) if columns.is_exact)
    }

    /// L(λ) with its blocks eliminated, but for what the columns of the guides leave out. `None` where it is not
    /// structured, and where a block is singular.
    pub fn eliminated<T: Shift>(&self, speed_rad_per_s: f64, lambda: T) -> Option<Elimination<T>> {
        let (Coupling::Columns(springs), Some(damping)) = (&self.coupling, &self.damping) else {
            return None;
        };
        let blocks = self.harmonics.iter().enumerate().map(|(k, harmonic)| {
            let wave = |n: f64| {
                let block = harmonic.stiffness(speed_rad_per_s);
                damping.dynamic(k, block, speed_rad_per_s, lambda.into(), n)
            };
            PairInverse::new(harmonic, wave)
        });
        let blocks: Option<Vec<PairInverse<T>>> = blocks.collect();
        let parts = damping.weighted(springs, lambda);
        Elimination::new(blocks?, &parts)
    }

    /// K₀ with all columns that there are: what a larger basis would change is small, and stiff guides take part in
    /// it. Heave and tilt may have no stiffness but that of the guides: the blocks hold them, and columns take away
    /// what they add. `None` where it is not structured, and where a block is singular.
    pub fn eliminated_at_rest(&self) -> Option<Elimination<f64>> {
        let Coupling::Columns(springs) = &self.coupling else {
            return None;
        };
        let mut held: Vec<(usize, f64)> = Vec::new();
        let blocks = self.harmonics.iter().map(|harmonic| {
            let mut block = harmonic.rest.clone();
            if harmonic.diameters <= 1 {
                block[(0, 0)] += harmonic.shift;
                held.extend(
                    harmonic
                        .firsts()
                        .map(|first| (first, harmonic.shift.sqrt())),
                );
            }
            PairInverse::new(harmonic, |_| block.map(|x| c64::new(x, 0.0)))
        });
        let blocks: Option<Vec<PairInverse<f64>>> = blocks.collect();
        let order = springs.unknowns.nrows();
        let holding = Mat::from_fn(order, held.len(), |i, k| match held[k] {
            (first, root) if first == i => root,
            _ => 0.0,
        });
        let parts = [(springs.unknowns.as_ref(), 1.0), (holding.as_ref(), -1.0)];
        Elimination::new(blocks?, &parts)
    }
}

/// Real blocks times a number, added to complex ones.
fn add_scaled(sum: &mut DMatrix<c64>, factor: c64, block: &DMatrix<f64>) {
    if factor != c64::new(0.0, 0.0) {
        sum.zip_apply(block, |sum, own| *sum += factor * own);
    }
}
