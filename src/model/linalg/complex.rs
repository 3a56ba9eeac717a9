//! Complex matrices without symmetry.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_cplx, evd_scratch};
use faer::traits::ComplexField;
use faer::{Auto, MatRef, Par, Spec, c64};

use super::{LinalgError, Sought};

/// Largest error of a trace, relative to the size of the matrix. A backward stable iteration has errors of 1e-13.
pub(super) const TRACE_TOLERANCE: f64 = 1e-9;

/// The eigenvalues of a complex matrix, by the iteration without a window, as for real ones.
///
/// # Errors
/// [`LinalgError`].
pub(crate) fn complex_eigenvalues(matrix: MatRef<'_, c64>) -> Result<Vec<c64>, LinalgError> {
    let order = matrix.nrows();
    let sought = Sought {
        values: "eigenvalues",
        order,
    };
    sought.finite(matrix.is_all_finite())?;
    let mut params = <EvdParams as Auto<c64>>::auto();
    params.schur.blocking_threshold = usize::MAX;
    let none = ComputeEigenvectors::No;
    let scratch = evd_scratch::<c64>(order, none, none, Par::Seq, Spec::from(params));
    let mut found = Diag::zeros(order);
    evd_cplx(
        matrix,
        found.as_mut(),
        None,
        None,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        Spec::from(params),
    )
    .map_err(|_| sought.not_converged())?;
    let values: Vec<c64> = (0..order).map(|i| found[i]).collect();
    sought.within(trace_error(matrix, &values), TRACE_TOLERANCE)?;
    Ok(values)
}

/// Sum of the errors with which the sums of the values and of their squares are the traces of the matrix and of its
/// square, relative to the size of the matrix.
pub(super) fn trace_error<T>(matrix: MatRef<'_, T>, values: &[c64]) -> f64
where
    T: ComplexField<Real = f64> + Copy + Into<c64>,
{
    let unit = matrix.norm_max();
    if unit == 0.0 {
        return values.iter().map(|value| value.norm()).sum();
    }
    let order = matrix.nrows();
    let entry = |i: usize, k: usize| matrix[(i, k)].into() / unit;
    let (mut trace, mut square, mut size) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0), 0.0);
    for k in 0..order {
        trace += entry(k, k);
        for i in 0..order {
            square += entry(i, k) * entry(k, i);
            size += entry(i, k).norm_sqr();
        }
    }
    let sum: c64 = values.iter().map(|value| value / unit).sum();
    let sum_of_squares: c64 = values.iter().map(|value| (value / unit).powi(2)).sum();
    let of_trace = (sum - trace).norm() / (order as f64 * size).sqrt();
    let of_square = (sum_of_squares - square).norm() / size;
    of_trace + of_square
}
