//! Energy balance and averages of the blade on its arbor.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use crate::model::analytical::annulus::Annulus;
use crate::model::analytical::tilt;
use crate::model::plate::{EdgeStress, Plate, Resolution, edge_stiffness};
use crate::model::scene::{SplineFile, rad_per_s};

/// The paper's blade on a spline of 20 teeth, with K and C interpreted in millimetres.
pub fn scene_with(change: impl FnOnce(&mut SplineFile)) -> Scene {
    let mut spline = SplineFile {
        teeth: 20,
        pressure_angle_deg: 30.0,
        contact_stiffness_n_per_m_3_2: 6.96e9,
        contact_damping_n_s_3_2_per_m_3_2: 4.74e3,
        clearance_m: 0.25e-3,
        pitch_radius_m: None,
        weight_angle_deg: None,
    };
    change(&mut spline);
    let scene = Scene::paper().edited(|saw| saw.spline = Some(spline));
    scene.unwrap()
}

/// The paper's Table 3 at 2800 rpm: 4 teeth, at the pitch of 42 teeth.
fn cut() -> [RimForce; 4] {
    [-1.5, -0.5, 0.5, 1.5].map(|pitches| RimForce {
        angle_rad: pitches * TAU / 42.0,
        radial_n: -88.0,
        tangential_n: -1240.0,
    })
}

fn radial_push(angle_rad: f64, force_n: f64) -> [RimForce; 1] {
    [RimForce {
        angle_rad: angle_rad + std::f64::consts::PI,
        radial_n: -force_n,
        tangential_n: 0.0,
    }]
}

fn motion_under(scene: &Scene, loads: &[RimForce], rpm: f64) -> InPlaneMotion {
    let spline = scene.spline().unwrap();
    let load = PlaneLoad::new(
        scene.blade(),
        loads,
        spline.weight_angle_deg.map(f64::to_radians),
    );
    InPlaneMotion::new(scene.blade(), spline, load, rad_per_s(rpm)).unwrap()
}

/// With damping, and a rotation slower than its vibrations, a blade that starts centred ends in the
/// equilibrium position.
#[test]
fn the_motion_settles_on_the_seat() {
    let scene = scene_with(|spline| {
        spline.contact_stiffness_n_per_m_3_2 = 1e7;
        spline.contact_damping_n_s_3_2_per_m_3_2 = 2e4;
    });
    let loads = cut();
    let run = Run {
        start: Start::Centred,
        settling_revolutions: 2,
        averaged_revolutions: 2,
        tolerance: 1e-9,
        ..Run::default()
    };
    let motion = motion_under(&scene, &loads, 6.0);
    let result = motion.run(&run).unwrap();
    let load = PlaneLoad::new(scene.blade(), &loads, None);
    let torque = load.torque_n_m / 0.1;
    let samples = 720;
    for step in [0, 17, 101] {
        let point = result.orbit[result.settled_from + step];
        let angle = TAU * step as f64 / samples as f64;
        let (sin, cos) = angle.sin_cos();
        let [x, y] = load.force_n;
        let seen = Vector3::new(x * cos + y * sin, y * cos - x * sin, torque);
        let seat = motion.contact.seat(seen).unwrap();
        let expected = [
            seat.x * cos - seat.y * sin,
            seat.x * sin + seat.y * cos,
            seat.z,
        ];
        let found = [point.x_m, point.y_m, point.twist_rad * 0.1];
        for (found, expected) in found.into_iter().zip(expected) {
            let error = (found - expected).abs() / seat.norm();
            assert!(error < 1e-3, "{found} {expected}");
        }
    }
}

/// Each step adds an error of the tolerance to a displacement, at impact forces of several times the load.
fn assert_energy_is_accounted_for(result: &SplineRun, tolerance: f64) {
    let allowed = 10.0 * result.steps as f64 * tolerance;
    let defect = result.energy_defect;
    println!(
        "{} steps to {tolerance:e}: defect {defect:.1e}",
        result.steps
    );
    assert!(
        defect <= allowed,
        "{tolerance:e}: {defect:e}, allowed {allowed:e}"
    );
}

/// Without damping the stored energy is the work of load and arbor, more exactly with finer steps.
#[test]
fn undamped_energy_is_conserved_to_the_tolerance() {
    let scene = scene_with(|spline| spline.contact_damping_n_s_3_2_per_m_3_2 = 0.0);
    let defects = [1e-6, 1e-8, 1e-10].map(|tolerance| {
        let run = Run {
            start: Start::Centred,
            settling_revolutions: 1,
            averaged_revolutions: 2,
            tolerance,
            ..Run::default()
        };
        let result = simulate(&scene, &radial_push(-FRAC_PI_2, 300.0), 100.0, &run).unwrap();
        assert_eq!(result.dissipated_j, 0.0);
        assert_eq!(result.reaction.teeth.fewest, 0, "it never bounced");
        assert_energy_is_accounted_for(&result, tolerance);
        result.energy_defect
    });
    assert!(defects[2] < 0.1 * defects[1] && defects[1] < 0.1 * defects[0]);
}

