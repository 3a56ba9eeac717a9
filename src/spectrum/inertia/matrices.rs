//! The matrices of the blade as blocks of one number of nodal diameters and few columns: what solves and multiplies with
//! them in a time linear in the number of functions.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Scale};
use nalgebra::DMatrix;

use super::coupling::Coupling;
use super::{Harmonic, UndampedFullModel};
use crate::system::GyroscopicSystem;

/// Blocks and columns of a matrix, blocks + P diag(1 … 1, −1 … −1) Pᵀ.
pub struct ShiftedBlocks {
    pub blocks: Vec<ShiftedBlock>,
    /// P, N × columns.
    pub columns: Mat<f64>,
    /// Number of the last columns, that are taken away.
    pub taken_away: usize,
}

/// Of one harmonic: the same block for cosines and sines, and ±`turning` between them.
pub struct ShiftedBlock {
    /// Index of the first cosine, and of the first sine.
    pub firsts: Vec<usize>,
    pub block: DMatrix<f64>,
    /// 2Ωn, which sines add to the force on cosines.
    pub turning: f64,
}

impl UndampedFullModel {
    /// L(σ) = K(Ω) + σ² + σ 2ΩG at a real σ, in units of σ², with what is left out of PPᵀ left out.
    /// `None` where edge loads couple every wave with every other.
    pub fn shifted(&self, speed_rad_per_s: f64, shift_per_s: f64) -> Option<ShiftedBlocks> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let square = shift_per_s.powi(2);
        let blocks = self.harmonics.iter().map(|h| {
            let carried = h.diameters as f64 * speed_rad_per_s;
            let mut block = (&h.rest + &h.tension * speed_rad_per_s.powi(2)) / square;
            (0..h.radial()).for_each(|i| block[(i, i)] += 1.0 - carried.powi(2) / square);
            ShiftedBlock {
                firsts: h.firsts().collect(),
                block,
                turning: 2.0 * carried / shift_per_s,
            }
        });
        Some(ShiftedBlocks {
            blocks: blocks.collect(),
            columns: Scale(1.0 / shift_per_s) * columns.few(),
            taken_away: 0,
        })
    }

    /// K₀ with all columns that there are: what a larger basis would change is small, and stiff guides take part in
    /// it. Heave and tilt may have no stiffness but that of the guides: the blocks hold them, and columns take away
    /// what they add. `None` as for [`Self::shifted`].
    pub fn at_rest(&self) -> Option<ShiftedBlocks> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let columns = &columns.unknowns;
        let mut held: Vec<(usize, f64)> = Vec::new();
        let blocks = self.harmonics.iter().map(|h| {
            let mut block = h.rest.clone();
            if h.diameters <= 1 {
                block[(0, 0)] += h.shift;
                held.extend(h.firsts().map(|first| (first, h.shift.sqrt())));
            }
            ShiftedBlock {
                firsts: h.firsts().collect(),
                block,
                turning: 0.0,
            }
        });
        let blocks = blocks.collect();
        let holding = Mat::from_fn(columns.nrows(), held.len(), |i, k| match held[k] {
            (first, root) if first == i => root,
            _ => 0.0,
        });
        Some(ShiftedBlocks {
            blocks,
            columns: faer::concat![[columns, holding]],
            taken_away: held.len(),
        })
    }

    /// Whether the columns leave out no more than rounding.
    pub fn is_exact(&self) -> bool {
        matches!(&self.coupling, Coupling::Columns(columns) if columns.is_exact)
    }

    /// K₀X, (K_σ − N)X and GX with all columns that there are. `None` as for [`Self::shifted`].
    pub fn times(&self, x: MatRef<'_, f64>) -> Option<GyroscopicSystem> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let columns = &columns.unknowns;
        let mut stiffness = columns * (columns.transpose() * x);
        let [mut spin, mut gyroscopic] = [0, 1].map(|_| Mat::zeros(x.nrows(), x.ncols()));
        for h in &self.harmonics {
            let (n, radial) = (h.diameters as f64, h.radial());
            let whole = |block: &DMatrix<f64>| Mat::from_fn(radial, radial, |i, k| block[(i, k)]);
            let (rest, mut tension) = (whole(&h.rest), whole(&h.tension));
            (0..radial).for_each(|i| tension[(i, i)] -= n * n);
            for first in h.firsts() {
                let own = x.subrows(first, radial);
                for (block, sum) in [(&rest, &mut stiffness), (&tension, &mut spin)] {
                    let into = sum.subrows_mut(first, radial);
                    matmul(into, Accum::Add, block, own, 1.0, Par::Seq);
                }
            }
            if h.diameters > 0 {
                let (cosine, sine) = (h.first, h.first + radial);
                for (to, from, n) in [(cosine, sine, n), (sine, cosine, -n)] {
                    let turned = Scale(n) * x.subrows(from, radial);
                    gyroscopic.subrows_mut(to, radial).copy_from(turned);
                }
            }
        }
        Some(GyroscopicSystem::undamped(stiffness, spin, gyroscopic))
    }

    /// Where 2ΩG is not zero: (row, column, value).
    pub fn turning(&self, speed_rad_per_s: f64) -> Vec<(usize, usize, f64)> {
        let turned = self.harmonics.iter().filter(|h| h.diameters > 0);
        let entries = turned.flat_map(|h| {
            let value = 2.0 * speed_rad_per_s * h.diameters as f64;
            (0..h.radial()).flat_map(move |j| {
                let (cosine, sine) = (h.first + j, h.first + h.radial() + j);
                [(cosine, sine, value), (sine, cosine, -value)]
            })
        });
        entries.collect()
    }

    /// The lowest wave of every number of nodal diameters at rest, N × (2 n_max + 1), without guides.
    pub fn first_waves(&self) -> Mat<f64> {
        let places = self
            .harmonics
            .iter()
            .flat_map(|h| h.firsts().map(move |first| (h, first)));
        let places: Vec<(&Harmonic, usize)> = places.collect();
        let order = self
            .harmonics
            .iter()
            .map(|h| h.radial() * h.firsts().count());
        let mut waves = Mat::zeros(order.sum(), places.len());
        for (k, (h, first)) in places.into_iter().enumerate() {
            let lowest = h.resting.eigenvalues.imin();
            for j in 0..h.radial() {
                waves[(first + j, k)] = h.resting.eigenvectors[(j, lowest)];
            }
        }
        waves
    }
}
