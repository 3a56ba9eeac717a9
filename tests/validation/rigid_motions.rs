//! Goal: unrestrained rigid motions have λ = 0 exactly, and do not affect other results.
//!
//! One point spring leaves two of them, two springs leave one: the tilt about the line through both. Rounding turns
//! their double zeros into slow waves or slow divergence; and because the momentum of a free motion is constant, waves
//! become stationary at other speeds than if it were restrained. The tests use the Krein index and a solver that does
//! not treat rigid motions separately.

use faer::c64;
use nalgebra::{DMatrix, linalg::Schur};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideFile, Scene, SceneFile, SpeedRange, rad_per_s};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{ModeKind, SpectralModel, Strategy, companion_eigenpairs};
use sawflutter::stability::undamped_bands;

const RESOLUTION: Resolution = Resolution {
    max_diameters: 8,
    radial_functions: 5,
};

/// The paper's blade on point springs.
fn scene(springs: &[(f64, f64)]) -> Scene {
    let mut file: SceneFile = Scene::paper().file().clone();
    let spring = |&(radius_m, angle_deg): &(f64, f64)| GuideFile {
        radius_m,
        angle_deg,
        radial_length_m: 0.0,
        tangential_length_m: 0.0,
        stiffness_n_per_m: 2e7,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    };
    file.guides = springs.iter().map(spring).collect();
    Scene::try_from(file).unwrap()
}

/// One spring; two at an angle; two on one diameter.
fn scenes() -> [(Scene, usize); 3] {
    [
        (scene(&[(0.2, -55.0)]), 2),
        (scene(&[(0.2, -55.0), (0.25, 40.0)]), 1),
        (scene(&[(0.2, -55.0), (0.25, 125.0)]), 1),
    ]
}

#[test]
fn the_krein_index_matches_at_every_speed() {
    for (scene, free) in scenes() {
        let range = SpeedRange::between_rpm(0.0, 2400.0);
        let plate = Plate::new(&scene, RESOLUTION);
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        assert_eq!(model.components[0].full.free_rigid.len(), free);
        let found = undamped_bands(&model, range, 101).unwrap();
        let (bands, certificate) = (found.instabilities, found.certificate);
        println!("{free} free: {bands:#?}");
        assert_eq!(certificate.violations_rad_per_s, Vec::<f64>::new());
        assert!(!certificate.gave_up && !bands.is_empty());
        // Half as many speeds give the same bands.
        let again = undamped_bands(&model, range, 51).unwrap().instabilities;
        assert_eq!(bands.len(), again.len());
        for (x, y) in bands.iter().zip(&again) {
            let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
            assert!(
                same(x.from_rad_per_s, y.from_rad_per_s) && same(x.to_rad_per_s, y.to_rad_per_s),
                "{x:?} {y:?}"
            );
        }
    }
}

/// All eigenvalues of the companion matrix of the whole saw, including zeros.
fn undeflated(system: &GyroscopicSystem, speed: f64) -> Vec<c64> {
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let unit = (stiffness.norm_l2() / (stiffness.nrows() as f64).sqrt()).sqrt();
    let size = system.order();
    let state = DMatrix::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
        (true, _) => f64::from(u8::from(k == i + size)),
        (false, true) => -stiffness[(i - size, k)] / unit.powi(2),
        (false, false) => -velocity[(i - size, k - size)] / unit,
    });
    let schur = Schur::try_new(state, f64::EPSILON, 200 * size).expect("convergence");
    let values = schur.complex_eigenvalues();
    values.iter().map(|z| c64::new(z.re, z.im) * unit).collect()
}

