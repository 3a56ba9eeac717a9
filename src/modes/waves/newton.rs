//! One eigenvalue of the reduced model, by Newton's method with the right and the left vector,
//! λ ← λ − yᴴL(λ)x / yᴴL′(λ)x (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, MatRef, Scale, c64};

use super::speed_series::WaveModel;
use crate::modes::double_eigenvalue::{Derivatives, Family};
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
                let [moved] = polynomial(slopes, mu, size);
                let slope = -(y.adjoint() * (moved * &x)) / (y.adjoint() * (by_root * &x));
                let found = (mu * self.window, slope * self.window);
                return slope.is_finite().then_some(found);
            }
        }
        None
    }
}

impl Family for WaveModel {
    fn order(&self) -> usize {
        self.size()
    }

    fn derivatives(&self, speed_rad_per_s: f64, lambda: c64) -> Derivatives {
        let sums = self.sums(speed_rad_per_s);
        let unit = self.window.recip();
        let [values, slopes] = [0, 1].map(|column| sums.col_as_slice(column));
        let times = |power: i32, matrix: Mat<c64>| Scale(c64::from(unit.powi(power))) * matrix;
        let [value, once, twice, thrice] = polynomial(values, lambda * unit, self.size());
        let [by_speed, by_both] = polynomial(slopes, lambda * unit, self.size());
        Derivatives {
            value,
            by_root: [times(1, once), times(2, twice), times(3, thrice)],
            by_speed: [by_speed, times(1, by_both)],
        }
    }
}

/// Σ λᵏ L_k and its first derivatives with respect to λ, from the entries of L₀, L₁, ….
fn polynomial<const ORDERS: usize>(entries: &[f64], mu: c64, size: usize) -> [Mat<c64>; ORDERS] {
    let count = entries.len() / (size * size);
    let mut powers = vec![c64::ONE; count];
    for k in 1..count {
        powers[k] = powers[k - 1] * mu;
    }
    // Real and imaginary parts of k (k − 1) … λ^(k − order), side by side for each order.
    let weights = Mat::from_fn(count, 2 * ORDERS, |k, part| {
        let order = part / 2;
        if k < order {
            return 0.0;
        }
        let factor: f64 = (0..order).map(|j| (k - j) as f64).product();
        let weight = powers[k - order] * factor;
        if part % 2 == 0 { weight.re } else { weight.im }
    });
    let sums = MatRef::from_column_major_slice(entries, size * size, count) * weights;
    std::array::from_fn(|order| {
        Mat::from_fn(size, size, |i, k| {
            let row = k * size + i;
            c64::new(sums[(row, 2 * order)], sums[(row, 2 * order + 1)])
        })
    })
}
