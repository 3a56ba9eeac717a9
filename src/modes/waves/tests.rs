//! Eigenvalues of the reduced model beside those of the full matrices.

use faer::{Col, c64};

use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{DampingFile, Scene, SceneFile, SpeedRange, WoodFile, rad_per_s};
use crate::modes::component::Component;
use crate::modes::mode::Mode;
use crate::modes::{companion_eigenpairs, derivative, eigenvalues};

const TO_RPM: f64 = 3000.0;

const RESOLUTION: Resolution = Resolution {
    max_diameters: 8,
    radial_functions: 5,
};

/// [`error_of`] for the paper's saw with a change.
fn error(edit: impl FnOnce(&mut SceneFile)) -> f64 {
    let scene = Scene::paper().edited(|saw| {
        (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
        edit(saw);
    });
    error_of(&Plate::new(&scene.unwrap(), RESOLUTION))
}

/// Largest distance of an eigenvalue of either list from the other, in windows.
fn error_of(plate: &Plate) -> f64 {
    let component = &Component::of(plate)[0];
    let system = &component.full;
    let to = rad_per_s(TO_RPM);
    let window = 2.0 * to;
    let modes = modes(
        plate,
        component.first,
        system,
        SpeedRange::new(0.0, to),
        window,
        CUT,
    )
    .unwrap();
    let mut worst = 0.0_f64;
    for k in 0..7 {
        let speed = to * (f64::from(k) + 0.4) / 7.0;
        let models = modes.models();
        let found: Vec<c64> = models
            .flat_map(|model| model.eigenvalues(speed).unwrap())
            .map(|(lambda, _)| lambda)
            .collect();
        let exact = eigenvalues(system, speed).unwrap();
        for (some, others) in [(&found, &exact), (&exact, &found)] {
            for lambda in some.iter().filter(|lambda| lambda.norm() < window) {
                let away = others.iter().map(|other| (other - lambda).norm());
                let off = away.fold(f64::INFINITY, f64::min) / window;
                worst = worst.max(off);
            }
        }
    }
    worst
}

/// Next to a tenth of a percent beside them, Newton's method finds the eigenvalues and slopes of all at once.
#[test]
fn newton_finds_the_eigenvalue_next_to_an_expected_one() {
    let scene = Scene::paper().edited(|saw| {
        (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
        saw.guides[0].damping_n_s_per_m = 50.0;
    });
    let plate = Plate::new(&scene.unwrap(), RESOLUTION);
    let to = rad_per_s(TO_RPM);
    let component = &Component::of(&plate)[0];
    let modes = modes(
        &plate,
        component.first,
        &component.full,
        SpeedRange::new(0.0, to),
        2.0 * to,
        CUT,
    )
    .unwrap();
    let system = &component.full;
    let speed = 0.4 * to;
    for (lambda, x) in companion_eigenpairs(system, speed).unwrap().iter().take(8) {
        let expected = lambda * c64::new(1.0 + 1e-3, 1e-3);
        let (found, slope) = modes.next_to(speed, expected).unwrap();
        assert!((found - lambda).norm() < 1e-8 * to, "{lambda} {found}");
        let exact = derivative::with_speed(system, speed, *lambda, x);
        assert!((slope - exact).norm() < 1e-6, "{lambda}: {slope} {exact}");
    }
}

/// Without damping the half-order problem is used.
#[test]
fn eigenvalues_of_undamped_saws_are_those_of_the_full_matrices() {
    for stiffness in [1e5, 2e7, 1e10] {
        let worst = error(|saw| saw.guides[0].stiffness_n_per_m = stiffness);
        assert!(worst < 1e-8, "{stiffness}: {worst:e}");
    }
}

/// With a damped pad, a damper stronger than its spring, and one without a spring, which leaves free tilts.
#[test]
fn eigenvalues_with_damped_pads_are_those_of_the_full_matrices() {
    for (stiffness, damping) in [(2e7, 300.0), (1e6, 1e4), (0.0, 1e5)] {
        let worst = error(|saw| {
            saw.guides[0].stiffness_n_per_m = stiffness;
            saw.guides[0].damping_n_s_per_m = damping;
        });
        assert!(worst < 1e-8, "{stiffness} {damping}: {worst:e}");
    }
}

/// The densest air that a scene may have is among them: all of its far waves decay without oscillating.
#[test]
fn eigenvalues_with_damping_by_material_and_air_are_those_of_the_full_matrices() {
    for (material_retardation_time_s, air_n_s_per_m3) in [(2e-4, 0.0), (0.0, 1e4), (0.0, 1e5)] {
        let worst = error(|saw| {
            saw.damping = Some(DampingFile {
                material_retardation_time_s,
                air_n_s_per_m3,
                air_rotation_share: 0.3,
                ..DampingFile::default()
            });
        });
        assert!(
            worst < 1e-8,
            "{material_retardation_time_s} {air_n_s_per_m3}: {worst:e}"
        );
    }
}

/// The cut couples all waves, and the wood is a strong damper beside them.
#[test]
fn eigenvalues_in_the_cut_are_those_of_the_full_matrices() {
    let scene = Scene::paper().edited(|saw| {
        let cut = saw.cut.as_mut().expect("the paper's saw cuts");
        cut.wood = Some(WoodFile {
            stiffness_n_per_m: 6e4,
            damping_n_s_per_m: 2e3,
            depth_m: 0.06,
            arc_deg: None,
        });
        cut.chart_rpm = Some(2800.0);
        (saw.runup, saw.probe, saw.measured) = (None, None, None);
    });
    let plate = Plate::new(&scene.unwrap(), RESOLUTION);
    assert!(plate.edge_stiffness.is_some());
    let worst = error_of(&plate);
    assert!(worst < 1e-8, "{worst:e}");
}

/// A material that relaxes within the periods of its waves leaves none of them far. Here 1/η is
/// from slightly above the cut to a hundredth of the window.
#[test]
fn eigenvalues_with_a_material_that_relaxes_slowly_are_those_of_the_full_matrices() {
    let window = 2.0 * rad_per_s(TO_RPM);
    for rate in [2.6, 2.4, 1.0, 0.01] {
        let worst = error(|saw| {
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1.0 / (rate * window),
                ..DampingFile::default()
            });
        });
        assert!(worst < 1e-8, "{rate}: {worst:e}");
    }
}

