//! Few vectors that span the low modes of one harmonic of a free blade.

use faer::{Col, Mat, Side};

use crate::plate::Plate;
use crate::system::body_frame_stiffness;

use super::part::frequency_scale;
use super::projection::orthonormal;

/// Radial modes of one harmonic that are kept; the fourth is ten times above a chart.
const RADIAL_MODES: usize = 4;
/// Vectors closer than this to the span of the others are left out.
const SPAN_TOLERANCE: f64 = 1e-6;

/// Lowest body-frame modes of one harmonic at three speeds, for cos and sin alike.
/// On these the undamped free blade is exact.
pub fn of_harmonic(plate: &Plate, n: usize, range: (f64, f64)) -> Mat<f64> {
    let block = &plate.harmonics[n];
    let size = block.bending.nrows();
    // The rigid motion is decoupled to the last bit; it stays a vector of its own.
    let rigid = usize::from(plate.basis.has_rigid_motions() && n <= 1);
    let mut vectors = Vec::new();
    for speed in [range.0, 0.5 * (range.0 + range.1), range.1] {
        let stiffness = body_frame_stiffness(block, speed);
        let elastic = stiffness.get(rigid.., rigid..).to_owned();
        let shift = frequency_scale(plate).powi(2);
        for mode in lowest_symmetric(elastic, shift, RADIAL_MODES.min(size - rigid)) {
            let column = Col::from_fn(size, |i| if i < rigid { 0.0 } else { mode[i - rigid] });
            vectors.push(column);
        }
    }
    let elastic = orthonormal(size, &vectors, SPAN_TOLERANCE);
    let radial = Mat::from_fn(size, rigid + elastic.ncols(), |i, k| {
        match k.checked_sub(rigid) {
            Some(k) => {
                if i < rigid {
                    0.0
                } else {
                    elastic[(i, k)]
                }
            }
            None => f64::from(u8::from(i == k)),
        }
    });
    let phases = if n == 0 { 1 } else { 2 };
    let width = radial.ncols();
    Mat::from_fn(size * phases, width * phases, |i, k| {
        if i / size == k / width {
            radial[(i % size, k % width)]
        } else {
            0.0
        }
    })
}

/// Eigenvectors of the smallest eigenvalues of A, from the inverse of A + shift:
/// its Cholesky factor keeps the low modes accurate to their own size, where the
/// rounding of a direct solver is relative to the largest eigenvalue.
fn lowest_symmetric(mut matrix: Mat<f64>, shift: f64, count: usize) -> Vec<Col<f64>> {
    let size = matrix.nrows();
    for i in 0..size {
        matrix[(i, i)] += shift;
    }
    let Ok(factor) = matrix.llt(Side::Lower) else {
        return (0..size)
            .map(|k| Col::from_fn(size, |i| f64::from(u8::from(i == k))))
            .collect();
    };
    let mut inverse = Mat::<f64>::identity(size, size);
    faer::linalg::solvers::Solve::solve_in_place(&factor, &mut inverse);
    match inverse.self_adjoint_eigen(Side::Lower) {
        Ok(eigen) => (0..count)
            .map(|k| eigen.U().col(size - 1 - k).to_owned())
            .collect(),
        Err(_) => Vec::new(),
    }
}
