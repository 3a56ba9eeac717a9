//! Real matrices without symmetry.
//!
//! faer's blocked QR iteration orders the eigenvalues of a window by exchanging neighbours. Two conjugate
//! pairs that are equal except for rounding cannot be exchanged (Z. Bai, J. Demmel, Linear Algebra Appl. 186,
//! 1993), and the iteration does not end; this occurs for damped free blades at rest, for which every wave is
//! double. The double-shift iteration without such a window takes at most 30 steps for each eigenvalue. faer
//! does not report whether 30 steps were enough, but the traces of the matrix and of its square show it.
//!
//! faer finds the vectors of complex pairs by Cramer's rule, so that residuals reach 1e-1 of the norm where pairs are
//! nearly equal (`docs/development/upstream.md`). Each vector is therefore checked by its own residual, which takes 2n³
//! operations beside 25n³ of the decomposition, and wrong ones are found anew by inverse iteration.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::{Auto, Col, Mat, MatMut, MatRef, Par, Spec, c64};

use super::complex::{TRACE_TOLERANCE, trace_error};
use super::inverse::{ACCURATE, Hessenberg};
use super::{LinalgError, Sought, TOLERANCE, relative};

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
        let eigen = RealEigen { values, columns };
        eigen.checked(matrix)
    }

    /// With vectors by inverse iteration in place of those that are not accurate.
    pub(super) fn checked(mut self, matrix: MatRef<'_, f64>) -> Result<Self, LinalgError> {
        let residuals = self.residuals(matrix);
        let is_accurate = |i: &usize| residuals[*i] <= ACCURATE;
        let wrong: Vec<usize> = (0..residuals.len()).filter(|i| !is_accurate(i)).collect();
        if wrong.is_empty() {
            return Ok(self);
        }
        let improved = self.improved(matrix, &wrong);
        let sought = Sought {
            values: "eigenvectors",
            order: matrix.nrows(),
        };
        for (k, residual) in improved.residuals(matrix).into_iter().enumerate() {
            sought.within(residual, TOLERANCE)?;
            let column = improved.columns.col(k);
            self.columns.col_mut(wrong[k]).copy_from(column);
        }
        Ok(self)
    }

    /// ‖Av − λv‖ / ‖A‖‖v‖ of the vector of each value.
    fn residuals(&self, matrix: MatRef<'_, f64>) -> Vec<f64> {
        let product = matrix * &self.columns;
        let norm = match matrix.norm_l2() {
            0.0 => 1.0,
            norm => norm,
        };
        let mut residuals = vec![0.0; self.values.len()];
        for i in self.upper() {
            let lambda = self.values[i];
            let pair = [i, i + usize::from(lambda.im > 0.0)];
            let complex = |columns: &Mat<f64>, row: usize| {
                if lambda.im > 0.0 {
                    c64::new(columns[(row, pair[0])], columns[(row, pair[1])])
                } else {
                    c64::from(columns[(row, i)])
                }
            };
            let (mut off, mut size) = (0.0, 0.0);
            for row in 0..self.columns.nrows() {
                let entry = complex(&self.columns, row);
                off += ((complex(&product, row) - lambda * entry) / norm).norm_sqr();
                size += entry.norm_sqr();
            }
            for k in pair {
                residuals[k] = relative(off, size).sqrt();
            }
        }
        residuals
    }

    /// The pairs at these places, conjugates together, with vectors by inverse iteration.
    fn improved(&self, matrix: MatRef<'_, f64>, places: &[usize]) -> RealEigen {
        let reduced = Hessenberg::new(matrix);
        let wrong = Mat::from_fn(matrix.nrows(), places.len(), |row, k| {
            self.columns[(row, places[k])]
        });
        let mut found = RealEigen {
            values: places.iter().map(|&i| self.values[i]).collect(),
            columns: reduced.turning.transpose() * wrong,
        };
        for k in found.upper() {
            let lambda = found.values[k];
            let vector = reduced.eigenvector(lambda, &found.vector(k), k);
            for (row, entry) in vector.iter().enumerate() {
                found.columns[(row, k)] = entry.re;
                if lambda.im > 0.0 {
                    found.columns[(row, k + 1)] = entry.im;
                }
            }
        }
        found.columns = &reduced.turning * &found.columns;
        found
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