#[test]
fn every_other_eigenvalue_is_that_of_the_full_matrix() {
    for (scene, free) in scenes() {
        let system = GyroscopicSystem::of_plate(&Plate::new(&scene, RESOLUTION));
        for rpm in [300.0, 1700.0, 2300.0] {
            let speed = rad_per_s(rpm);
            let whole = undeflated(&system, speed);
            let pairs = companion_eigenpairs(&system, speed).unwrap();
            let zeros = pairs.iter().filter(|(l, _)| *l == c64::new(0.0, 0.0));
            assert_eq!(zeros.count(), free);
            let largest = whole.iter().fold(0.0_f64, |top, l| top.max(l.norm()));
            for (lambda, q) in pairs.iter().filter(|(l, _)| l.norm() > 0.0) {
                let off = whole.iter().map(|l| (l - lambda).norm());
                let nearest = off.fold(f64::INFINITY, f64::min);
                assert!(
                    nearest < 1e-10 * largest,
                    "{rpm} rpm, {lambda}: {nearest:e}"
                );
                let residual = (stiffness_residual(&system, speed, *lambda, q)) / largest.powi(2);
                assert!(residual < 1e-12, "{rpm} rpm, {lambda}: {residual:e}");
            }
            // The list is complete: the rest are the zeros, ±√ε of the largest.
            let slow = whole.iter().filter(|l| l.norm() < 1e-5 * largest).count();
            let listed = pairs.iter().filter(|(l, _)| l.im >= 0.0 && l.norm() > 0.0);
            let both_signs: usize = listed.map(|(l, _)| if l.im > 0.0 { 2 } else { 1 }).sum();
            assert_eq!(both_signs + 2, whole.len(), "{rpm} rpm, {slow} slow ones");
        }
    }
}

/// ‖(λ² + λD + K)q‖.
fn stiffness_residual(
    system: &GyroscopicSystem,
    speed: f64,
    lambda: c64,
    q: &faer::Col<c64>,
) -> f64 {
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let size = system.order();
    let rows = (0..size).map(|i| {
        let forces = (0..size).map(|k| q[k] * (lambda * velocity[(i, k)] + stiffness[(i, k)]));
        (lambda * lambda * q[i] + forces.sum::<c64>()).norm_sqr()
    });
    rows.sum::<f64>().sqrt()
}

/// A critical speed is one at which λ² of some mode passes linearly through zero.
#[test]
fn an_eigenvalue_vanishes_at_every_critical_speed() {
    for (scene, _) in scenes() {
        let plate = Plate::new(&scene, RESOLUTION);
        let critical = SpectralModel::critical_speeds(&plate).unwrap();
        let system = GyroscopicSystem::of_plate(&plate);
        let slowest = |speed: f64| {
            let pairs = companion_eigenpairs(&system, speed).unwrap();
            let moving = pairs.iter().map(|(l, _)| l.norm()).filter(|l| *l > 0.0);
            moving.fold(f64::INFINITY, f64::min)
        };
        for c in critical.iter().take(6) {
            let [near, far] = [1e-5, 4e-5].map(|d| slowest(c.speed_rad_per_s * (1.0 + d)));
            let ratio = far / near;
            // For waves at the double speeds of the point spring
            // λ
            // is proportional to the distance, for others to its root.
            assert!((1.9..4.2).contains(&ratio), "{ratio}: {near:e} {far:e}");
            assert!(far < 1.0, "{far}");
        }
    }
}

/// A blade without restraint: heave, and two tilts with 0 and 2Ω in space.
#[test]
fn the_tilts_of_a_free_blade_turn_at_twice_its_speed() {
    let plate = Plate::new(&scene(&[]), RESOLUTION);
    let model = SpectralModel::new(plate, SpeedRange::new(0.0, 300.0), Strategy::Reduced).unwrap();
    let modes = model.all_modes(250.0).unwrap();
    let rigid = modes.iter().filter(|m| m.kind == ModeKind::Rigid);
    assert_eq!(rigid.filter(|m| m.lambda == c64::new(0.0, 0.0)).count(), 3);
    let tilt = modes
        .iter()
        .map(|m| (m.lambda - c64::new(0.0, 500.0)).norm());
    assert!(tilt.fold(f64::INFINITY, f64::min) < 1e-9);
}
