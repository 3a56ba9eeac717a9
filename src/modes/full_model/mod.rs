//! The full model of a saw by its structure: a block for each number of nodal diameters, and few columns that
//! couple the blocks.
//!
//! In the body frame a wave of n nodal diameters with the frequency ω in space has the frequency ω + nΩ; for
//! the opposite wave n is negative. Without guides
//!
//! L(λ) = λ² + λ D(Ω) + K(Ω)
//!
//! is therefore block diagonal, with B_n(Ω) + μ² + ηK_b μ + c(λ + insΩ), μ = λ + inΩ, for the wave (c −
//! is)/√2 of cosines c and sines s, and −n for the opposite one; B_n = K_b + K_m + Ω²K_σ. Guides add PWPᵀ
//! with few columns P, where W(λ) is 1 for springs, and W_n + λW_c for dampers, films and controllers. A solve, a determinant and an inertia
//! therefore cost O(NJ² + Nr²) for J functions of each harmonic and r columns, in place of O(N³). Loads at
//! the rim couple all waves: then only the inertia is computed, by a factorization of the whole matrix.

mod contact_forces;
mod coupling;
mod damping;
mod elimination;
mod growth_count;
mod harmonic;
mod inertia;
mod product;
mod wave_scaling;

use faer::{Mat, c64};

pub use self::elimination::Elimination;
pub use self::inertia::AtSpeed;

use self::coupling::{Columns, Coupling, Kept, in_waves};
use self::damping::{Damping, scaled_unit};
use self::elimination::{PairInverse, Shift};
use self::harmonic::Harmonic;
use super::scale::frequency_scale;
use crate::model::plate::{HarmonicBlock, Plate};

/// The blocks of the harmonics of a blade, and their coupling.
#[derive(Debug)]
pub struct FullModel {
    harmonics: Vec<Harmonic>,
    coupling: Coupling,
    /// Inertia, gyroscopic forces, damping and forces without a potential; `None` if these need too many
    /// columns.
    damping: Option<Damping>,
}

impl FullModel {
    /// The full model of a plate.
    pub fn new(plate: &Plate) -> Self {
        Self::with_columns(plate, Kept::All)
    }

    /// The full model with solves and products accurate to a millionth, in a third of the time of
    /// [`FullModel::new`].
    pub fn nearly(plate: &Plate) -> Self {
        Self::with_columns(plate, Kept::Few)
    }

    fn with_columns(plate: &Plate, kept: Kept) -> Self {
        let scale = frequency_scale(plate);
        let mut blocks = plate.harmonics.clone();
        let beside_states = stiffness_of_states(plate, &mut blocks[0]);
        let guides = beside_states.as_ref().or(plate.contact.stiffness());
        let harmonic =
            |block: &HarmonicBlock| Harmonic::new(block, plate.offset(block.diameters), scale);
        let harmonics: Vec<Harmonic> = blocks.iter().map(harmonic).collect();
        let order = plate.degrees_of_freedom();
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

    /// Whether L(λ) can be eliminated: no loads at the rim, and few columns.
    pub fn is_structured(&self) -> bool {
        !self.is_dense() && self.damping.is_some()
    }

    /// Whether the columns P represent the guides up to rounding errors.
    pub fn is_exact(&self) -> bool {
        matches!(&self.coupling, Coupling::Columns(columns) if columns.is_exact)
    }

    /// L(λ) with its blocks eliminated, without the part of the guides that their columns neglect. `None` if
    /// it is not structured, or if a block is singular.
    pub fn eliminated<T: Shift>(&self, speed_rad_per_s: f64, lambda: T) -> Option<Elimination<T>> {
        let (Coupling::Columns(springs), Some(damping)) = (&self.coupling, &self.damping) else {
            return None;
        };
        let blocks: Option<Vec<PairInverse<T>>> = self
            .harmonics
            .iter()
            .enumerate()
            .map(|(k, harmonic)| {
                let wave = |n: f64| {
                    let block = harmonic.stiffness(speed_rad_per_s);
                    damping.dynamic(k, block, speed_rad_per_s, lambda.into(), n)
                };
                PairInverse::new(harmonic, wave)
            })
            .collect();
        let parts = damping.weighted(springs, lambda);
        Elimination::new(blocks?, &parts)
    }

    /// K(Ω) of a blade without damping, with all columns, because changes by a larger basis are small and involve stiff guides.
    /// Heave and tilt may have no stiffness except that of the guides: their blocks are stiffened, and further columns
    /// subtract the added stiffness. `None` with loads at the rim, or if a block is singular.
    pub fn eliminated_stiffness(&self, speed_rad_per_s: f64) -> Option<Elimination<f64>> {
        let Coupling::Columns(springs) = &self.coupling else {
            return None;
        };
        let mut held: Vec<(usize, f64)> = Vec::new();
        let blocks: Option<Vec<PairInverse<f64>>> = self
            .harmonics
            .iter()
            .map(|harmonic| {
                // A shape that is fixed in space turns on the blade, with the inertia of n²Ω².
                let mut block = harmonic.stiffness(speed_rad_per_s);
                let turned = (harmonic.diameters as f64 * speed_rad_per_s).powi(2);
                (0..harmonic.radial()).for_each(|i| block[(i, i)] -= turned);
                if harmonic.diameters <= 1 {
                    block[(0, 0)] += harmonic.shift;
                    held.extend(
                        harmonic
                            .firsts()
                            .map(|first| (first, harmonic.shift.sqrt())),
                    );
                }
                PairInverse::new(harmonic, |_| block.map(|x| c64::new(x, 0.0)))
            })
            .collect();
        let order = springs.unknowns.nrows();
        let holding = Mat::from_fn(order, held.len(), |i, k| match held[k] {
            (first, root) if first == i => root,
            _ => 0.0,
        });
        let parts = [(springs.unknowns.as_ref(), 1.0), (holding.as_ref(), -1.0)]
            .map(|(columns, weight)| (columns, scaled_unit(columns.ncols(), weight)));
        Elimination::new(blocks?, &parts)
    }
}

/// Moves the stiffness of the internal states of pads from K_g, which couples them with nothing, to their block: it is far above that
/// of the waves. Returns the rest of K_g; `None` without states.
fn stiffness_of_states(plate: &Plate, block: &mut HarmonicBlock) -> Option<Mat<f64>> {
    let mut rest = plate
        .contact
        .stiffness()
        .filter(|_| !plate.states().is_empty())?
        .clone();
    for state in plate.states() {
        block.bending[(state, state)] += std::mem::take(&mut rest[(state, state)]);
    }
    Some(rest)
}
