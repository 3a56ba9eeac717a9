//! The reaction assumed at the bore, compared with that of simulated spline teeth.
//!
//! The paper's blade in the paper's cut (Table 3, four teeth of 42, 2800 rpm). The paper gives neither the number nor
//! the shape of the spline teeth: the tests take 20 teeth, with flanks along the radius and at 30° to it, which include
//! the usual shapes.

use faer::{Mat, Side};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, SplineFile, rad_per_s};
use sawflutter::model::spline::{ReactionEffect, Run, SplineRun, reaction_effect, simulate};
use sawflutter::model::system::GyroscopicSystem;

use super::saws::{fastest, paper_cut};

/// K and C of the paper in millimetres, N/mm^{3/2} and N/(mm/s)^{3/2}, and in metres.
const IN_MILLIMETRES: [f64; 2] = [6.957e9, 4743.0];
const IN_METRES: [f64; 2] = [2.2e5, 0.15];

fn paper_on_spline(degrees: f64, [stiffness, damping]: [f64; 2]) -> Scene {
    let spline = SplineFile {
        teeth: 20,
        pressure_angle_deg: degrees,
        contact_stiffness_n_per_m_3_2: stiffness,
        contact_damping_n_s_3_2_per_m_3_2: damping,
        clearance_m: 0.25e-3,
        pitch_radius_m: None,
        weight_angle_deg: None,
    };
    let scene = Scene::paper().edited(|saw| saw.spline = Some(spline));
    scene.unwrap()
}

fn plate() -> Plate {
    let resolution = Resolution {
        max_diameters: 8,
        radial_functions: 6,
    };
    Plate::new(&Scene::paper(), resolution)
}

/// The modes of the guided blade at rest that determine a verdict.
fn low_modes(plate: &Plate) -> Mat<f64> {
    let stiffness = GyroscopicSystem::of_plate(plate).stiffness;
    let modes = stiffness.self_adjoint_eigen(Side::Lower).unwrap();
    modes.U().subcols(0, 16).to_owned()
}

fn in_the_cut(
    scene: &Scene,
    plate: &Plate,
    cut: [f64; 2],
    rpm: f64,
) -> (SplineRun, ReactionEffect) {
    let loads = paper_cut(cut);
    let run = simulate(scene, &loads, rad_per_s(rpm), &Run::default()).unwrap();
    let effect = reaction_effect(plate, &loads, &run.reaction);
    (run, effect)
}

/// Radial flanks transmit the torque as a shear and the force as more shear on one side, which is close to the
/// assumption. The flutter remains.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn straight_flanks_react_nearly_as_assumed() {
    let plate = plate();
    let scene = paper_on_spline(0.0, IN_MILLIMETRES);
    let (_, effect) = in_the_cut(&scene, &plate, [1240.0, 88.0], 2800.0);
    let change = effect.relative_change_on(low_modes(&plate).as_ref());
    assert!(change > 0.01 && change < 0.15, "{change}");
    let (assumed, _) = fastest(&plate, &effect.assumed, 2800.0);
    let (simulated, hertz) = fastest(&plate, &effect.simulated, 2800.0);
    assert!(
        (simulated / assumed - 1.0).abs() < 0.05,
        "{assumed} {simulated}"
    );
    assert!(hertz < 5.0, "{hertz}");
}

/// Flanks at 30° turn the drive into a pressure on the bore, tan 30° of it, which the assumed reaction does not
/// contain. It changes the verdict.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn slanted_flanks_press_the_bore_and_change_the_verdict() {
    let plate = plate();
    let scene = paper_on_spline(30.0, IN_MILLIMETRES);
    let (run, effect) = in_the_cut(&scene, &plate, [1240.0, 88.0], 2800.0);
    let pressure: f64 = run.reaction.stations.iter().map(|f| f.radial_n).sum();
    let drive: f64 = run.reaction.stations.iter().map(|f| f.tangential_n).sum();
    // Only the driving flanks are in contact, so that every force has this slope.
    let slope = pressure / drive;
    assert!((slope - 30_f64.to_radians().tan()).abs() < 1e-12, "{slope}");
    assert!(effect.relative_change_on(low_modes(&plate).as_ref()) > 0.3);
    let (assumed, _) = fastest(&plate, &effect.assumed, 2800.0);
    let (simulated, _) = fastest(&plate, &effect.simulated, 2800.0);
    assert!(assumed > 1.0 && simulated < 1e-6, "{assumed} {simulated}");
}

