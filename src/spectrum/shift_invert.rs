//! The few eigenvalues of smallest magnitude of a large quadratic problem.
//!
//! With z = (q, q̇/s) the companion problem is A z = λ z. Its inverse shifted by a
//! real σ needs one factorization of L(σ) = σ² + σD + K, of half the order:
//! (A − σ)⁻¹(x, y): u = −L(σ)⁻¹((D + σ)x + y), v = x + σu. A Krylov–Schur iteration
//! on it finds the λ nearest to σ. A real shift keeps the arithmetic real, and σ > 0
//! is away from the spectrum of a stable saw, where σ = 0 is singular at every
//! critical speed.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::matrix_free::LinOp;
use faer::matrix_free::eigen::{PartialEigenParams, partial_eigen, partial_eigen_scratch};
use faer::reborrow::ReborrowMut;
use faer::{Col, Mat, MatMut, MatRef, Par, Scale, c64};

use crate::system::GyroscopicSystem;

use super::dense::{Eigenpair, by_magnitude, unit};
use super::mode::rigid_noise;

/// (A − σ)⁻¹ in units of s: eigenvalues s/(λ − σ).
#[derive(Debug)]
struct ShiftedInverse {
    factors: PartialPivLu<f64>,
    /// (D + σ) / s.
    coupling: Mat<f64>,
    /// σ / s.
    shift: f64,
}

impl LinOp<f64> for ShiftedInverse {
    fn apply_scratch(&self, _columns: usize, _par: Par) -> StackReq {
        StackReq::EMPTY
    }

    fn nrows(&self) -> usize {
        2 * self.coupling.nrows()
    }

    fn ncols(&self) -> usize {
        self.nrows()
    }

    fn apply(&self, mut out: MatMut<'_, f64>, rhs: MatRef<'_, f64>, _par: Par, _: &mut MemStack) {
        let (x, y) = rhs.split_at_row(self.coupling.nrows());
        let mut u = &self.coupling * x + y;
        self.factors.solve_in_place(&mut u);
        let (mut top, mut bottom) = out.rb_mut().split_at_row_mut(self.coupling.nrows());
        top.copy_from(Scale(-1.0) * &u);
        bottom.copy_from(x - Scale(self.shift) * &u);
    }

    fn conj_apply(
        &self,
        out: MatMut<'_, f64>,
        rhs: MatRef<'_, f64>,
        par: Par,
        stack: &mut MemStack,
    ) {
        self.apply(out, rhs, par, stack);
    }
}

/// Relative residual at which a Krylov vector is good enough to span a mode.
const TOLERANCE: f64 = 1e-11;

/// About `count` eigenpairs next to the shift σ = `shift_per_s`, Im λ ≥ 0, ‖q‖ = 1,
/// ordered by |λ|. Fewer come back when the iteration stalls.
pub fn lowest_eigenpairs(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    count: usize,
    shift_per_s: f64,
) -> Vec<Eigenpair> {
    let size = system.order();
    let wanted = (2 * count).min(2 * size);
    let velocity = system.velocity_at(speed_rad_per_s);
    let identity = Mat::<f64>::identity(size, size);
    let dynamic = system.stiffness_at(speed_rad_per_s)
        + Scale(shift_per_s) * &velocity
        + Scale(shift_per_s.powi(2)) * &identity;
    // Unit of time 1/σ: then shift and identity are both one.
    let unit_square = shift_per_s.powi(2);
    let operator = ShiftedInverse {
        factors: (Scale(1.0 / unit_square) * dynamic).partial_piv_lu(),
        coupling: Scale(1.0 / shift_per_s) * velocity + identity,
        shift: 1.0,
    };
    let start = Col::from_fn(2 * size, |i| {
        (0.7 * i as f64 + 0.3).sin() / (1.0 + i as f64).sqrt()
    });
    let start = Scale(1.0 / start.norm_l2()) * start;
    let params = PartialEigenParams {
        max_restarts: 20,
        ..Default::default()
    };
    let scratch = partial_eigen_scratch(&operator, wanted, Par::Seq, params);
    let mut vectors = Mat::zeros(2 * size, wanted);
    let mut values = vec![c64::new(0.0, 0.0); wanted];
    let info = partial_eigen(
        vectors.as_mut(),
        &mut values,
        &operator,
        start.as_ref(),
        TOLERANCE,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        params,
    );
    // Free rigid motions are known exactly; these are their rounded doubles.
    let free = rigid_noise(system);
    let pairs = (0..info.n_converged_eigen)
        .map(|i| {
            let lambda = (values[i].inv() + 1.0) * shift_per_s;
            (lambda, unit(vectors.col(i).subrows(0, size)))
        })
        .filter(|(lambda, _)| lambda.im >= 0.0 && lambda.is_finite())
        .filter(|(lambda, _)| lambda.norm() >= free)
        .collect();
    by_magnitude(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::{Scene, rad_per_s};
    use crate::spectrum::companion_eigenpairs;

    #[test]
    fn the_iteration_finds_what_the_dense_solver_finds() {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        let system = GyroscopicSystem::of_plate(&Plate::new(&Scene::paper(), resolution));
        for speed in [0.0, 1000.0, 2300.0] {
            let dense = companion_eigenpairs(&system, rad_per_s(speed)).unwrap();
            let few = lowest_eigenpairs(&system, rad_per_s(speed), 10, 100.0);
            assert!(few.len() >= 9);
            for (found, exact) in few.iter().zip(&dense).take(9) {
                let distance = (found.0 - exact.0).norm() / exact.0.norm();
                assert!(distance < 1e-7, "{speed}: {} {}", found.0, exact.0);
            }
        }
    }
}
