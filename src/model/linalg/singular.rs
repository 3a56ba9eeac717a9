//! Singular values and right singular vectors.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::svd::{ComputeSvdVectors, svd, svd_scratch};
use faer::{Col, Mat, MatRef, Par, Spec};

use super::{LinalgError, Sought, TOLERANCE, probe, relative};

/// Singular values σ and right singular vectors of a matrix A = UΣVᵀ.
#[derive(Debug, Clone)]
pub(crate) struct RightSingular {
    /// Singular values, descending.
    pub values: Vec<f64>,
    /// Orthonormal right singular vectors in the columns, as many as singular values.
    pub vectors: Mat<f64>,
}

impl RightSingular {
    /// The singular values and right singular vectors of a matrix.
    ///
    /// # Errors
    /// [`LinalgError`].
    pub fn new(matrix: MatRef<'_, f64>) -> Result<Self, LinalgError> {
        let (rows, columns) = matrix.shape();
        let order = rows.min(columns);
        let sought = Sought {
            values: "singular vectors",
            order,
        };
        sought.finite(matrix.is_all_finite())?;
        let params = Spec::default();
        let thin = ComputeSvdVectors::Thin;
        let scratch = svd_scratch::<f64>(rows, columns, thin, thin, Par::Seq, params);
        let mut found = Diag::zeros(order);
        let (mut left, mut right) = (Mat::zeros(rows, order), Mat::zeros(columns, order));
        svd(
            matrix,
            found.as_mut(),
            Some(left.as_mut()),
            Some(right.as_mut()),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            params,
        )
        .map_err(|_| sought.not_converged())?;
        let values: Vec<f64> = (0..order).map(|k| found[k]).collect();
        // A(Vx) = U(Σx), Vᵀ(Vx) = x and Uᵀ(Ux) = x.
        let shares = probe(order);
        let sum = &right * &shares;
        let stretched = Col::from_fn(order, |k| values[k] * shares[k]);
        let residual = matrix * &sum - &left * stretched;
        let size = values.first().copied().unwrap_or_default() * sum.norm_l2();
        sought.within(relative(residual.norm_l2(), size), TOLERANCE)?;
        for vectors in [&left, &right] {
            sought.orthonormal(vectors, &shares)?;
        }
        Ok(RightSingular {
            values,
            vectors: right,
        })
    }
}
