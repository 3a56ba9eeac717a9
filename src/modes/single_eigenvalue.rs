//! One eigenvalue by Newton's method with the right and the left vector, λ ← λ − yᴴL(λ)x / yᴴL′(λ)x (Lancaster,
//! *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use super::family::{Family, MatrixPolynomial};
use super::vectors::unit;

/// Largest number of steps; convergence is cubic.
const STEPS: usize = 6;
/// Size of the last correction, relative and in units of the family, after which only rounding remains.
const TOLERANCE: f64 = 1e-9;
const ROUNDING: f64 = 1e-13;
/// Number of inverse iterations that begin with arbitrary vectors.
const FIRST_ITERATIONS: usize = 4;
/// Distance of the shift from λ, relative and in units of the family, so that L is not exactly singular.
const BESIDE: f64 = 1e-9;

/// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ. A real one stays real. `None` if the iteration does not converge,
/// or the family does not reach the speed.
pub fn next_to(family: &impl Family, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
    let at = family.at(speed_rad_per_s)?;
    let mut lambda = expected;
    let mut vectors = None;
    for _ in 0..STEPS {
        let [value, by_root] = at.by_root(lambda);
        let [x, y] = nearest(&at, lambda, [&value, &by_root], vectors);
        let change = -(y.adjoint() * (value * &x)) / (y.adjoint() * (&by_root * &x));
        lambda += change;
        if !lambda.is_finite() {
            return None;
        }
        if change.norm() <= TOLERANCE * lambda.norm() + ROUNDING * at.unit_per_s() {
            if expected.im == 0.0 {
                lambda.im = 0.0;
            }
            let [by_speed] = at.by_speed(lambda);
            let slope = -(y.adjoint() * (by_speed * &x)) / (y.adjoint() * (by_root * &x));
            return slope.is_finite().then_some((lambda, slope));
        }
        vectors = Some([x, y]);
    }
    None
}

/// Right and left vector of the eigenvalue nearest to λ from L(λ) and L_λ, by one inverse iteration, or by several from
/// vectors that are hardly orthogonal to any shape.
pub fn nearest(
    at: &impl MatrixPolynomial,
    lambda: c64,
    [value, by_root]: [&Mat<c64>; 2],
    vectors: Option<[Col<c64>; 2]>,
) -> [Col<c64>; 2] {
    let shift = BESIDE * (lambda + at.unit_per_s());
    let factors = (value + Scale(shift) * by_root).partial_piv_lu();
    let iterations = if vectors.is_some() {
        1
    } else {
        FIRST_ITERATIONS
    };
    let [mut x, mut y] = vectors.unwrap_or_else(|| {
        // Cosines unrelated to the shapes.
        let cosine = Col::from_fn(at.order(), |i| c64::from((1.0 + i as f64).cos()));
        [cosine.clone(), cosine]
    });
    for _ in 0..iterations {
        let right: Col<c64> = factors.solve(by_root * &x);
        let left: Col<c64> = factors.solve_adjoint(by_root.adjoint() * &y);
        (x, y) = (unit(right.as_ref()), unit(left.as_ref()));
    }
    [x, y]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Scene, rad_per_s};
    use crate::model::system::GyroscopicSystem;
    use crate::modes::{companion_eigenpairs, derivative};

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
            let one = derivative::with_speed(&system, speed, *lambda, x);
            assert!((slope - one).norm() < 1e-6, "{lambda}: {slope} {one}");
        }
    }
}
