//! Which unknowns of an interval of speeds are kept.
//!
//! A wave is near if |ω − nΩ| is below the cut anywhere in the interval, or if it is reflected there, ω < nΩ (rule 1).
//! Of the columns of dampers those directions are kept in which h c pᵀD⁻¹p exceeds [`STRONG`] for the far waves with
//! D = ω² (rule 2): their displacement is a coordinate, and the far waves are eliminated with it held. No far block then
//! has an eigenvalue inside the cut.

use faer::Mat;

use super::blade::{Block, STRONG, Saw};
use crate::model::linalg::SymmetricEigen;
use crate::model::scene::SpeedRange;

/// The waves of one block over an interval.
pub struct NearBlock {
    /// v_k in the middle of the interval, J × J, near ones first.
    pub vectors: Mat<f64>,
    /// Number of near waves; a cosine and a sine each for n > 0.
    pub near: usize,
}

/// Waves and displacements of dampers that are kept over an interval.
pub struct Near {
    /// By number of nodal diameters.
    pub blocks: Vec<NearBlock>,
    /// Columns p of the strong dampers, N × s, with pᵀD⁻¹p = 1 for the far waves, so that hC = Σ h c ppᵀ + ….
    pub dampers: Mat<f64>,
    /// h c of each.
    pub weights: Vec<f64>,
}

/// Whether a wave with ω² is near; `turned` is nΩ.
pub fn is_near(square: f64, turned: f64, cut: f64) -> bool {
    let frequency = square.signum() * square.abs().sqrt();
    frequency < turned || frequency - turned < cut
}

impl Near {
    /// The coordinates that are kept from `from` to `to`, in rad/s, for a cut in 1/s.
    pub fn new(saw: &Saw, range: SpeedRange, cut: f64) -> Self {
        // More waves are far at rest than at any other speed, so that more dampers are strong.
        let (dampers, weights) = strong(saw, &near_blocks(saw, SpeedRange::new(0.0, 0.0), cut));
        Near {
            blocks: near_blocks(saw, range, cut),
            dampers,
            weights,
        }
    }
}

fn near_blocks(saw: &Saw, range: SpeedRange, cut: f64) -> Vec<NearBlock> {
    let [from, to] = range.ends();
    let middle = 0.5 * (from + to);
    let of = |block: &Block| {
        let n = block.diameters as f64;
        let count = |squares: &[f64], speed: f64| {
            let near = squares.iter().filter(|s| is_near(**s, n * speed, cut));
            near.count()
        };
        let (inner, vectors) = block.waves(middle);
        let near = [from, to].map(|speed| count(&block.waves(speed).0, speed));
        NearBlock {
            vectors,
            near: count(&inner, middle).max(near[0]).max(near[1]),
        }
    };
    saw.blocks.iter().map(of).collect()
}

/// Columns and weights of the strong dampers for the waves that are near at rest: directions of P by h c pᵀD⁻¹p.
fn strong(saw: &Saw, near: &[NearBlock]) -> (Mat<f64>, Vec<f64>) {
    let rank = saw.dampers.ncols();
    let mut soft = Mat::zeros(rank, rank);
    for (block, near) in saw.blocks.iter().zip(near) {
        let stiffness = block.waves(0.0).0;
        let far = near.vectors.subcols(near.near, block.radial - near.near);
        for copy in 0..block.copies() {
            let first = block.first + copy * block.radial;
            let own = far.transpose() * saw.dampers.subrows(first, block.radial);
            let weighed = Mat::from_fn(own.nrows(), rank, |i, k| {
                own[(i, k)] / stiffness[near.near + i].abs().sqrt()
            });
            soft += weighed.transpose() * &weighed;
        }
    }
    let eigen = SymmetricEigen::or_nan(soft.as_ref());
    let largest_first = (0..rank).rev();
    let places: Vec<usize> = largest_first
        .filter(|k| eigen.values[*k] > STRONG)
        .collect();
    let weights: Vec<f64> = places.iter().map(|k| eigen.values[*k]).collect();
    let directions = Mat::from_fn(rank, places.len(), |i, k| {
        eigen.vectors[(i, places[k])] / weights[k].sqrt()
    });
    (&saw.dampers * directions, weights)
}
