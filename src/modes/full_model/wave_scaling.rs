//! Unknowns relative to the weights of the waves at rest.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use super::harmonic::Harmonic;

/// F with FFᵀ = G, block diagonal with a block for each phase of a harmonic.
#[derive(Debug)]
pub struct WaveScaling {
    blocks: Vec<Block>,
}

/// One block of F: the waves at rest, each times the root of its weight.
#[derive(Debug)]
pub struct Block {
    /// Index of the first unknown of the block.
    pub first: usize,
    factor: Mat<f64>,
    /// F⁻¹ of the block.
    pub inverse: Mat<f64>,
}

impl WaveScaling {
    pub fn new(harmonics: &[Harmonic]) -> Self {
        let blocks = harmonics.iter().flat_map(|h| {
            h.firsts().map(|first| {
                let (radial, waves) = (h.radial(), &h.resting.vectors);
                Block {
                    first,
                    factor: Mat::from_fn(radial, radial, |i, k| {
                        waves[(i, k)] * h.weights[k].sqrt()
                    }),
                    inverse: Mat::from_fn(radial, radial, |i, k| {
                        waves[(k, i)] / h.weights[i].sqrt()
                    }),
                }
            })
        });
        WaveScaling {
            blocks: blocks.collect(),
        }
    }

    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The block of an unknown.
    pub fn block_of(&self, unknown: usize) -> &Block {
        let place = self.blocks.partition_point(|block| block.first <= unknown);
        &self.blocks[place - 1]
    }

    /// F⁻¹ M.
    pub fn scaled(&self, matrix: MatRef<'_, f64>) -> Mat<f64> {
        self.times(|block| &block.inverse, matrix)
    }

    /// F M.
    pub fn unscaled(&self, matrix: MatRef<'_, f64>) -> Mat<f64> {
        self.times(|block| &block.factor, matrix)
    }

    fn times(&self, of: impl Fn(&Block) -> &Mat<f64>, matrix: MatRef<'_, f64>) -> Mat<f64> {
        let mut product = Mat::zeros(matrix.nrows(), matrix.ncols());
        for block in &self.blocks {
            let (own, size) = (of(block), block.inverse.nrows());
            let into = product.subrows_mut(block.first, size);
            let rows = matrix.subrows(block.first, size);
            matmul(into, Accum::Replace, own, rows, 1.0, Par::Seq);
        }
        product
    }
}
