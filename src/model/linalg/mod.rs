//! Eigenvalues, eigenvectors and singular values of dense matrices: the only calls of such solvers outside of tests.
//!
//! | decomposition | matrix | by |
//! |---|---|---|
//! | [`SymmetricEigen`], [`symmetric_eigenvalues`] | real, symmetric | divide and conquer, QR iteration |
//! | [`RealEigen`], [`real_eigenvalues`] | real | double-shift QR iteration, inverse iteration for wrong vectors |
//! | [`complex_eigenvalues`] | complex | single-shift QR iteration |
//! | [`RightSingular`] | real, rectangular | divide and conquer |
//!
//! Every result is checked where it is made. Each vector of [`RealEigen`] is checked by its own residual, because faer finds
//! single ones wrong, which are then found anew. Other vectors V and values Λ are checked with one vector x that has components
//! along all of them: ‖A(Vx) − V(Λx)‖ is a rounding error of ‖A‖‖Vx‖, and ‖Vᵀ(Vx) − x‖ one of ‖x‖ if the vectors are
//! orthonormal. This takes O(n²) operations, the decomposition O(n³), and an error e of a single vector changes the
//! residual by about e/√n (R. Freivalds, *Probabilistic machines can use less running time*, IFIP Congress 1977, 839–842).
//! Values alone are checked by the traces of the matrix and of its square.
//!
//! The module imports nothing of this crate.

#![expect(
    clippy::disallowed_methods,
    reason = "every result of a solver is checked here"
)]

mod complex;
mod inverse;
mod real;
mod singular;
mod symmetric;

pub(crate) use complex::complex_eigenvalues;
pub(crate) use real::{RealEigen, real_eigenvalues};
pub(crate) use singular::RightSingular;
pub(crate) use symmetric::{SymmetricEigen, symmetric_eigenvalues};

use faer::{Col, Mat, MatRef};
use nalgebra::{DMatrix, Scalar};

/// Reason for which a decomposition failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LinalgError {
    /// An entry is infinite or not a number.
    #[error("a matrix of order {order} is not finite")]
    NotFinite {
        /// Order of the matrix.
        order: usize,
    },
    /// The iteration did not converge.
    #[error("the {values} of a matrix of order {order} did not converge")]
    NoConvergence {
        /// What was to be found.
        values: &'static str,
        /// Order of the matrix.
        order: usize,
    },
    /// The result is not a decomposition of the matrix.
    #[error(
        "the {values} of a matrix of order {order} are wrong: their relative error is {error:.1e}"
    )]
    Inaccurate {
        /// What was to be found.
        values: &'static str,
        /// Order of the matrix.
        order: usize,
        /// Residual relative to the size of the matrix, departure from orthogonality, or error of a trace.
        error: f64,
    },
}

/// Largest relative error of a decomposition. Backward stable iterations have errors of 1e-16 to 1e-13 for orders up to
/// 1500; that of faer 0.24.4 without scaling has errors of 1e-4 to 1e-3.
const TOLERANCE: f64 = 1e-11;

/// A matrix of nalgebra for the solvers of this module.
pub(crate) fn view<T: Scalar>(matrix: &DMatrix<T>) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

/// What is decomposed, for errors.
#[derive(Clone, Copy)]
struct Sought {
    values: &'static str,
    order: usize,
}

impl Sought {
    fn finite(self, is_finite: bool) -> Result<(), LinalgError> {
        let Sought { order, .. } = self;
        if is_finite {
            Ok(())
        } else {
            Err(LinalgError::NotFinite { order })
        }
    }

    fn not_converged(self) -> LinalgError {
        let Sought { values, order } = self;
        LinalgError::NoConvergence { values, order }
    }

    /// Refuses an error above `most` and one that is not a number.
    fn within(self, error: f64, most: f64) -> Result<(), LinalgError> {
        let Sought { values, order } = self;
        if error <= most {
            Ok(())
        } else {
            Err(LinalgError::Inaccurate {
                values,
                order,
                error,
            })
        }
    }

    /// Refuses vectors that are not orthonormal, by the error of Vᵀ(Vx) = x for a vector x of their shares.
    fn orthonormal(self, vectors: &Mat<f64>, shares: &Col<f64>) -> Result<(), LinalgError> {
        let turned_back = vectors.transpose() * (vectors * shares) - shares;
        self.within(relative(turned_back.norm_l2(), shares.norm_l2()), TOLERANCE)
    }
}

/// A vector with components of similar size along all directions.
fn probe(order: usize) -> Col<f64> {
    Col::from_fn(order, |i| {
        let sine = (1.7 * i as f64 + 0.3).sin();
        sine + 0.5_f64.copysign(sine)
    })
}

/// Ratio of an error to a size; zero if both are zero.
fn relative(error: f64, size: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / size }
}

#[cfg(test)]
mod tests;
