//! Vectors that contain the lowest modes of a slotted ring.

use faer::Mat;

use super::chain::Chain;
use crate::model::linalg::SymmetricEigen;

/// Number of blocks of the Krylov space. With 3 the c_n of waves that are not mixed are those with 6 to 1e-5, with 2 to 1e-4.
const BLOCKS: usize = 3;
/// Length of a vector, relative to its length before, from which on it is within the span of the others.
const DEPENDENT: f64 = 1e-8;

/// A basis, orthonormal by the mass, of the vectors x, (K + σM)⁻¹Mx … of the columns x of a matrix; `None` if a number is not finite.
pub fn krylov([stiffness, mass]: [&Chain; 2], shift: f64, start: &Mat<f64>) -> Option<Mat<f64>> {
    let factors = stiffness.plus(shift, mass).factorized()?;
    let mut space: Vec<Mat<f64>> = Vec::new();
    let mut next = start.clone();
    for _ in 0..BLOCKS {
        let block = orthonormal(mass, &space, next)?;
        next = factors.solved(&mass.times(&block));
        space.push(block);
    }
    let columns: usize = space.iter().map(Mat::ncols).sum();
    let mut basis = Mat::zeros(stiffness.order(), columns);
    let mut first = 0;
    for block in &space {
        basis.subcols_mut(first, block.ncols()).copy_from(block);
        first += block.ncols();
    }
    Some(basis)
}

/// The columns of a matrix, orthonormal by the mass among themselves and with those of other blocks, without those that depend on
/// others; `None` if a number is not finite.
fn orthonormal(mass: &Chain, known: &[Mat<f64>], columns: Mat<f64>) -> Option<Mat<f64>> {
    let mut columns = columns;
    let length = |inertia: &Mat<f64>, own: &Mat<f64>, k: usize| -> f64 {
        (0..own.nrows())
            .map(|i| own[(i, k)] * inertia[(i, k)])
            .sum()
    };
    let inertia = mass.times(&columns);
    for k in 0..columns.ncols() {
        let unit = length(&inertia, &columns, k).sqrt().recip();
        (0..columns.nrows()).for_each(|i| columns[(i, k)] *= unit);
    }
    for _ in 0..2 {
        for block in known {
            let shares = block.transpose() * mass.times(&columns);
            columns -= block * shares;
        }
        let gram = columns.transpose() * mass.times(&columns);
        let eigen = SymmetricEigen::new(gram.as_ref()).ok()?;
        let kept: Vec<usize> = (0..gram.nrows())
            .filter(|k| eigen.values[*k] > DEPENDENT)
            .collect();
        let scaled = Mat::from_fn(gram.nrows(), kept.len(), |i, k| {
            eigen.vectors[(i, kept[k])] / eigen.values[kept[k]].sqrt()
        });
        columns = columns * scaled;
    }
    Some(columns)
}
