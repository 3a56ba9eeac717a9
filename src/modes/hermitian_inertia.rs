//! The inertia of a symmetric or Hermitian matrix.

use faer::linalg::solvers::Lblt;
use faer::traits::ComplexField;
use faer::traits::math_utils::{abs2, real};
use faer::{Mat, Side};

/// Number of negative eigenvalues of a Hermitian matrix, whose lower triangle is read: by Sylvester's law
/// that of B in A = PᵀLBLᴴP (J. R. Bunch & L. Kaufman, Math. Comp. 31, 1977). `None` if it is singular to
/// working precision.
pub fn negative_eigenvalues<T: ComplexField<Real = f64>>(matrix: &Mat<T>) -> Option<usize> {
    let factors = Lblt::new(matrix.as_ref(), Side::Lower);
    let (diagonal, below) = (factors.B_diag(), factors.B_subdiag());
    let order = matrix.nrows();
    let mut negative = 0;
    let mut k = 0;
    while k < order {
        let own = real(&diagonal[k]);
        let coupling = abs2(&below[k]);
        if coupling == 0.0 {
            if own == 0.0 || !own.is_finite() {
                return None;
            }
            negative += usize::from(own < 0.0);
            k += 1;
            continue;
        }
        let next = real(&diagonal[k + 1]);
        let determinant = own * next - coupling;
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        negative += match (determinant < 0.0, own + next < 0.0) {
            (true, _) => 1,
            (false, true) => 2,
            (false, false) => 0,
        };
        k += 2;
    }
    Some(negative)
}

#[cfg(test)]
mod tests {
    use faer::{Scale, c64};

    use super::*;

    /// Reference: all eigenvalues, for matrices of every size up to 40, some of which need pivots of order
    /// two.
    #[test]
    fn the_signs_are_those_of_the_eigenvalues() {
        let mut state = 1.0_f64;
        let mut draw = || {
            state = (state * 997.0 + 0.123).fract();
            state - 0.5
        };
        for order in 1..40 {
            let drawn = Mat::from_fn(order, order, |_, _| c64::new(draw(), draw()));
            let mut matrix = Scale(c64::new(0.5, 0.0)) * (&drawn + drawn.adjoint());
            if order % 2 == 0 {
                for i in 0..order {
                    matrix[(i, i)] = c64::new(0.0, 0.0);
                }
            }
            let values = matrix.self_adjoint_eigenvalues(Side::Lower).unwrap();
            let exact = values.iter().filter(|value| **value < 0.0).count();
            assert_eq!(negative_eigenvalues(&matrix), Some(exact), "order {order}");
        }
        assert_eq!(negative_eigenvalues(&Mat::<f64>::zeros(3, 3)), None);
    }
}