/// The loss of energy by damping equals the energy dissipated in the contacts.
#[test]
fn damped_energy_goes_into_the_contacts() {
    let scene = scene_with(|_| ());
    for (start, tolerance) in [
        (Start::Centred, 1e-6),
        (Start::Centred, 1e-8),
        (Start::Seated, 1e-8),
    ] {
        let run = Run {
            start,
            tolerance,
            ..Run::default()
        };
        let result = simulate(&scene, &cut(), rad_per_s(2800.0), &run).unwrap();
        assert!(result.dissipated_j > 0.0);
        assert_energy_is_accounted_for(&result, tolerance);
    }
}

proptest! {
    /// Every scene gives finite numbers or an error, and no panic.
    #[test]
    fn extremes_end_in_numbers_or_an_error(
        (teeth, degrees) in (1..=200_u32, 0.0..=60.0_f64),
        stiffness in (-11.9..15.0_f64).prop_map(|x| 10_f64.powf(x)),
        damping in prop_oneof![Just(0.0), (-12.0..18.0_f64).prop_map(|x| 10_f64.powf(x))],
        clearance_m in prop_oneof![Just(0.0), (-12.0..-1.0_f64).prop_map(|x| 10_f64.powf(x))],
        newtons in prop_oneof![Just(0.0), (-12.0..12.0_f64).prop_map(|x| 10_f64.powf(x))],
        (centred, rpm) in (any::<bool>(), 1e-3..1e6_f64),
    ) {
        let scene = scene_with(|spline| {
            *spline = SplineFile {
                teeth,
                pressure_angle_deg: degrees,
                contact_stiffness_n_per_m_3_2: stiffness,
                contact_damping_n_s_3_2_per_m_3_2: damping,
                clearance_m,
                ..*spline
            };
        });
        let loads = [RimForce { angle_rad: 0.3, radial_n: newtons, tangential_n: -newtons }];
        let run = Run {
            start: if centred { Start::Centred } else { Start::Seated },
            settling_revolutions: 1,
            averaged_revolutions: 2,
            tolerance: 1e-6,
            max_steps: 500,
        };
        if let Ok(result) = simulate(&scene, &loads, rad_per_s(rpm), &run) {
            let reaction = &result.reaction;
            let numbers = [reaction.torque_n_m, reaction.imbalance, reaction.unsteadiness];
            prop_assert!(numbers.iter().chain(&reaction.force_n).all(|x| x.is_finite()));
            prop_assert!(result.energy_defect.is_finite());
            for force in &reaction.stations {
                prop_assert!(force.radial_n >= 0.0 && force.tangential_n.is_finite());
            }
        }
    }

}

/// Over the settled revolutions the reaction of the arbor balances force and torque of the cut, and all teeth
/// carry equal forces.
#[test]
fn the_mean_reaction_balances_the_cut() {
    for weight_angle_rad in [None, Some(0.7)] {
        let scene = scene_with(|spline| {
            spline.weight_angle_deg = weight_angle_rad.map(f64::to_degrees);
        });
        let result = simulate(&scene, &cut(), rad_per_s(1800.0), &Run::default()).unwrap();
        let load = PlaneLoad::new(scene.blade(), &cut(), weight_angle_rad);
        let reaction = &result.reaction;
        let size = load.force_n[0].hypot(load.force_n[1]);
        for (reaction, load) in reaction.force_n.into_iter().zip(load.force_n) {
            assert!((reaction + load).abs() < 1e-5 * size, "{reaction} {load}");
        }
        let torque = reaction.torque_n_m / load.torque_n_m + 1.0;
        assert!(torque.abs() < 1e-5, "{torque}");
        assert!(reaction.imbalance < 1e-5, "{}", reaction.imbalance);
        assert!(reaction.unsteadiness < 1e-5, "{}", reaction.unsteadiness);
        let teeth = &reaction.teeth.mean_n;
        for tooth in teeth {
            assert!((tooth / teeth[0] - 1.0).abs() < 1e-5, "{teeth:?}");
        }
    }
}

