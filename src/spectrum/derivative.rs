//! Derivatives of eigenvalues: dλ = −yᴴ(dL)x / yᴴ(∂L/∂λ)x, with right and left vectors L(λ)x = 0, yᴴL(λ) = 0
//! (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::system::{GyroscopicSystem, dynamic_stiffness};

use super::companion::time_scale;
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

/// dλ/dΩ of every eigenvalue, from all eigenpairs of Im λ ≥ 0. `None` if they do not span the states (q, λq),
/// because two of them have coalesced or rigid motions are missing.
///
/// The rows of the inverse of the matrix of all states are the left vectors.
pub fn of_all_with_speed(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    pairs: &[(c64, &Col<c64>)],
) -> Option<Vec<c64>> {
    let order = system.order();
    let width = |lambda: c64| if lambda.im > 0.0 { 2 } else { 1 };
    let count: usize = pairs.iter().map(|(lambda, _)| width(*lambda)).sum();
    let scale = time_scale(&system.stiffness);
    if count != 2 * order {
        return None;
    }
    let (mut states, mut changes) = (Mat::zeros(count, count), Mat::zeros(count, count));
    let mut column = 0;
    for (lambda, x) in pairs {
        let change = speed_slope(system, speed_rad_per_s, *lambda, x);
        let is_pair = lambda.im > 0.0;
        let set = |matrix: &mut Mat<f64>, row: usize, z: c64| {
            matrix[(row, column)] = z.re;
            if is_pair {
                matrix[(row, column + 1)] = z.im;
            }
        };
        for i in 0..order {
            set(&mut states, i, x[i]);
            set(&mut states, order + i, lambda * x[i] / scale);
            set(&mut changes, order + i, -change[i] / scale);
        }
        column += width(*lambda);
    }
    let slopes = states.partial_piv_lu().solve(changes);
    let mut column = 0;
    let all = pairs.iter().map(|(lambda, _)| {
        let k = column;
        column += width(*lambda);
        if lambda.im > 0.0 {
            // Columns k and k + 1 of the matrix X = `states` are the real and the imaginary part of a vector.
            // With the rows a and b of X⁻¹ at the same indices, its left vector is (a − ib)/2.
            let re = slopes[(k, k)] + slopes[(k + 1, k + 1)];
            c64::new(re, slopes[(k, k + 1)] - slopes[(k + 1, k)]) * 0.5
        } else {
            c64::new(slopes[(k, k)], 0.0)
        }
    });
    let all: Vec<c64> = all.collect();
    all.iter().all(|slope| slope.is_finite()).then_some(all)
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
fn stands_still(lambda: c64) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::{Scene, rad_per_s};
    use crate::spectrum::companion_eigenpairs;
    use crate::spectrum::vectors::Eigenpair;

    /// The paper's saw with a damped pad.
    fn system() -> GyroscopicSystem {
        let scene = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 50.0);
        let resolution = Resolution {
            max_diameters: 4,
            radial_functions: 3,
        };
        GyroscopicSystem::of_plate(&Plate::new(&scene.unwrap(), resolution))
    }

    fn nearest(pairs: &[Eigenpair], lambda: c64) -> c64 {
        let away = |pair: &&Eigenpair| (pair.0 - lambda).norm();
        let nearest = pairs.iter().min_by(|x, y| away(x).total_cmp(&away(y)));
        nearest.unwrap().0
    }

    /// Reference: difference quotients of the eigenvalues at two nearby speeds.
    #[test]
    fn slopes_of_all_eigenvalues_are_their_differences_over_the_speed() {
        let (system, speed, step) = (system(), rad_per_s(1000.0), 1e-3);
        let pairs = companion_eigenpairs(&system, speed).unwrap();
        let modes: Vec<(c64, &Col<c64>)> = pairs.iter().map(|(z, x)| (*z, x)).collect();
        let slopes = of_all_with_speed(&system, speed, &modes).unwrap();
        let beside = [speed - step, speed + step];
        let beside = beside.map(|speed| companion_eigenpairs(&system, speed).unwrap());
        assert_eq!(slopes.len(), system.order());
        for ((lambda, x), slope) in pairs.iter().zip(slopes) {
            let [before, after] = [-step, step].map(|d| lambda + slope * d);
            let difference =
                (nearest(&beside[1], after) - nearest(&beside[0], before)) / 2.0 / step;
            assert!(
                (slope - difference).norm() < 1e-5,
                "{lambda}: {slope} {difference}"
            );
            let one = with_speed(&system, speed, *lambda, x);
            assert!((slope - one).norm() < 1e-7, "{lambda}: {slope} {one}");
        }
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