/// With K read in metres, the cut presses a tooth in by more than a centimetre, a hundred gaps; with K in millimetres
/// by some hundredths of a millimetre. As long as the drive keeps one flank of every tooth loaded, the mean reaction
/// hardly changes.
#[test]
fn the_papers_stiffness_in_metres_is_too_soft_to_be_a_contact() {
    let plate = plate();
    let [soft, stiff] = [IN_METRES, IN_MILLIMETRES].map(|contact| {
        let scene = paper_on_spline(0.0, contact);
        in_the_cut(&scene, &plate, [1064.0, 75.0], 1800.0)
    });
    let deepest = |(run, _): &(SplineRun, _)| run.reaction.teeth.deepest_m;
    assert!(deepest(&soft) > 10e-3, "{}", deepest(&soft));
    assert!(deepest(&stiff) < 0.1e-3, "{}", deepest(&stiff));
    let apart = (&soft.1.simulated - &stiff.1.simulated).norm_l2() / stiff.1.simulated.norm_l2();
    assert!(apart < 1e-2, "{apart}");
}

/// The table of the documentation, K and C read in millimetres and in metres: pressure angle, change
/// of K_e on the low modes, growth at 2800 rpm as assumed and as simulated, and at 1800 rpm. The
/// assumed reaction leaves the saw stable at 1800 rpm.
const TABLE: [(f64, f64, [f64; 2], f64); 4] = [
    (0.0, 0.096, [5.218, 5.388], 0.0),
    (10.0, 0.181, [5.218, 2.511], 0.0),
    (20.0, 0.383, [5.218, 0.0], 0.0),
    (30.0, 0.628, [5.218, 0.0], 1.070),
];

#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn the_effect_of_the_shape_of_the_flanks() {
    let plate = plate();
    let modes = low_modes(&plate);
    let near = |found: f64, expected: f64| (found - expected).abs() < 2e-3;
    for contact in [IN_MILLIMETRES, IN_METRES] {
        for (degrees, change, at_2800, at_1800) in TABLE {
            let scene = paper_on_spline(degrees, contact);
            let growth = |effect: &ReactionEffect, rpm: f64| {
                [&effect.assumed, &effect.simulated].map(|k| fastest(&plate, k, rpm).0)
            };
            let (slow, effect) = in_the_cut(&scene, &plate, [1064.0, 75.0], 1800.0);
            let [assumed, simulated] = growth(&effect, 1800.0);
            assert!(near(assumed, 0.0), "{degrees}: {assumed}");
            assert!(near(simulated, at_1800), "{degrees}: {simulated}");

            let (fast, effect) = in_the_cut(&scene, &plate, [1240.0, 88.0], 2800.0);
            let found = effect.relative_change_on(modes.as_ref());
            assert!((found - change).abs() < 1e-3, "{degrees}: {found}");
            let [assumed, simulated] = growth(&effect, 2800.0);
            assert!(near(assumed, at_2800[0]), "{degrees}: {assumed}");
            assert!(near(simulated, at_2800[1]), "{degrees}: {simulated}");

            for run in [slow, fast] {
                // The drive keeps one flank of every tooth loaded.
                let teeth = &run.reaction.teeth;
                assert_eq!([teeth.fewest, teeth.most], [20; 2]);
                assert!(run.reaction.unsteadiness < 1e-4 && run.energy_defect < 1e-8);
            }
        }
    }
}