/// In equilibrium the assumed tractions are zero, and the tilts are affected by loads and contact forces
/// alone: Σ sym(x ⊗ F).
#[test]
fn tilts_feel_the_virial_of_cut_and_contacts() {
    let scene = scene_with(|_| ());
    let result = simulate(&scene, &cut(), rad_per_s(2800.0), &Run::default()).unwrap();
    let plate = Plate::new(
        &scene.edited(|saw| saw.guides.clear()).unwrap(),
        Resolution {
            max_diameters: 5,
            radial_functions: 5,
        },
    );
    let stations = &result.reaction.stations;
    let stress = EdgeStress::with_reaction(&plate.blade, &cut(), stations, 10);
    let stiffness = edge_stiffness(&plate, &stress);
    let blade = &plate.blade;
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let force = |radius_m, angle_rad, radial_n, tangential_n| tilt::PlaneForce {
        radius_m,
        angle_rad,
        radial_n,
        tangential_n,
    };
    let rim = cut().map(|f| force(b, f.angle_rad, f.radial_n, f.tangential_n));
    let bore = stations
        .iter()
        .map(|f| force(a, f.angle_rad, f.radial_n, f.tangential_n));
    let forces: Vec<tilt::PlaneForce> = rim.into_iter().chain(bore).collect();
    let annulus = Annulus {
        bore_radius_m: a,
        rim_radius_m: b,
    };
    let virial = tilt::stiffness_of_forces_n_m(&forces);
    let inertia = annulus.tilt_inertia_kg_m2(blade.mass_per_area_kg_per_m2());
    let [i, j] = [plate.offset(1), plate.offset(1) + 5];
    let found = [stiffness[(i, i)], stiffness[(j, j)], stiffness[(i, j)]];
    let scale = virial.iter().fold(0.0, |max: f64, v| max.max(v.abs())) / inertia;
    for (found, moment) in found.into_iter().zip(virial) {
        let error = (found - moment / inertia).abs() / scale;
        assert!(error < 1e-10, "{found} {} {error:e}", moment / inertia);
    }
    for k in 0..stiffness.nrows() {
        assert!(stiffness[(k, 0)].abs() <= 1e-10 * stiffness.norm_l2());
    }
}

/// A load rotated by a whole pitch acts on the same arrangement of teeth, so that the result is rotated too.
#[test]
fn turning_the_load_by_a_pitch_turns_the_reaction() {
    let scene = scene_with(|_| ());
    let run = |turn: f64| {
        let loads = cut().map(|load| RimForce {
            angle_rad: load.angle_rad + turn,
            ..load
        });
        simulate(&scene, &loads, rad_per_s(1800.0), &Run::default())
            .unwrap()
            .reaction
    };
    let (here, there) = (run(0.0), run(TAU / 20.0));
    let largest = here
        .stations
        .iter()
        .fold(0.0, |max: f64, force| max.max(force.tangential_n.abs()));
    for (k, force) in here.stations.iter().enumerate() {
        let turned = &there.stations[(k + 720 / 20) % 720];
        assert!((force.tangential_n - turned.tangential_n).abs() < 1e-4 * largest);
    }
}

/// Without load and gap there is no motion and no contact.
#[test]
fn an_unloaded_blade_stays_centred() {
    for clearance_m in [0.0, 0.25e-3] {
        let scene = scene_with(|spline| spline.clearance_m = clearance_m);
        let result = simulate(&scene, &[], 200.0, &Run::default()).unwrap();
        let last = result.orbit.last().unwrap();
        assert_eq!([last.x_m, last.y_m, last.twist_rad], [0.0; 3]);
        assert_eq!(result.reaction.teeth.most, 0);
        assert_eq!(result.reaction.imbalance, 0.0);
    }
}

#[test]
fn missing_splines_speeds_and_settings_are_refused() {
    let run = Run::default();
    let plain = simulate(&Scene::paper(), &[], 100.0, &run).err();
    assert_eq!(plain, Some(SplineError::NoSpline));
    let scene = scene_with(|_| ());
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = simulate(&scene, &cut(), speed, &run);
        assert!(matches!(refused, Err(SplineError::Speed { .. })));
    }
    for bad in [
        Run {
            tolerance: f64::NAN,
            ..run
        },
        Run {
            averaged_revolutions: 0,
            ..run
        },
        Run {
            settling_revolutions: u32::MAX,
            ..run
        },
    ] {
        let refused = simulate(&scene, &cut(), 100.0, &bad);
        assert!(matches!(refused, Err(SplineError::Run { .. })));
    }
    let infinite = radial_push(0.0, f64::INFINITY);
    let refused = simulate(&scene, &infinite, 100.0, &run).err();
    assert_eq!(refused, Some(SplineError::NotFinite));
}
