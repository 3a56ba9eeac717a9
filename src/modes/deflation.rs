//! Eigenvalues without the zeros of free rigid motions.
//!
//! For each such motion z, K(Ω)z = 0, the companion matrix A of (q, q̇) has a zero with the right vector (z,
//! 0) and the left vector (Dᵀz, z): the momentum zᵀ(q̇ + Dq) is constant. The zeros are mostly double and
//! defective, so that rounding alone turns them into ±√ε, which would appear as a slow wave or slow
//! divergence. They are removed exactly: A maps every state to one without momentum, and from these states
//! the displacements z without momentum are removed too (Marsden & Weinstein, Rep. Math. Phys. 5, 1974).

use faer::{Col, Mat, Scale, c64};

use crate::model::linalg::SymmetricEigen;
use crate::model::system::GyroscopicSystem;

use super::vectors::real_times;

/// A momentum below this share of the largest momentum of any displacement z is rounding.
const ROUNDING: f64 = 1e-10;

/// States (q, q̇/s) without the momentum and the displacement of free motions.
pub struct Deflation {
    /// Orthonormal basis of these states, 2N × (2N − number removed).
    pub kept: Mat<f64>,
    /// Removed displacements, N × their number.
    split_off: Mat<f64>,
}

impl Deflation {
    /// Deflation of the companion matrix in units of time 1/s = 1/`scale`. `None` if no rigid motion is free, or
    /// if a stiffness that was added later holds one of the free motions.
    pub fn new(system: &GyroscopicSystem, speed_rad_per_s: f64, scale: f64) -> Option<Self> {
        let (size, free) = (system.order(), &system.free_rigid);
        if free.is_empty() {
            return None;
        }
        let stiffness = system.stiffness_at(speed_rad_per_s);
        let noise = ROUNDING * stiffness.norm_max();
        if free.iter().any(|z| (&stiffness * z).norm_max() > noise) {
            return None;
        }
        let velocity = system.velocity_at(speed_rad_per_s);
        let momentum: Vec<Col<f64>> = free
            .iter()
            .map(|z| Scale(1.0 / scale) * velocity.transpose() * z)
            .collect();
        let split_off = displacements_without_momentum(free, &momentum);
        let taken = free.len() + split_off.ncols();
        let out = Mat::from_fn(2 * size, taken, |i, k| match free.get(k) {
            Some(_) if i < size => momentum[k][i],
            Some(z) => z[i - size],
            None if i < size => split_off[(i, k - free.len())],
            None => 0.0,
        });
        let whole = out.qr().compute_Q();
        Some(Deflation {
            kept: whole.subcols(taken, 2 * size - taken).to_owned(),
            split_off,
        })
    }

    /// q of an eigenvector w of A in the reduced states, λ in units of s: the removed displacement follows
    /// from the condition that λ times the (z, 0)-component equals that of A(kept w), which is q̇.
    pub fn displacement(&self, lambda: c64, w: &Col<c64>) -> Col<c64> {
        let state = real_times(&self.kept, w);
        let size = self.split_off.nrows();
        let mut q = state.subrows(0, size).to_owned();
        if lambda != c64::new(0.0, 0.0) {
            let velocity = state.subrows(size, size).to_owned();
            let drift = real_times(&self.split_off.transpose().to_owned(), &velocity);
            q += Scale(lambda.inv()) * real_times(&self.split_off, &drift);
        }
        q
    }
}

/// Combinations of the z for which every zᵀDz′ vanishes.
fn displacements_without_momentum(free: &[Col<f64>], momentum: &[Col<f64>]) -> Mat<f64> {
    let count = free.len();
    // Element (i, k) is the product of momentum i and displacement k.
    let coupled = Mat::from_fn(count, count, |i, k| momentum[i].transpose() * &free[k]);
    let size = momentum.iter().fold(0.0_f64, |top, m| top.max(m.norm_l2()));
    let squares = SymmetricEigen::or_nan((coupled.transpose() * &coupled).as_ref());
    let without: Vec<usize> = (0..count)
        .filter(|&k| squares.values[k].max(0.0).sqrt() <= ROUNDING * size)
        .collect();
    Mat::from_fn(free[0].nrows(), without.len(), |i, k| {
        let combination = squares.vectors.col(without[k]);
        (0..count).map(|j| combination[j] * free[j][i]).sum()
    })
}
