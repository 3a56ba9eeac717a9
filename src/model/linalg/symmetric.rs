//! Symmetric matrices.
//!
//! From order 128 on faer finds vectors by divide and conquer, and ends the search for each root of the secular equation where
//! this function changes by less than 1e-16. The function has the inverse unit of the matrix: for a stiffness in 1/s², 1e10
//! and more, this leaves residuals of 1e-3 of the norm (faer 0.24.4, `docs/development/upstream.md`). The matrix is
//! therefore scaled by a power of two to entries of about one, which is exact. Residuals are then 1e-14 of the norm at order
//! 1458, in half the time of the QR iteration (299 and 555 ms).

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Col, Mat, MatMut, MatRef, Par, Spec};

use super::{LinalgError, Sought, TOLERANCE, probe, relative};

/// Eigenvalues and eigenvectors of a symmetric matrix, whose lower triangle is read.
#[derive(Debug, Clone)]
pub(crate) struct SymmetricEigen {
    /// Eigenvalues, ascending.
    pub values: Vec<f64>,
    /// Orthonormal eigenvectors in the columns.
    pub vectors: Mat<f64>,
}

impl SymmetricEigen {
    /// The eigenvalues and eigenvectors of a matrix.
    ///
    /// # Errors
    /// [`LinalgError`].
    pub fn new(matrix: MatRef<'_, f64>) -> Result<Self, LinalgError> {
        let order = matrix.nrows();
        let mut vectors = Mat::zeros(order, order);
        let values = solve(matrix, Some(vectors.as_mut()))?;
        let eigen = SymmetricEigen { values, vectors };
        eigen.checked(matrix)
    }

    /// As [`SymmetricEigen::new`], and NaN in place of an error: for matrices that are only parts of a model, whose
    /// eigenproblems then fail because it is not finite.
    pub fn or_nan(matrix: MatRef<'_, f64>) -> Self {
        let order = matrix.nrows();
        Self::new(matrix).unwrap_or_else(|_| SymmetricEigen {
            values: vec![f64::NAN; order],
            vectors: Mat::full(order, order, f64::NAN),
        })
    }

    pub(super) fn checked(self, matrix: MatRef<'_, f64>) -> Result<Self, LinalgError> {
        let order = matrix.nrows();
        let sought = Sought {
            values: "eigenvectors",
            order,
        };
        let shares = probe(order);
        let sum = &self.vectors * &shares;
        let stretched = Col::from_fn(order, |k| self.values[k] * shares[k]);
        let residual = times(matrix, &sum) - &self.vectors * stretched;
        let size = largest(&self.values) * sum.norm_l2();
        sought.within(relative(residual.norm_l2(), size), TOLERANCE)?;
        sought.orthonormal(&self.vectors, &shares)?;
        Ok(self)
    }
}

/// The eigenvalues of a symmetric matrix, whose lower triangle is read, ascending.
///
/// # Errors
/// [`LinalgError`].
pub(crate) fn symmetric_eigenvalues(matrix: MatRef<'_, f64>) -> Result<Vec<f64>, LinalgError> {
    let values = solve(matrix, None)?;
    let order = matrix.nrows();
    let unit = largest(&values);
    let (mut trace, mut square) = (0.0, 0.0);
    for k in 0..order {
        let own = relative(matrix[(k, k)], unit);
        trace += own;
        square += own * own;
        let below = (k + 1..order).map(|i| relative(matrix[(i, k)], unit).powi(2));
        square += 2.0 * below.sum::<f64>();
    }
    let shares = || values.iter().map(|value| relative(*value, unit));
    let sum: f64 = shares().sum();
    let sum_of_squares: f64 = shares().map(|share| share * share).sum();
    let size = order as f64;
    let error = (sum - trace).abs().max((sum_of_squares - square).abs());
    let sought = Sought {
        values: "eigenvalues",
        order,
    };
    sought.within(relative(error, size), TOLERANCE)?;
    Ok(values)
}

fn solve(
    matrix: MatRef<'_, f64>,
    vectors: Option<MatMut<'_, f64>>,
) -> Result<Vec<f64>, LinalgError> {
    let order = matrix.nrows();
    let (values, with_vectors) = match vectors {
        Some(_) => ("eigenvectors", ComputeEigenvectors::Yes),
        None => ("eigenvalues", ComputeEigenvectors::No),
    };
    let sought = Sought { values, order };
    let column = |k: usize| (k..order).map(move |i| matrix[(i, k)].abs());
    let most = (0..order).flat_map(column).fold(0.0, f64::max);
    sought.finite((0..order).flat_map(column).all(f64::is_finite))?;
    let unit = if most > 0.0 {
        most.log2().round().exp2()
    } else {
        1.0
    };
    let scaled = Mat::from_fn(order, order, |i, k| matrix[(i.max(k), i.min(k))] / unit);
    let params = Spec::default();
    let scratch = self_adjoint_evd_scratch::<f64>(order, with_vectors, Par::Seq, params);
    let mut found = Diag::zeros(order);
    self_adjoint_evd(
        scaled.as_ref(),
        found.as_mut(),
        vectors,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        params,
    )
    .map_err(|_| sought.not_converged())?;
    Ok((0..order).map(|k| unit * found[k]).collect())
}

/// Largest magnitude of the eigenvalues.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// A x of a symmetric A, whose lower triangle is read.
fn times(matrix: MatRef<'_, f64>, x: &Col<f64>) -> Col<f64> {
    let order = matrix.nrows();
    let mut product = Col::zeros(order);
    for k in 0..order {
        let mut sum = matrix[(k, k)] * x[k];
        for i in k + 1..order {
            product[i] += matrix[(i, k)] * x[k];
            sum += matrix[(i, k)] * x[i];
        }
        product[k] += sum;
    }
    product
}
