//! Deflections under a force on bases of a few shapes, compared with dense solutions of the full model, with the same saw
//! turned about its axis, and with a larger basis of the plate.

use std::f64::consts::{PI, TAU};

use faer::linalg::solvers::Solve;
use faer::{Col, Side};

use super::basis::at_rest;
use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{Accuracy, Polar, Scene, SceneFile, rad_per_s};
use crate::stability::ChosenBasis;

const MODES: usize = 24;
/// Of an order at which a symmetric solver divides and conquers.
const RESOLUTION: Resolution = Resolution {
    max_diameters: 16,
    radial_functions: 8,
};

/// Saws with large and small, soft and stiff, single and mirrored pads.
pub(crate) fn saws() -> Vec<(&'static str, Scene)> {
    let two_pads = Scene::from_json(include_str!("../../../scenes/two-pads.json")).unwrap();
    let paper = |change: &dyn Fn(&mut SceneFile)| Scene::paper().edited(|saw| change(saw)).unwrap();
    let small = |saw: &mut SceneFile| {
        let pad = &mut saw.guides[0];
        (pad.radius_m, pad.radial_length_m, pad.tangential_length_m) = (0.3, 0.02, 0.02);
    };
    let mirrored = two_pads.edited(|saw| {
        (saw.guides[0].angle_deg, saw.guides[1].angle_deg) = (-55.0, 55.0);
    });
    vec![
        ("built-in", Scene::paper()),
        ("pad at 0°", paper(&|saw| saw.guides[0].angle_deg = 0.0)),
        ("two pads", two_pads),
        ("mirrored pads", mirrored.unwrap()),
        ("small pad", paper(&small)),
        (
            "small stiff pad",
            paper(&|saw| {
                small(saw);
                saw.guides[0].stiffness_n_per_m *= 100.0;
            }),
        ),
    ]
}

/// fᵀK(Ω)⁻¹f of a unit force, by Cholesky's factors of the full model.
fn compliance(plate: &Plate, place: Polar, speed_rad_per_s: f64) -> f64 {
    let system = GyroscopicSystem::of_plate(plate);
    let values = plate.functions_at(place.radius_m, place.angle_rad);
    let force = Col::from_fn(values.len(), |i| values[i]);
    let factor = system.stiffness_at(speed_rad_per_s).llt(Side::Lower);
    force.transpose() * factor.unwrap().solve(&force)
}

/// Deflection under a force at its place, up from the flat blade.
fn deflection(plate: &Plate, force_n: f64, place: Polar, [at, to]: [f64; 2]) -> f64 {
    let blade = StretchedBlade::up_to(plate, to, place, MODES)
        .unwrap()
        .pressed(force_n, place)
        .unwrap();
    let found = blade.settled(at, &blade.flat()).unwrap();
    blade.deflection_m(&found, place.radius_m, place.angle_rad)
}

/// On a basis for speeds up to 1200 rpm, below the critical speeds, a small force deflects the blade as the full model says:
/// exactly at rest, and almost so at other speeds.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn a_small_force_deflects_each_saw_as_the_full_model_says() {
    for (name, scene) in saws() {
        let plate = Plate::new(&scene, RESOLUTION);
        for angle in [180.0, 37.0_f64] {
            let place = Polar::new(plate.blade.outer_radius_m, angle.to_radians());
            for (rpm, most) in [(0.0, 1e-6), (700.0, 1e-7)] {
                let speed = rad_per_s(rpm);
                let found = deflection(&plate, 1e-6, place, [speed, rad_per_s(1200.0)]);
                let exact = 1e-6 * compliance(&plate, place, speed);
                let error = (found / exact - 1.0).abs();
                assert!(error < most, "{name} {angle}° {rpm} rpm: {error:e}");
            }
        }
    }
}

/// A saw whose guides are turned with its force is the same saw.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn a_saw_turned_with_its_force_deflects_as_before() {
    for (name, scene) in saws() {
        let speed = rad_per_s(1000.0);
        let turned = |angle_deg: f64| {
            let scene = scene.edited(|saw| {
                for pad in &mut saw.guides {
                    pad.angle_deg += angle_deg;
                }
            });
            let plate = Plate::new(&scene.unwrap(), RESOLUTION);
            let place = Polar::new(plate.blade.outer_radius_m, (20.0 + angle_deg).to_radians());
            deflection(&plate, 3.0, place, [speed, speed])
        };
        let (found, other) = (turned(0.0), turned(77.0));
        let change = (other / found - 1.0).abs();
        assert!(change < 1e-8, "{name}: {change:e}");
    }
}

/// The modes at rest on the bases that two accuracies take give the compliance of the full model, and the compliance and the
/// lowest frequency of the less accurate one are those of the other within its tolerance.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn modes_at_rest_agree_with_the_compliance_and_between_accuracies() {
    // A blade on a small pad rocks so slowly that rounding of the largest stiffness changes its lowest mode.
    for (name, scene) in saws().into_iter().take(4) {
        let found = [Accuracy::Draft, Accuracy::Design].map(|accuracy| {
            let plate = ChosenBasis::new(&scene, accuracy.tolerance())
                .unwrap()
                .saw
                .plate;
            let place = Polar::new(plate.blade.outer_radius_m, PI);
            let modes = at_rest(&GyroscopicSystem::of_plate(&plate)).unwrap();
            let values = plate.functions_at(place.radius_m, place.angle_rad);
            let shares = modes.vectors.transpose() * Col::from_fn(values.len(), |i| values[i]);
            let each = shares.iter().zip(&modes.values);
            let sum: f64 = each.map(|(share, square)| share * share / square).sum();
            let exact = compliance(&plate, place, 0.0);
            let error = (sum / exact - 1.0).abs();
            assert!(error < 1e-6, "{name} {accuracy:?}: {error:e}");
            [sum, modes.values[0].sqrt() / TAU]
        });
        for (which, (draft, design)) in found[0].iter().zip(found[1]).enumerate() {
            let change = (draft / design - 1.0).abs();
            let most = Accuracy::Draft.tolerance();
            assert!(change < most, "{name} {which}: {change:e}");
        }
    }
}
