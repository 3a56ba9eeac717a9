//! One eigenvalue of the reduced model, by Newton's method with the right and the left vector,
//! λ ← λ − yᴴL(λ)x / yᴴL′(λ)x (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use super::over_speed::WaveModel;
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
            let change = -(y.adjoint() * (at * &x)) / (y.adjoint() * (by_root * &x));
            mu += change;
            if !mu.is_finite() {
                return None;
            }
            if change.norm() <= TOLERANCE * mu.norm() + ROUNDING {
                if expected.im == 0.0 {
                    mu.im = 0.0;
                }
                let [_, by_root] = polynomial(values, mu, size);
                let [moved, _] = polynomial(slopes, mu, size);
                let slope = -(y.adjoint() * (moved * &x)) / (y.adjoint() * (by_root * &x));
                let found = (mu * self.window, slope * self.window);
                return slope.is_finite().then_some(found);
            }
        }
        None
    }
}

/// Σ λᵏ L_k and its derivative with respect to λ, by Horner's rule, from the entries of L₀, L₁, ….
fn polynomial(entries: &[f64], mu: c64, size: usize) -> [Mat<c64>; 2] {
    // Real and imaginary parts of the sums, then of their derivatives.
    let mut sums = vec![[0.0; 4]; size * size];
    for term in entries.chunks_exact(size * size).rev() {
        for ([re, im, slope_re, slope_im], entry) in sums.iter_mut().zip(term) {
            (*slope_re, *slope_im) = (
                *slope_re * mu.re - *slope_im * mu.im + *re,
                *slope_re * mu.im + *slope_im * mu.re + *im,
            );
            (*re, *im) = (*re * mu.re - *im * mu.im + entry, *re * mu.im + *im * mu.re);
        }
    }
    [0, 2].map(|part| {
        Mat::from_fn(size, size, |i, k| {
            let sum = sums[k * size + i];
            c64::new(sum[part], sum[part + 1])
        })
    })
}
