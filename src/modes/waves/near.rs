//! Which unknowns of an interval of speeds are kept.
//!
//! A wave is near if |ω − nΩ| is below the cut anywhere in the interval, or if it is reflected there, ω < nΩ (rule 1).
//! Of the columns of dampers those directions are kept in which h c pᵀD⁻¹p exceeds [`STRONG`] for the far waves
//! (rule 2): their displacement is a coordinate, and the far waves are eliminated with it held. No far block then
//! has an eigenvalue inside the cut.

use faer::Mat;

use super::blade::{Block, Saw};
use crate::model::linalg::SymmetricEigen;

/// Force of a damper beside the stiffness of the far waves, at the top of the window, above which it is kept.
pub const STRONG: f64 = 0.1;

/// The waves of one block over an interval.
pub struct NearBlock {
    /// v_k in the middle of the interval, J × J, near ones first.
    pub vectors: Mat<f64>,
    /// Number of near waves; a cosine and a sine each for n > 0.
    pub near: usize,
}

/// A set of columns P as P R, and P κ Pᵀ = (P R) diag(κ weight) (P R)ᵀ.
pub struct Rotation {
    /// R.
    pub matrix: Mat<f64>,
    /// Weights of the rotated columns.
    pub weights: Vec<f64>,
    /// Number of rotated columns that are kept, the first ones.
    pub strong: usize,
}

/// Waves and displacements of dampers that are kept over an interval.
pub struct Near {
    /// By number of nodal diameters.
    pub blocks: Vec<NearBlock>,
    /// Rotation of each set of columns; `None` if all of them are eliminated as they are.
    pub rotations: Vec<Option<Rotation>>,
}

/// Whether a wave with ω² is near; `turned` is nΩ.
pub fn is_near(square: f64, turned: f64, cut: f64) -> bool {
    let frequency = square.signum() * square.abs().sqrt();
    frequency < turned || frequency - turned < cut
}

impl Near {
    /// The coordinates that are kept from `from` to `to`, in rad/s, for a window and a cut in 1/s.
    pub fn new(saw: &Saw, (from, to): (f64, f64), (window, cut): (f64, f64)) -> Self {
        let middle = 0.5 * (from + to);
        let mut blocks = Vec::new();
        for block in &saw.blocks {
            let n = block.diameters as f64;
            let count = |squares: &[f64], speed: f64| {
                let near = squares.iter().filter(|s| is_near(**s, n * speed, cut));
                near.count()
            };
            let (inner, vectors) = block.waves(middle);
            let near = [from, to].map(|speed| count(&block.waves(speed).0, speed));
            blocks.push(NearBlock {
                vectors,
                near: count(&inner, middle).max(near[0]).max(near[1]),
            });
        }
        let mut near = Near {
            blocks,
            rotations: Vec::new(),
        };
        for k in 0..saw.columns.len() {
            let rotation = near.rotation(saw, k, middle, window);
            near.rotations.push(rotation);
        }
        near
    }

    /// These waves, with the strong dampers of another choice of waves.
    pub fn with_dampers_of(mut self, other: Near) -> Self {
        self.rotations = other.rotations;
        self
    }

    /// Number of nodal diameters of each unknown that is kept; `None` for displacements of dampers.
    pub fn diameters(&self) -> Vec<Option<usize>> {
        let waves = self.blocks.iter().enumerate();
        let waves = waves.flat_map(|(n, block)| {
            let copies = 1 + usize::from(n > 0);
            vec![Some(n); copies * block.near]
        });
        vec![None; self.strong()].into_iter().chain(waves).collect()
    }

    /// Number of displacements of columns that are kept.
    pub fn strong(&self) -> usize {
        self.rotations.iter().flatten().map(|r| r.strong).sum()
    }

    /// Directions of a set of columns by h c pᵀD⁻¹p, largest first, scaled such that pᵀD⁻¹p = 1 for those that are kept.
    fn rotation(&self, saw: &Saw, set: usize, speed: f64, window: f64) -> Option<Rotation> {
        let columns = &saw.columns[set];
        if columns.damping == 0.0 {
            return None;
        }
        let rank = columns.vectors.ncols();
        let mut soft = Mat::zeros(rank, rank);
        for (block, near) in saw.blocks.iter().zip(&self.blocks) {
            let stiffness = far_stiffness(block, near, speed);
            for copy in 0..block.copies() {
                let own = columns
                    .vectors
                    .subrows(block.first + copy * block.radial, block.radial);
                let far = near.vectors.subcols(near.near, stiffness.len());
                let own = far.transpose() * own;
                let weighed = Mat::from_fn(own.nrows(), rank, |i, k| {
                    own[(i, k)] / stiffness[i].abs().sqrt()
                });
                soft += weighed.transpose() * &weighed;
            }
        }
        let eigen = SymmetricEigen::or_nan(soft.as_ref());
        let values: Vec<f64> = eigen.values.iter().copied().rev().collect();
        let is_strong = |value: &f64| window * columns.damping * value > STRONG;
        let strong = values.iter().take_while(|v| is_strong(v)).count();
        if strong == 0 {
            return None;
        }
        let weight = |k: usize| if k < strong { values[k] } else { 1.0 };
        let weights: Vec<f64> = (0..rank).map(weight).collect();
        let matrix = Mat::from_fn(rank, rank, |i, k| {
            eigen.vectors[(i, rank - 1 - k)] / weights[k].sqrt()
        });
        Some(Rotation {
            matrix,
            weights,
            strong,
        })
    }
}

/// ω² − n²Ω² of the far waves.
fn far_stiffness(block: &Block, near: &NearBlock, speed: f64) -> Vec<f64> {
    let (squares, _) = block.waves(speed);
    let turned = (block.diameters as f64 * speed).powi(2);
    squares[near.near..].iter().map(|s| s - turned).collect()
}
