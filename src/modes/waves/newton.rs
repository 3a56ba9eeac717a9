//! One eigenvalue of the reduced model, by Newton's method with the right and the left vector,
//! λ ← λ − yᴴL(λ)x / yᴴL′(λ)x (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, MatRef, Scale, c64};

use super::speed_series::WaveModel;
use crate::modes::vectors::unit;

/// Largest number of steps; convergence is cubic.
const STEPS: usize = 6;
/// Relative size of the last correction, after which only rounding remains, and its size in windows.
const TOLERANCE: f64 = 1e-9;
const ROUNDING: f64 = 1e-13;
/// Number of inverse iterations in the first step, which begins with an arbitrary vector.
const FIRST_ITERATIONS: usize = 4;
/// Distance of the shift from λ, relative and in windows, so that L is not exactly singular.
const BESIDE: f64 = 1e-9;

impl WaveModel {
    /// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ. A real one stays real. `None` if the iteration does not
    /// converge.
    pub fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        let sums = self.sums(speed_rad_per_s);
        let [values, slopes] = [0, 1].map(|column| sums.col_as_slice(column));
        let size = self.size();
        // The iteration must not start orthogonal to the vector that it has to find. These cosines are unrelated to the
        // shapes, so that practically no mode is orthogonal to them.
        let start = Col::from_fn(size, |i| c64::new((1.0 + i as f64).cos(), 0.0));
        let (mut mu, mut x, mut y) = (expected / self.window, start.clone(), start);
        for step in 0..STEPS {
            let [at, by_root] = polynomial(values, mu, size);
            let beside = BESIDE * (mu + 1.0);
            let factors = (&at + Scale(beside) * &by_root).partial_piv_lu();
            for _ in 0..if step == 0 { FIRST_ITERATIONS } else { 1 } {
                let right: Col<c64> = factors.solve(&by_root * &x);
                let left: Col<c64> = factors.solve_adjoint(by_root.adjoint() * &y);
                (x, y) = (unit(right.as_ref()), unit(left.as_ref()));
            }
            let change = -(y.adjoint() * (at * &x)) / (y.adjoint() * (&by_root * &x));
            mu += change;
            if !mu.is_finite() {
                return None;
            }
            if change.norm() <= TOLERANCE * mu.norm() + ROUNDING {
                if expected.im == 0.0 {
                    mu.im = 0.0;
                }
                let [moved, _] = polynomial(slopes, mu, size);
                let slope = -(y.adjoint() * (moved * &x)) / (y.adjoint() * (by_root * &x));
                let found = (mu * self.window, slope * self.window);
                return slope.is_finite().then_some(found);
            }
        }
        None
    }
}

/// Σ λᵏ L_k and its derivative with respect to λ, from the entries of L₀, L₁, ….
fn polynomial(entries: &[f64], mu: c64, size: usize) -> [Mat<c64>; 2] {
    let count = entries.len() / (size * size);
    let mut powers = vec![c64::ONE; count];
    for k in 1..count {
        powers[k] = powers[k - 1] * mu;
    }
    // Real and imaginary parts of λᵏ, then of its derivative.
    let weights = Mat::from_fn(count, 4, |k, part| match (part, k) {
        (0, _) => powers[k].re,
        (1, _) => powers[k].im,
        (_, 0) => 0.0,
        (2, _) => k as f64 * powers[k - 1].re,
        _ => k as f64 * powers[k - 1].im,
    });
    let sums = MatRef::from_column_major_slice(entries, size * size, count) * weights;
    [0, 2].map(|part| {
        Mat::from_fn(size, size, |i, k| {
            let row = k * size + i;
            c64::new(sums[(row, part)], sums[(row, part + 1)])
        })
    })
}
