//! Two formulations of one saw.
//!
//! In space the guides are stationary and the system is constant: eigenvalues λ. On the blade there is no gyroscopic
//! term, but the guides move around: a system periodic in T = 2π/Ω. After a rotation both frames agree, so that the
//! Floquet multipliers are exp(λT).

use nalgebra::{Complex, DMatrix};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, rad_per_s};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::companion_eigenpairs;

fn dense(matrix: &faer::Mat<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, k| matrix[(i, k)])
}

/// Monodromy matrix of q̈ + [K_b + Ω²K_σ + R(t)ᵀ K_g R(t)] q = 0 by a Magnus integrator
/// of fourth order with two Gauss points (Blanes et al., Phys. Rep. 470, 2009).
fn monodromy(plate: &Plate, system: &GyroscopicSystem, speed: f64, steps: usize) -> DMatrix<f64> {
    let order = system.order();
    let guides = dense(plate.contact.stiffness().unwrap());
    let turn = dense(&system.gyroscopic);
    let axisymmetric = dense(&system.stiffness) - &guides;
    // N = GᵀG restores K_σ from K_σ − N.
    let centrifugal = dense(&system.spin) + turn.transpose() * &turn;
    let constant = axisymmetric + centrifugal * speed.powi(2);
    let unit = 500.0;
    let state = |time: f64| {
        // The guides move backwards on the blade: R = exp(−ΩtG) rotates each n.
        let rotation = (&turn * (-speed * time)).exp();
        let stiffness = &constant + rotation.transpose() * &guides * &rotation;
        let mut a = DMatrix::zeros(2 * order, 2 * order);
        a.view_mut((0, order), (order, order)).fill_with_identity();
        a.view_mut((order, 0), (order, order))
            .copy_from(&(stiffness / -(unit * unit)));
        a * unit
    };
    let period = std::f64::consts::TAU / speed;
    let step = period / steps as f64;
    let mut total = DMatrix::identity(2 * order, 2 * order);
    let offset = 3.0_f64.sqrt() / 6.0;
    for k in 0..steps {
        let middle = (k as f64 + 0.5) * step;
        let (a, b) = (state(middle - offset * step), state(middle + offset * step));
        let commutator = &b * &a - &a * &b;
        let exponent =
            (&a + &b) * (0.5 * step) + commutator * (3.0_f64.sqrt() / 12.0 * step * step);
        total = exponent.exp() * total;
    }
    total
}

fn small_plate() -> Plate {
    // The pad is softer than the paper's: stiff guides on a coarse basis need too many steps.
    let scene = Scene::paper().edited(|saw| saw.guides[0].stiffness_n_per_m = 2.0e6);
    let resolution = Resolution {
        max_diameters: 3,
        radial_functions: 2,
    };
    Plate::new(&scene.unwrap(), resolution)
}

fn assert_same_multipliers(speed_rpm: f64, unstable: bool) {
    let plate = small_plate();
    let system = GyroscopicSystem::of_plate(&plate);
    let speed = rad_per_s(speed_rpm);
    let pairs = companion_eigenpairs(&system, speed).unwrap();
    let grows = pairs.iter().any(|(lambda, _)| lambda.re > 1e-3);
    assert_eq!(
        grows, unstable,
        "{speed_rpm} rpm is not the case it should be"
    );
    let period = std::f64::consts::TAU / speed;
    let multipliers = monodromy(&plate, &system, speed, 1600).complex_eigenvalues();
    for (lambda, _) in &pairs {
        let expected = (Complex::new(lambda.re, lambda.im) * period).exp();
        let distance = multipliers
            .iter()
            .map(|m| (m - expected).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(
            distance < 1e-8 * expected.norm().max(1.0),
            "{lambda}: {distance}"
        );
    }
}

#[test]
fn floquet_multipliers_at_a_stable_speed() {
    assert_same_multipliers(1200.0, false);
}

#[test]
fn floquet_multipliers_at_an_unstable_speed() {
    let speed = unstable_speed();
    assert_same_multipliers(speed, true);
}

/// The first divergence or flutter of the small saw, by a search in steps of 2 rpm.
fn unstable_speed() -> f64 {
    let plate = small_plate();
    let system = GyroscopicSystem::of_plate(&plate);
    let grows = |rpm: &f64| {
        let pairs = companion_eigenpairs(&system, rad_per_s(*rpm)).unwrap();
        pairs.iter().any(|(lambda, _)| lambda.re > 0.3)
    };
    let mut speeds = (500..2000).map(|k| 2.0 * f64::from(k));
    speeds
        .find(grows)
        .expect("every guided saw is unstable somewhere")
}
