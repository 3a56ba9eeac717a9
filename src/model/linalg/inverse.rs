//! Eigenvectors of a real matrix by inverse iteration.
//!
//! A = QHQᵀ with a Hessenberg matrix H, once for all vectors; then (H − λ)x = y takes O(n²) operations for each. One
//! step is enough for a λ that is accurate to rounding (I. C. F. Ipsen, SIAM Review 39, 1997, 254–291).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::hessenberg::{hessenberg_in_place, hessenberg_in_place_scratch};
use faer::linalg::householder::{
    apply_block_householder_sequence_on_the_left_in_place_scratch as apply_scratch,
    apply_block_householder_sequence_on_the_left_in_place_with_conj as apply,
};
use faer::{Col, Conj, Mat, MatRef, Par, Scale, Spec, c64};

/// Largest residual of a vector, relative to ‖A‖‖v‖, that is left as it is. Those of faer reach 7e-14 where pairs are apart
/// (a spinning damped blade, order 242) and 1e-1 where they are double, for which inverse iteration reaches 7e-15.
pub(super) const ACCURATE: f64 = 1e-13;

/// Reflections that are applied together.
const BLOCK: usize = 16;

/// A/‖A‖ = QHQᵀ.
pub(super) struct Hessenberg {
    /// Q.
    pub turning: Mat<f64>,
    /// H; what is below its first subdiagonal is not read.
    hessenberg: Mat<f64>,
    /// ‖A‖.
    norm: f64,
}

impl Hessenberg {
    pub fn new(matrix: MatRef<'_, f64>) -> Self {
        let order = matrix.nrows();
        let rest = order.saturating_sub(1);
        let norm = matrix.norm_l2();
        let mut hessenberg = Mat::from_fn(order, order, |i, k| matrix[(i, k)] / norm);
        let mut factors = Mat::zeros(BLOCK, rest);
        let params = Spec::default();
        let scratch = hessenberg_in_place_scratch::<f64>(order, BLOCK, Par::Seq, params)
            .or(apply_scratch::<f64>(rest, BLOCK, rest));
        let mut memory = MemBuffer::new(scratch);
        hessenberg_in_place(
            hessenberg.as_mut(),
            factors.as_mut(),
            Par::Seq,
            MemStack::new(&mut memory),
            params,
        );
        let mut turning = Mat::identity(order, order);
        apply(
            hessenberg.submatrix(1, 0, rest, rest),
            factors.as_ref(),
            Conj::No,
            turning.as_mut().submatrix_mut(1, 1, rest, rest),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        Hessenberg {
            turning,
            hessenberg,
            norm,
        }
    }

    /// A unit eigenvector of H for the λ of A, from a vector `y` that may be wrong: the start from `y` keeps the vectors
    /// of a multiple λ independent. Where λ is defective, a start near the right vector is of no use, because the left
    /// one is orthogonal to it; then the start has components along all directions, different ones for each `place`.
    pub fn eigenvector(&self, lambda: c64, y: &Col<c64>, place: usize) -> Col<c64> {
        let mut found = self.solve(lambda, y);
        let is_accurate = f64::EPSILON * y.norm_l2() <= ACCURATE * found.norm_l2();
        if !is_accurate {
            let turn = (place + 1) as f64;
            let start = |k| c64::from((turn * k as f64).cos());
            found = self.solve(lambda, &Col::from_fn(y.nrows(), start));
        }
        Scale(c64::from(1.0 / found.norm_l2())) * found
    }

    /// x of (H − λ/‖A‖)x = εy, whose residual as an eigenvector is ε‖y‖/‖x‖.
    ///
    /// Columns are exchanged and subtracted from the last to the first, so that the product of H − λ/‖A‖ with these
    /// operations is triangular, and only two columns are kept at a time.
    fn solve(&self, lambda: c64, y: &Col<c64>) -> Col<c64> {
        let column = |k: usize, rows: usize| {
            let entries = (0..rows).map(|i| c64::from(self.hessenberg[(i, k)]));
            let mut column: Vec<c64> = entries.collect();
            column[k] -= lambda / self.norm;
            column
        };
        let pivot = |entry: c64| {
            if entry.norm() < f64::EPSILON {
                c64::from(f64::EPSILON)
            } else {
                entry
            }
        };
        let mut x = Scale(c64::from(f64::EPSILON)) * y;
        let order = x.nrows();
        let mut operations = Vec::with_capacity(order);
        let mut last = column(order - 1, order);
        for k in (1..order).rev() {
            let mut next = column(k - 1, k + 1);
            let exchanged = last[k].norm() < next[k].norm();
            if exchanged {
                std::mem::swap(&mut last, &mut next);
            }
            let divisor = pivot(last[k]);
            let share = next[k] / divisor;
            operations.push((k, exchanged, share));
            x[k] /= divisor;
            let known = x[k];
            next.truncate(k);
            for (i, (next, last)) in next.iter_mut().zip(&last).enumerate() {
                *next -= share * last;
                x[i] -= known * last;
            }
            last = next;
        }
        x[0] /= pivot(last[0]);
        for (k, exchanged, share) in operations.into_iter().rev() {
            let own = x[k] - share * x[k - 1];
            x[k] = if exchanged { x[k - 1] } else { own };
            if exchanged {
                x[k - 1] = own;
            }
        }
        x
    }
}
