//! Real matrices without symmetry.
//!
//! faer's blocked QR iteration orders the eigenvalues of a window by exchanging neighbours. Two conjugate
//! pairs that are equal except for rounding cannot be exchanged (Z. Bai, J. Demmel, Linear Algebra Appl. 186,
//! 1993), and the iteration does not end; this occurs for damped free blades at rest, for which every wave is
//! double. The double-shift iteration without such a window takes at most 30 steps for each eigenvalue. faer
//! does not report whether 30 steps were enough, but the traces of the matrix and of its square show it.
//!
//! Vectors are not checked: faer finds those of complex pairs by Cramer's rule, so that residuals of pairs that are nearly
//! equal reach 7e-3 of the norm (order 239, every wave of a damped free blade double; `docs/development/upstream.md`). A mode
//! that is reported has its backward error on the full model.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::{Auto, Col, Mat, MatMut, MatRef, Par, Spec, c64};

use super::complex::trace_error;
use super::{LinalgError, Sought};

/// Largest error of a trace, relative to the size of the matrix. A backward stable iteration has errors of 1e-13.
pub(super) const TRACE_TOLERANCE: f64 = 1e-9;

/// Eigenvalues and eigenvectors of a real matrix.
#[derive(Debug)]
pub(crate) struct RealEigen {
    /// Eigenvalues; conjugates are neighbours, the one with Im λ > 0 first.
    pub values: Vec<c64>,
    /// The vector of a real λ in its column; for conjugates the real part of the first vector in the first
    /// column, its imaginary part in the second.
    columns: Mat<f64>,
}

impl RealEigen {
    /// The eigenvalues and eigenvectors of a matrix.
    ///
    /// # Errors
    /// [`LinalgError`].
    pub fn new(matrix: MatRef<'_, f64>) -> Result<Self, LinalgError> {
        let order = matrix.nrows();
        let mut columns = Mat::zeros(order, order);
        let values = solve(matrix, Some(columns.as_mut()))?;
        Ok(RealEigen { values, columns })
    }

    /// The eigenvector of value `i`.
    pub fn vector(&self, i: usize) -> Col<c64> {
        let halves = self.halves_of(&[i]);
        Col::from_fn(halves.nrows(), |row| {
            c64::new(halves[(row, 0)], halves[(row, 1)])
        })
    }

    /// Real and imaginary parts of vectors side by side, two columns each.
    pub fn halves_of(&self, places: &[usize]) -> Mat<f64> {
        Mat::from_fn(self.columns.nrows(), 2 * places.len(), |row, k| {
            let i = places[k / 2];
            match (k % 2, self.values[i].im) {
                (0, im) if im >= 0.0 => self.columns[(row, i)],
                (0, _) => self.columns[(row, i - 1)],
                (_, im) if im > 0.0 => self.columns[(row, i + 1)],
                (_, im) if im < 0.0 => -self.columns[(row, i)],
                _ => 0.0,
            }
        })
    }

    /// Indices of the λ with Im λ ≥ 0.
    pub fn upper(&self) -> Vec<usize> {
        let all = 0..self.values.len();
        all.filter(|&i| self.values[i].im >= 0.0).collect()
    }
}

/// The eigenvalues alone.
///
/// # Errors
/// [`LinalgError`].
pub(crate) fn real_eigenvalues(matrix: MatRef<'_, f64>) -> Result<Vec<c64>, LinalgError> {
    solve(matrix, None)
}

fn solve(
    matrix: MatRef<'_, f64>,
    vectors: Option<MatMut<'_, f64>>,
) -> Result<Vec<c64>, LinalgError> {
    let order = matrix.nrows();
    let sought = Sought {
        values: "eigenvalues",
        order,
    };
    sought.finite(matrix.is_all_finite())?;
    let mut params = <EvdParams as Auto<f64>>::auto();
    params.schur.blocking_threshold = usize::MAX;
    let right = match vectors {
        Some(_) => ComputeEigenvectors::Yes,
        None => ComputeEigenvectors::No,
    };
    let left = ComputeEigenvectors::No;
    let scratch = evd_scratch::<f64>(order, left, right, Par::Seq, Spec::from(params));
    let (mut re, mut im) = (Diag::zeros(order), Diag::zeros(order));
    evd_real(
        matrix,
        re.as_mut(),
        im.as_mut(),
        None,
        vectors,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::from(params),
    )
    .map_err(|_| sought.not_converged())?;
    let values: Vec<c64> = (0..order).map(|i| c64::new(re[i], im[i])).collect();
    sought.within(trace_error(matrix, &values), TRACE_TOLERANCE)?;
    Ok(values)
}
