//! The free blade by waves, and what couples them by columns.
//!
//! For each number n of nodal diameters the waves of the free blade at the speed Ω are the eigenvectors v_k of
//! B_n(Ω) = K_b + K_m + Ω²K_σ, J × J, symmetric, with ω_k² = v_kᵀ B_n v_k: a real pair cos nθ, sin nθ each. In a frame
//! fixed in space their frequencies are ω_k ± nΩ. Everything fixed in space is P κ(λ) Pᵀ with few columns P and
//! κ = κ₀ + λκ₁: springs have κ₀ = 1, dampers κ₁ = 1.

use faer::{Mat, Scale};

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

/// Matrices of one number of nodal diameters, cosines before sines.
pub struct Block {
    /// Number of nodal diameters n.
    pub diameters: usize,
    /// Index of the first unknown in the basis of the plate.
    pub first: usize,
    /// Number J of radial functions.
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

/// Columns with the same κ = κ₀ + λκ₁.
pub struct Columns {
    /// P, N × r.
    pub vectors: Mat<f64>,
    /// κ₀, dimensionless.
    pub stiffness: f64,
    /// κ₁, in s.
    pub damping: f64,
}

/// A saw by waves and columns.
pub struct Saw {
    /// Blocks of n = 0 … n_max.
    pub blocks: Vec<Block>,
    /// Everything fixed in space.
    pub columns: Vec<Columns>,
    /// Number N of unknowns.
    pub order: usize,
    /// Whether forces other than those of the columns couple the blocks.
    pub has_other_coupling: bool,
}

impl Saw {
    /// Blocks and columns of a plate. The trace of what the columns leave out, relative to the stiffness of the free
    /// blade plus `floor`², is at most [`COLUMNS`]. Loads at the rim and forces without a potential are not among them.
    pub fn new(plate: &Plate, floor: f64) -> Self {
        let block = |n: usize| Block {
            diameters: n,
            first: plate.offset(n),
            radial: plate.radial_functions(),
            system: GyroscopicSystem::of_harmonic(plate, n),
        };
        let blocks: Vec<Block> = (0..=plate.max_diameters()).map(block).collect();
        let weights = weights(&blocks, floor);
        let mut sets = Vec::new();
        let springs = plate.contact.stiffness();
        let dampers = plate.contact.damping();
        let share = springs.zip(dampers).and_then(|(k, c)| proportion(k, c));
        if let Some(springs) = springs {
            sets.push(Columns {
                vectors: columns(springs, &weights),
                stiffness: 1.0,
                damping: share.unwrap_or(0.0),
            });
        }
        if let (Some(dampers), None) = (dampers, share) {
            // In units of the window a damper counts by hC.
            let vectors = columns(&(Scale(floor) * dampers), &weights);
            sets.push(Columns {
                vectors,
                stiffness: 0.0,
                damping: 1.0 / floor,
            });
        }
        Saw {
            blocks,
            columns: sets,
            order: plate.degrees_of_freedom(),
            has_other_coupling: plate.edge_stiffness.is_some()
                || plate.contact.nonconservative_stiffness().is_some(),
        }
    }
}

/// Trace of what the columns leave out: with 1e-7 eigenvalues next to a coalescence are off by up to 1.4e-6 of the window, with
/// 1e-9 by 3e-10, with 1e-11 by 1e-11.
const COLUMNS: f64 = 1e-11;
/// Entries of a column below this share of the largest are rounding.
const ROUNDING: f64 = 1e-13;
/// Largest number of columns.
const MOST_COLUMNS: usize = 400;

/// Root of the stiffness of each function of the free blade plus that of a floor.
fn weights(blocks: &[Block], floor: f64) -> Vec<f64> {
    let of = |block: &Block| -> Vec<f64> {
        let stiffness = &block.system.stiffness;
        let own = (0..stiffness.nrows()).map(|i| stiffness[(i, i)].abs());
        own.map(|k| (k + floor * floor).sqrt()).collect()
    };
    blocks.iter().flat_map(of).collect()
}

/// c/k, if the dampers are the springs times a number.
fn proportion(springs: &Mat<f64>, dampers: &Mat<f64>) -> Option<f64> {
    let share = dampers.norm_l2() / springs.norm_l2();
    let rest = dampers - Scale(share) * springs;
    (rest.norm_l2() < 1e-12 * dampers.norm_l2()).then_some(share)
}

/// Columns of a positive matrix of low rank, by Cholesky factorization with complete pivoting, relative to the `weights`
/// of the unknowns.
fn columns(matrix: &Mat<f64>, weights: &[f64]) -> Mat<f64> {
    let order = matrix.nrows();
    let scaled = |i: usize, k: usize| matrix[(i, k)] / (weights[i] * weights[k]);
    let mut diagonal: Vec<f64> = (0..order).map(|i| scaled(i, i)).collect();
    let rounding = ROUNDING * diagonal.iter().fold(0.0, |a: f64, b| a.max(*b));
    let mut found: Mat<f64> = Mat::zeros(order, order.min(MOST_COLUMNS));
    let mut count = 0;
    while count < found.ncols() {
        let left: f64 = diagonal.iter().map(|d| d.max(0.0)).sum();
        let pivot = (0..order).max_by(|x, y| diagonal[*x].total_cmp(&diagonal[*y]));
        let Some(pivot) = pivot.filter(|p| left > COLUMNS && diagonal[*p] > rounding) else {
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
