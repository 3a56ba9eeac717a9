//! Derivatives of eigenvalues: dλ = −yᴴ(dL)x / yᴴ(∂L/∂λ)x, with right and left vectors L(λ)x = 0, yᴴL(λ) = 0
//! (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::model::system::{GyroscopicSystem, dynamic_stiffness};

use super::vectors::{real_times, unit};

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

/// The eigenvalue nearest to an expected one, with its slope, by Newton's method with the right and the left
/// vector, λ ← λ − yᴴL(λ)x / yᴴL′(λ)x. `None` if it does not converge.
pub fn next_to(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    expected: c64,
) -> Option<(c64, c64)> {
    let (stiffness, velocity) = (
        system.stiffness_at(speed_rad_per_s),
        system.velocity_at(speed_rad_per_s),
    );
    let transposed = velocity.transpose().to_owned();
    // The iteration must not start orthogonal to the vector that it has to find. These cosines are unrelated
    // to the shapes, so that practically no mode is orthogonal to them.
    let start = Col::from_fn(system.order(), |i| c64::new((1.0 + i as f64).cos(), 0.0));
    let (mut lambda, mut x, mut y) = (expected, start.clone(), start);
    for step in 0..NEWTON_STEPS {
        let factors = dynamic_stiffness(&stiffness, &velocity, beside(lambda)).partial_piv_lu();
        for _ in 0..if step == 0 { FIRST_ITERATIONS } else { 1 } {
            let right: Col<c64> = factors.solve(with_lambda(&velocity, lambda, &x));
            let left: Col<c64> = factors.solve_adjoint(with_lambda(&transposed, lambda.conj(), &y));
            (x, y) = (unit(right.as_ref()), unit(left.as_ref()));
        }
        let residual = Scale(lambda * lambda) * &x
            + Scale(lambda) * real_times(&velocity, &x)
            + real_times(&stiffness, &x);
        let change = -(y.adjoint() * residual) / (y.adjoint() * with_lambda(&velocity, lambda, &x));
        lambda += change;
        if !lambda.is_finite() {
            return None;
        }
        if change.norm() <= NEWTON_TOLERANCE * lambda.norm() {
            if expected.im == 0.0 {
                lambda.im = 0.0;
            }
            let changed = speed_slope(system, speed_rad_per_s, lambda, &x);
            let inertia = with_lambda(&velocity, lambda, &x);
            let slope = -(y.adjoint() * changed) / (y.adjoint() * inertia);
            return slope.is_finite().then_some((lambda, slope));
        }
    }
    None
}

/// Largest number of Newton steps; convergence is cubic.
const NEWTON_STEPS: usize = 6;
/// Relative size of the last correction, after which only rounding remains.
const NEWTON_TOLERANCE: f64 = 1e-9;
/// Number of inverse iterations in the first step, which begins with an arbitrary vector.
const FIRST_ITERATIONS: usize = 4;

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
    let slope = speed_slope(system, speed_rad_per_s, lambda, x);
    -(y.adjoint() * changed).re / (y.adjoint() * slope).re
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
pub(super) fn beside(lambda: c64) -> c64 {
    lambda * (1.0 + 1e-9) + c64::new(1e-9, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, rad_per_s};
    use crate::modes::companion_eigenpairs;

    /// The paper's saw with a damped pad.
    fn system() -> GyroscopicSystem {
        let scene = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 50.0);
        let resolution = Resolution {
            max_diameters: 4,
            radial_functions: 3,
        };
        GyroscopicSystem::of_plate(&Plate::new(&scene.unwrap(), resolution))
    }

    /// The start differs by a thousandth from the eigenvalue. Reference: all eigenvalues of the companion
    /// matrix.
    #[test]
    fn newton_finds_the_eigenvalue_next_to_an_expected_one() {
        let (system, speed) = (system(), rad_per_s(1000.0));
        let pairs = companion_eigenpairs(&system, speed).unwrap();
        for (lambda, x) in pairs.iter().take(8) {
            let expected = lambda * c64::new(1.0 + 1e-3, 1e-3);
            let (found, slope) = next_to(&system, speed, expected).unwrap();
            assert!(
                (found - lambda).norm() < 1e-8 * lambda.norm(),
                "{lambda} {found}"
            );
            let one = with_speed(&system, speed, *lambda, x);
            assert!((slope - one).norm() < 1e-6, "{lambda}: {slope} {one}");
        }
    }
}