/// At speeds beside the nodes. Reference: the vectors of all eigenvalues of the companion matrix.
#[test]
fn vectors_of_all_waves_are_those_of_the_full_matrices() {
    let scene = Scene::paper().edited(|saw| {
        (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
        saw.guides[0].damping_n_s_per_m = 300.0;
    });
    let plate = Plate::new(&scene.unwrap(), RESOLUTION);
    let component = &Component::of(&plate)[0];
    let to = rad_per_s(TO_RPM);
    let modes = modes(
        &plate,
        component.first,
        &component.full,
        SpeedRange::new(0.0, to),
        2.0 * to,
        CUT,
    )
    .unwrap();
    let mut compared = 0;
    for k in 0..4 {
        let speed = to * (f64::from(k) + 0.4) / 4.0;
        let exact = companion_eigenpairs(&component.full, speed).unwrap();
        let found = modes.at(speed, 2.0 * to, 0).unwrap();
        compared += found.len();
        for Mode {
            lambda,
            coordinates,
            ..
        } in found
        {
            let off = |pair: &(c64, Col<c64>)| (pair.0 - lambda).norm();
            let exact = exact.iter().min_by(|x, y| off(x).total_cmp(&off(y)));
            let whole = modes.whole_vector(speed, lambda, &coordinates);
            let shape = modes.coordinates.shape(&whole);
            let along: c64 = exact.unwrap().1.adjoint() * &shape;
            let angle = (1.0 - along.norm_sqr()).abs().sqrt();
            assert!(angle < 2e-6, "{lambda}: {angle:e}");
        }
    }
    assert!(compared >= 20, "{compared}");
}
