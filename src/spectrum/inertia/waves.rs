//! L in the waves of the free blade, of which B_n is diagonal.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, Par, c64};

use super::coupling::Columns;
use super::jacobi::Eigenvectors;
use super::{BoundedBlock, Harmonic};
use crate::spectrum::hermitian::negative_eigenvalues;

/// A wave of which |p|²/|d| is above this is not eliminated: what is added for it would drown the rest.
const RESONANT: f64 = 1e5;

/// The waves of a speed.
#[derive(Debug)]
pub struct Waves {
    /// Eigenvalues of the blocks.
    stiffness: Vec<f64>,
    /// Rows of the columns for cosines, and below them for sines.
    both: Mat<f64>,
    /// The squares of both together.
    size: Vec<f64>,
}

impl Waves {
    /// With the first columns alone.
    pub fn new(free: &[Eigenvectors], columns: &Columns, count: usize) -> Self {
        let rows = columns.resting.nrows() / 2;
        let mut both = Mat::zeros(2 * rows, count);
        let mut stiffness = Vec::with_capacity(rows);
        for block in free {
            let (row, radial) = (stiffness.len(), block.values.len());
            let turn = Mat::from_fn(radial, radial, |i, j| block.vectors[(j, i)]);
            for first in [row, rows + row] {
                let own = columns.resting.get(first..first + radial, ..count);
                let turned = both.subrows_mut(first, radial);
                matmul(turned, Accum::Replace, &turn, own, 1.0, Par::Seq);
            }
            stiffness.extend(&block.values);
        }
        let mut size = vec![0.0; rows];
        for k in 0..count {
            let (cosine, sine) = both.col_as_slice(k).split_at(rows);
            for (size, (x, y)) in size.iter_mut().zip(cosine.iter().zip(sine)) {
                *size += x * x + y * y;
            }
        }
        Waves {
            size,
            stiffness,
            both,
        }
    }

    /// n₋(A + PPᴴ) by way of −1 − PᴴA⁻¹P over the waves that are eliminated, bordered by those that are
    /// next to resonance.
    pub fn count(&self, harmonics: &[Harmonic], bounds: &[BoundedBlock]) -> Option<usize> {
        let rows = self.stiffness.len();
        // Sum and difference of 1/d of the waves e^{inθ} and e^{−inθ}.
        let (mut sum, mut difference) = (vec![0.0; rows], vec![0.0; rows]);
        let mut resonant: Vec<Resonant> = Vec::new();
        let mut negative = 0;
        let mut row = 0;
        for (harmonic, bound) in harmonics.iter().zip(bounds) {
            for _ in 0..harmonic.radial() {
                let stiffness = (1.0 + bound.share) * self.stiffness[row] + bound.more;
                for sign in harmonic.signs() {
                    let turned = [1.0, -1.0][sign];
                    let d = stiffness - bound.turning[sign];
                    if self.size[row] > RESONANT * d.abs() {
                        resonant.push(Resonant { row, turned, d });
                        continue;
                    }
                    negative += usize::from(d < 0.0);
                    sum[row] += 1.0 / d;
                    difference[row] += turned / d;
                }
                row += 1;
            }
        }
        let core = self.core([&sum, &difference], &resonant);
        (negative + negative_eigenvalues(&core)?).checked_sub(self.both.ncols())
    }

    /// Each row of the columns times its weight, of cosines and of sines.
    fn scaled(&self, weights: [&[f64]; 2]) -> Mat<f64> {
        let (rows, count) = (self.stiffness.len(), self.both.ncols());
        let mut scaled = Mat::zeros(2 * rows, count);
        for k in 0..count {
            let own = self.both.col_as_slice(k);
            let scaled = scaled.col_as_slice_mut(k);
            for (half, weight) in weights.into_iter().enumerate() {
                let range = half * rows..(half + 1) * rows;
                let pairs = scaled[range.clone()].iter_mut().zip(&own[range]);
                for ((scaled, x), w) in pairs.zip(weight) {
                    *scaled = x * w;
                }
            }
        }
        scaled
    }

    /// [[D, P], [Pᴴ, −1 − PᴴA⁻¹P]], D and P of the resonant waves, each scaled to the length of its row;
    /// its lower triangle.
    fn core(&self, [sum, difference]: [&[f64]; 2], resonant: &[Resonant]) -> Mat<c64> {
        let (rows, count) = (self.stiffness.len(), self.both.ncols());
        let (cosine, sine) = self.both.split_at_row(rows);
        // CᵀΣC + SᵀΣS, of which the lower triangle, and SᵀΔC.
        let mut scaled = self.scaled([sum, sum]);
        let mut real = Mat::zeros(count, count);
        triangular::matmul(
            real.as_mut(),
            BlockStructure::TriangularLower,
            Accum::Replace,
            self.both.transpose(),
            BlockStructure::Rectangular,
            scaled.as_ref(),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
        for k in 0..count {
            let own = &self.both.col_as_slice(k)[..rows];
            let scaled = scaled.col_as_slice_mut(k)[..rows].iter_mut();
            for ((scaled, x), w) in scaled.zip(own).zip(difference) {
                *scaled = x * w;
            }
        }
        let scaled = scaled.subrows(0, rows);
        let mixed = sine.transpose() * scaled;
        let near = resonant.len();
        let mut core = Mat::zeros(near + count, near + count);
        for (i, wave) in resonant.iter().enumerate() {
            let size = self.size[wave.row].sqrt();
            let factor = if size > 0.0 { 1.0 / size } else { 1.0 };
            core[(i, i)] = c64::new(factor * factor * wave.d, 0.0);
            for k in 0..count {
                let (cosine, sine) = (cosine[(wave.row, k)], sine[(wave.row, k)]);
                core[(near + k, i)] = c64::new(factor * cosine, factor * wave.turned * sine);
            }
        }
        for k in 0..count {
            for i in k..count {
                let unit = if i == k { 1.0 } else { 0.0 };
                let imaginary = mixed[(i, k)] - mixed[(k, i)];
                core[(near + i, near + k)] = c64::new(-unit - real[(i, k)], -imaginary);
            }
        }
        core
    }
}

/// A wave next to resonance.
struct Resonant {
    row: usize,
    /// Of e^{inθ} 1, of e^{−inθ} −1.
    turned: f64,
    d: f64,
}
