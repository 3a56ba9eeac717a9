//! L in the waves of the free blade, of which B_n is diagonal.

use faer::{Mat, c64};
use nalgebra::{DMatrix, SymmetricEigen};

use super::coupling::Columns;
use super::{BoundedBlock, Harmonic};
use crate::spectrum::hermitian::negative_eigenvalues;

/// A wave of which |p|²/|d| is above this is not eliminated: what is added for it would drown the rest.
const RESONANT: f64 = 1e5;

/// The waves of a speed.
#[derive(Debug)]
pub struct Waves {
    /// Eigenvalues of the blocks.
    stiffness: Vec<f64>,
    /// Rows of the columns for cosines and for sines, and the squares of both together.
    cosine: Mat<f64>,
    sine: Mat<f64>,
    size: Vec<f64>,
}

impl Waves {
    /// With the first columns alone.
    pub fn new(blocks: &[DMatrix<f64>], columns: &Columns, count: usize) -> Self {
        let rows = columns.cosine.nrows();
        let mut cosine = Mat::zeros(rows, count);
        let mut sine = Mat::zeros(rows, count);
        let mut stiffness = Vec::with_capacity(rows);
        for block in blocks {
            let eigen = SymmetricEigen::new(block.clone());
            let (row, radial) = (stiffness.len(), block.nrows());
            let turn = Mat::from_fn(radial, radial, |i, j| eigen.eigenvectors[(j, i)]);
            for (turned, own) in [(&mut cosine, &columns.cosine), (&mut sine, &columns.sine)] {
                turned
                    .subrows_mut(row, radial)
                    .copy_from(&turn * own.get(row..row + radial, ..count));
            }
            stiffness.extend(eigen.eigenvalues.iter());
        }
        let size = |row: usize| cosine.row(row).squared_norm_l2() + sine.row(row).squared_norm_l2();
        Waves {
            size: (0..rows).map(size).collect(),
            stiffness,
            cosine,
            sine,
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
        (negative + negative_eigenvalues(&core)?).checked_sub(self.cosine.ncols())
    }

    /// [[D, P], [Pᴴ, −1 − PᴴA⁻¹P]], D and P of the resonant waves, each scaled to the length of its row;
    /// its lower triangle.
    fn core(&self, [sum, difference]: [&[f64]; 2], resonant: &[Resonant]) -> Mat<c64> {
        let (cosine, sine) = (&self.cosine, &self.sine);
        let count = cosine.ncols();
        let real =
            cosine.transpose() * weighted(cosine, sum) + sine.transpose() * weighted(sine, sum);
        let mixed = sine.transpose() * weighted(cosine, difference);
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

/// Each row times its weight, column by column as they lie in memory.
fn weighted(matrix: &Mat<f64>, weight: &[f64]) -> Mat<f64> {
    let mut weighted = matrix.clone();
    for k in 0..matrix.ncols() {
        let column = weighted.col_as_slice_mut(k);
        column.iter_mut().zip(weight).for_each(|(x, w)| *x *= w);
    }
    weighted
}

/// A wave next to resonance.
struct Resonant {
    row: usize,
    /// Of e^{inθ} 1, of e^{−inθ} −1.
    turned: f64,
    d: f64,
}
