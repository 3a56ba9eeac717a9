//! The free blade by waves, and its dampers by columns.
//!
//! For each number n of nodal diameters the waves of the free blade at the speed Ω are the eigenvectors v_k of
//! B_n(Ω) = K_b + K_m + Ω²K_σ, J × J, symmetric, with ω_k² = v_kᵀ B_n v_k: a real pair cos nθ, sin nθ each. In a frame
//! fixed in space their frequencies are ω_k ± nΩ. The dampers fixed in space are λPPᵀ/h with few columns P.

use faer::{Mat, Scale};

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

/// Matrices of one number of nodal diameters, cosines before sines.
pub struct Block {
    /// Number of nodal diameters n.
    pub diameters: usize,
    /// Index of the first unknown in the component.
    pub first: usize,
    /// Number of radial functions, and of heads of guide arms for n = 0.
    pub radial: usize,
    /// The equation of motion of the block, J × J for n = 0, else 2J × 2J.
    pub system: GyroscopicSystem,
}

impl Block {
    /// ω_k², ascending, and v_k at a speed; negative past buckling.
    pub fn waves(&self, speed: f64) -> (Vec<f64>, Mat<f64>) {
        let (radial, turned) = (self.radial, (self.diameters * self.diameters) as f64);
        let stiffness = &self.system.stiffness;
        let matrix = Mat::from_fn(radial, radial, |i, k| {
            let convective = if i == k { turned } else { 0.0 };
            stiffness[(i, k)] + speed * speed * (self.system.spin[(i, k)] + convective)
        });
        let eigen = SymmetricEigen::or_nan(matrix.as_ref());
        (eigen.values, eigen.vectors)
    }

    /// Number of copies of each wave: the cosine, and for n > 0 the sine.
    pub fn copies(&self) -> usize {
        1 + usize::from(self.diameters > 0)
    }
}

/// A component of a saw by waves and dampers.
pub struct Saw {
    /// Blocks by number of nodal diameters.
    pub blocks: Vec<Block>,
    /// Columns P of the dampers fixed in space, hC = PPᵀ with the top h of the window, N × r.
    pub dampers: Mat<f64>,
}

impl Saw {
    /// Blocks and dampers of the component of a plate that begins at the unknown `first`, for a window in 1/s. The trace of what the
    /// columns leave out, relative to the stiffness of the free blade plus h², is at most [`COLUMNS`].
    pub fn new(plate: &Plate, first: usize, full: &GyroscopicSystem, window: f64) -> Self {
        let own = first..first + full.order();
        let blocks: Vec<Block> = (0..=plate.max_diameters())
            .filter(|n| own.contains(&plate.offset(*n)))
            .map(|n| Block {
                diameters: n,
                first: plate.offset(n) - first,
                radial: plate.harmonics[n].bending.nrows(),
                system: GyroscopicSystem::of_harmonic(plate, n),
            })
            .collect();
        let dampers = match plate.contact.damping() {
            Some(dampers) => {
                let mut of_blade = Scale(window) * dampers;
                // The internal states of pads are always near: they have no stiffness of their own.
                for state in plate.states().filter_map(|state| state.checked_sub(first)) {
                    of_blade.row_mut(state).fill(0.0);
                    of_blade.col_mut(state).fill(0.0);
                }
                columns(&of_blade, &weights(&blocks, window))
            }
            None => Mat::zeros(full.order(), 0),
        };
        Saw { blocks, dampers }
    }
}

/// Force of a damper beside the stiffness of the far waves, at the top of the window, above which it is kept.
pub const STRONG: f64 = 0.1;
/// Trace of what the columns leave out, a thousandth of the force from which on a damper is strong.
const COLUMNS: f64 = 1e-3 * STRONG;
/// Largest number of columns.
const MOST_COLUMNS: usize = 400;

/// Root of the stiffness of each function of the free blade plus the square of the window.
fn weights(blocks: &[Block], window: f64) -> Vec<f64> {
    let of = |block: &Block| -> Vec<f64> {
        let stiffness = &block.system.stiffness;
        let own = (0..stiffness.nrows()).map(|i| stiffness[(i, i)].abs());
        own.map(|k| (k + window * window).sqrt()).collect()
    };
    blocks.iter().flat_map(of).collect()
}

/// Columns of a positive matrix of low rank, by Cholesky factorization with complete pivoting, relative to the `weights`
/// of the unknowns.
fn columns(matrix: &Mat<f64>, weights: &[f64]) -> Mat<f64> {
    let order = matrix.nrows();
    let scaled = |i: usize, k: usize| matrix[(i, k)] / (weights[i] * weights[k]);
    let mut diagonal: Vec<f64> = (0..order).map(|i| scaled(i, i)).collect();
    let mut found: Mat<f64> = Mat::zeros(order, order.min(MOST_COLUMNS));
    let mut count = 0;
    while count < found.ncols() {
        let left: f64 = diagonal.iter().map(|d| d.max(0.0)).sum();
        let pivot = (0..order).max_by(|x, y| diagonal[*x].total_cmp(&diagonal[*y]));
        let Some(pivot) = pivot.filter(|p| left > COLUMNS && diagonal[*p] > 0.0) else {
            break;
        };
        let known = found.subcols(0, count);
        let column = known * known.row(pivot).transpose();
        let root = diagonal[pivot].sqrt();
        for i in 0..order {
            let entry = (scaled(i, pivot) - column[i]) / root;
            diagonal[i] -= entry * entry;
            found[(i, count)] = entry;
        }
        diagonal[pivot] = 0.0;
        count += 1;
    }
    Mat::from_fn(order, count, |i, k| found[(i, k)] * weights[i])
}
