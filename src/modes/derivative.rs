//! Derivatives of eigenvalues: dλ = −yᴴ(dL)x / yᴴ(∂L/∂λ)x, with right and left vectors L(λ)x = 0, yᴴL(λ) = 0
//! (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::model::system::{GyroscopicSystem, dynamic_stiffness};

use super::vectors::real_times;

/// dλ/dΩ, in 1/s per rad/s: ∂L/∂Ω = 2λG + 2Ω(K_σ − N) + K_circ.
pub fn with_speed(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    lambda: c64,
    x: &Col<c64>,
) -> c64 {
    let change = speed_slope(system, speed_rad_per_s, lambda, x);
    along(system, speed_rad_per_s, (lambda, x), &change)
}

/// dλ, in 1/s, for a small change of the matrices.
pub fn with_change(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    lambda: c64,
    x: &Col<c64>,
    change: &GyroscopicSystem,
) -> c64 {
    let changed = change_of_residual(change, speed_rad_per_s, lambda, x);
    along(system, speed_rad_per_s, (lambda, x), &changed)
}

/// −yᴴ(dL)x / yᴴ(∂L/∂λ)x for a known (dL)x.
fn along(
    system: &GyroscopicSystem,
    speed: f64,
    (lambda, x): (c64, &Col<c64>),
    changed: &Col<c64>,
) -> c64 {
    let y = left_vector(system, speed, lambda, x);
    let slope = with_lambda(&system.velocity_at(speed), lambda, x);
    -(y.adjoint() * changed) / (y.adjoint() * slope)
}

/// Change dΩ = −yᴴ(dL)x / yᴴ(∂L/∂Ω)x of the speed at which two modes coalesce, where yᴴ(∂L/∂λ)x = 0, for a
/// small change of the matrices, with the right and the left vector x, y. For λ = 0 this is the change of a
/// critical speed.
pub fn of_coalescence(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    lambda: c64,
    [x, y]: [&Col<c64>; 2],
    change: &GyroscopicSystem,
) -> f64 {
    let changed = change_of_residual(change, speed_rad_per_s, lambda, x);
    of_coalescence_by(
        system,
        speed_rad_per_s,
        lambda,
        [x, y],
        y.adjoint() * changed,
    )
}

/// The change of [`of_coalescence`] for a known yᴴ(dL)x.
pub fn of_coalescence_by(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    lambda: c64,
    [x, y]: [&Col<c64>; 2],
    changed: c64,
) -> f64 {
    let slope = speed_slope(system, speed_rad_per_s, lambda, x);
    -(changed / (y.adjoint() * slope)).re
}

/// (dL)x = (λ(2Ω dG + dC) + dK(Ω))x.
fn change_of_residual(
    change: &GyroscopicSystem,
    speed: f64,
    lambda: c64,
    x: &Col<c64>,
) -> Col<c64> {
    let mut changed = Scale(lambda) * real_times(&change.velocity_at(speed), x)
        + real_times(&change.stiffness_at(speed), x);
    if let (true, Some(drift)) = (stands_still(lambda), &change.drift) {
        changed += Scale(c64::new(speed * speed, 0.0)) * real_times(drift, x);
    }
    changed
}

/// Whether a mode is at rest in space. Then K₀ + Ω² [`GyroscopicSystem::standing_spin`] times its shape is zero.
pub(super) fn stands_still(lambda: c64) -> bool {
    lambda == c64::new(0.0, 0.0)
}

/// (∂L/∂Ω)x, with the drift of free motions if the mode is at rest in space.
fn speed_slope(system: &GyroscopicSystem, speed: f64, lambda: c64, x: &Col<c64>) -> Col<c64> {
    let gyroscopic = real_times(&system.gyroscopic, x);
    let spin = real_times(&system.spin, x);
    let mut slope = Scale(2.0 * lambda) * gyroscopic + Scale(c64::new(2.0 * speed, 0.0)) * spin;
    if let Some(circulatory) = &system.circulatory {
        slope += real_times(circulatory, x);
    }
    if let (true, Some(drift)) = (stands_still(lambda), &system.drift) {
        slope += Scale(c64::new(2.0 * speed, 0.0)) * real_times(drift, x);
    }
    slope
}

/// (∂L/∂λ)x = (2λ + D)x.
pub fn with_lambda(velocity: &Mat<f64>, lambda: c64, x: &Col<c64>) -> Col<c64> {
    Scale(2.0 * lambda) * x + real_times(velocity, x)
}

/// Left vector y, by inverse iteration on L(λ)ᴴ. For an undamped oscillation L is Hermitian and y = x.
fn left_vector(system: &GyroscopicSystem, speed: f64, lambda: c64, x: &Col<c64>) -> Col<c64> {
    if system.is_conservative() && lambda.re == 0.0 {
        return x.clone();
    }
    let stiffness = system.stiffness_at(speed);
    let velocity = system.velocity_at(speed);
    let factors = dynamic_stiffness(&stiffness, &velocity, beside(lambda)).partial_piv_lu();
    let mut y = x.clone();
    for _ in 0..3 {
        let solved: Col<c64> = factors.solve_adjoint(&y);
        let norm = solved.norm_l2();
        if !norm.is_finite() || norm == 0.0 {
            return y;
        }
        y = Scale(c64::new(1.0 / norm, 0.0)) * solved;
    }
    y
}

/// A shift slightly beside an eigenvalue, so that L is not exactly singular.
fn beside(lambda: c64) -> c64 {
    lambda * (1.0 + 1e-9) + c64::new(1e-9, 0.0)
}
