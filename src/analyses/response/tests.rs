//! Steady states compared with solutions of the full model, with rigid bodies, with one mode, and with a blade at rest in its
//! own frame.

use std::f64::consts::TAU;

use super::*;
use crate::model::evenly_spaced;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{
    Accuracy, DampingFile, GuideFile, InPlane, Mount, ResponseFile, SideForceFile, SweepFile,
    rad_per_s,
};
use crate::model::system::GyroscopicSystem;
use crate::motion::steady::{State, reading, solution};
use crate::stability::ChosenBasis;
use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};

/// The paper's saw, with another excitation.
pub(super) fn scene(
    force: SideForceFile,
    response: ResponseFile,
    edit: impl FnOnce(&mut crate::model::scene::SceneFile),
) -> Scene {
    let scene = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.measured = None;
        (saw.side_force, saw.response) = (Some(force), Some(response));
        edit(saw);
    });
    scene.unwrap()
}

/// The blade on the basis that `response` chooses.
pub(super) fn plate(scene: &Scene) -> Plate {
    let chosen = ChosenBasis::new(scene, scene.tolerance());
    chosen.unwrap().saw.plate
}

pub(super) fn clamped_free_blade(saw: &mut crate::model::scene::SceneFile) {
    saw.guides.clear();
    saw.cut = None;
    saw.spline = None;
    saw.mount = Mount::Collar {
        diameter_m: 0.25,
        in_plane: InPlane::Free,
        clamp_stiffness_n_m_per_rad_per_m: None,
    };
}

/// Independent value: the solution of the full matrices at each state, also beside resonances.
#[test]
fn states_on_few_solutions_are_those_of_the_full_matrices() {
    let damping = |saw: &mut crate::model::scene::SceneFile| {
        saw.damping = Some(DampingFile {
            material_retardation_time_s: 2e-6,
            air_n_s_per_m3: 3.0,
            ..DampingFile::default()
        });
    };
    let force = SideForceFile {
        oscillating_n: 1.0,
        order: Some(42),
        ..SideForceFile::of(1.0)
    };
    let typed = ResponseFile {
        flatness_m: 1e-4,
        imbalance_kg_m2: 1e-6,
        ..ResponseFile::default()
    };
    let scene = scene(force, typed, damping);
    let plate = Plate::new(&scene, Resolution::of(Accuracy::Draft));
    let system = GyroscopicSystem::of_plate(&plate);
    let solver = Solver::new(&plate, &scene);
    for load in loads(&plate, &scene, 1.0).unwrap() {
        let states: Vec<State> = evenly_spaced([1.0, rad_per_s(2900.0)], 97)
            .into_iter()
            .map(|speed| State {
                speed_rad_per_s: speed,
                frequency_rad_per_s: f64::from(load.order) * speed,
            })
            .collect();
        let mut family = Family::new(&system, &load.vector).unwrap();
        let read = family.readings(&states, &solver.probes, 1e9).unwrap();
        for (state, read) in states.iter().zip(read) {
            let exact = solution(&system, &load.vector, *state);
            let exact: Vec<c64> = solver.probes.iter().map(|c| reading(c, &exact)).collect();
            let largest = exact.iter().map(|w| w.norm()).fold(0.0, f64::max);
            for (own, exact) in read.unwrap().iter().zip(exact) {
                let error = (own - exact).norm() / largest;
                assert!(error < 1e-5, "{:?} {state:?}: {error}", load.cause);
            }
        }
    }
}

/// Independent value: statics of a rigid blade on three soft springs at 120°, which it compresses by heave and tilt,
/// w = F/3k + F R²/(1.5 k r²) at the force.
#[test]
fn a_blade_on_soft_springs_deflects_as_a_rigid_body() {
    let (k, r) = (30.0, 0.25);
    let force = SideForceFile {
        angle_deg: Some(90.0),
        ..SideForceFile::of(0.01)
    };
    let scene = scene(force, ResponseFile::default(), |saw| {
        saw.cut = None;
        saw.runup = None;
        saw.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm: 600.0,
        });
        let pad = GuideFile {
            radius_m: r,
            stiffness_n_per_m: k,
            damping_n_s_per_m: 0.0,
            radial_length_m: 1e-3,
            tangential_length_m: 1e-3,
            ..saw.guides[0].clone()
        };
        saw.guides = [20.0, 140.0, 260.0]
            .map(|angle_deg| GuideFile {
                angle_deg,
                controller: pad.controller.clone(),
                ..pad
            })
            .into();
    });
    let report = response(&scene, &Options::default()).unwrap();
    let rim = scene.blade().outer_radius_m;
    let expected = 0.01 * (1.0 / (3.0 * k) + rim * rim / (1.5 * k * r * r));
    let line = &report.lines[0];
    let phase = line.phase_deg[0].unwrap().to_radians();
    let at_rest = c64::from_polar(line.amplitude_m[0].unwrap(), phase);
    assert!(
        (at_rest.re / expected - 1.0).abs() < 2e-3 && at_rest.im.abs() < 1e-6 * expected,
        "{at_rest} {expected}"
    );
}

/// Independent value: one mode with viscous damping c per unit mass. At its frequency the deflection for a force lags by 90° with
/// the amplitude φ²/(c ω), and the half-power width is c.
#[test]
fn a_resonance_of_one_mode_has_the_height_and_the_width_of_its_damping() {
    let air_n_s_per_m3 = 40.0;
    let force = SideForceFile {
        angle_deg: Some(90.0),
        ..SideForceFile::of(1.0)
    };
    let scene = scene(force, ResponseFile::default(), |saw| {
        clamped_free_blade(saw);
        saw.damping = Some(DampingFile {
            air_n_s_per_m3,
            ..DampingFile::default()
        });
    });
    let options = Options {
        rpm: Some(0.0),
        to_hz: None,
    };
    let report = response(&scene, &options).unwrap();
    let plate = plate(&scene);
    let c = air_n_s_per_m3 / plate.blade.mass_per_area_kg_per_m2();
    // The frequency of two nodal diameters is apart from the others.
    let eigen = plate.harmonics[2]
        .body_frame_stiffness(0.0)
        .self_adjoint_eigen(faer::Side::Lower)
        .unwrap();
    let natural = eigen.S()[0].sqrt();
    let shape = eigen.U().col(0);
    let rim = plate.basis.evaluate(2, plate.blade.outer_radius_m).value;
    let at_rim: f64 = rim.iter().zip(0..).map(|(r, j)| r * shape[j]).sum();
    let squared = (at_rim / plate.angular_norm(2)).powi(2);
    let points = report.points.unwrap();
    let ratio = |k: usize| TAU * points.frequency_hz[k] / natural;
    let size = |k: usize| points.receptance_m_per_n[k].unwrap();
    let near = (0..points.frequency_hz.len()).filter(|k| (ratio(*k) - 1.0).abs() < 0.05);
    let peak = near.max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap();
    assert!((ratio(peak) - 1.0).abs() < 1e-3, "{}", ratio(peak));
    let height = squared / (c * natural);
    let error = size(peak) / height - 1.0;
    assert!(error.abs() < 0.02, "{error} {height}");
    let phase = points.phase_deg[peak].unwrap().to_radians();
    assert!((phase + 0.25 * TAU).abs() < 0.2, "{phase}");
}

/// Independent value: in the frame of the blade a warped blade without guides is at rest, and centrifugal tension flattens it:
/// (K_b + Ω²K_σ) z = K_b q₀.
#[test]
fn centrifugal_tension_flattens_a_warped_blade() {
    let typed = ResponseFile {
        flatness_m: 1e-4,
        ..ResponseFile::default()
    };
    let scene = scene(SideForceFile::default(), typed, clamped_free_blade);
    let report = response(&scene, &Options::default()).unwrap();
    let plate = plate(&scene);
    let block = &plate.harmonics[2];
    let rest = block.body_frame_stiffness(0.0);
    let eigen = rest.self_adjoint_eigen(faer::Side::Lower).unwrap();
    let rim = plate.basis.evaluate(2, plate.blade.outer_radius_m).value;
    let at_rim = |q: &Col<f64>| -> f64 { rim.iter().zip(0..).map(|(r, j)| r * q[j]).sum() };
    let shape = eigen.U().col(0).to_owned();
    let warp: Col<f64> = faer::Scale(1e-4 / at_rim(&shape)) * shape;
    let mut flattened = 0;
    for (rpm, own) in report.rpm.iter().zip(&report.lines[0].amplitude_m) {
        let turning: Mat<f64> = block.body_frame_stiffness(rad_per_s(*rpm));
        let total = turning.partial_piv_lu().solve(&rest * &warp);
        let expected = at_rim(&total);
        let own = own.unwrap();
        assert!((own / expected - 1.0).abs() < 1e-5, "{own} {expected}");
        flattened += usize::from(expected < 0.8e-4);
    }
    assert!(flattened > 0);
}

/// Independent value: at their resonances the amplitudes of a damped blade with a pad are those of the full matrices, and on both sides
/// of a narrow line they are lower. The lines of a force of the order 42 are a thousandth of their frequency wide at working speeds.
#[test]
fn narrow_lines_of_tooth_passing_have_their_height() {
    let force = SideForceFile {
        oscillating_n: 1.0,
        order: Some(42),
        ..SideForceFile::default()
    };
    let scene = scene(force, ResponseFile::default(), |saw| {
        saw.damping = Some(DampingFile {
            air_n_s_per_m3: 30.0,
            ..DampingFile::default()
        });
        saw.sweep = Some(SweepFile {
            from_rpm: 600.0,
            to_rpm: 1500.0,
        });
    });
    let report = response(&scene, &Options::default()).unwrap();
    let mut lines = report.lines.iter();
    let line = lines.find(|line| line.order == 42).unwrap();
    let plate = plate(&scene);
    let solver = Solver::new(&plate, &scene);
    let load = &loads(&plate, &scene, 0.0).unwrap()[0];
    let exact = |rpm: f64| {
        let speed = rad_per_s(rpm);
        let state = State {
            speed_rad_per_s: speed,
            frequency_rad_per_s: 42.0 * speed,
        };
        let q = solution(&solver.system, &load.vector, state);
        let stiffness = &solver.system.stiffness;
        let energy = (0..q.nrows())
            .map(|i| {
                (0..q.nrows())
                    .map(|j| (q[i].conj() * q[j]).re * stiffness[(i, j)])
                    .sum::<f64>()
            })
            .sum::<f64>();
        (reading(&solver.probes[0], &q).norm(), energy)
    };
    assert!(line.resonances.len() > 10, "{:?}", line.resonances);
    let isolated = line.resonances.windows(3).filter(|near| {
        let gap = |a: usize, b: usize| near[b].rpm / near[a].rpm - 1.0;
        gap(0, 1) > 0.006 && gap(1, 2) > 0.006
    });
    let mut compared = 0;
    for near in isolated {
        let at = near[1];
        let (amplitude, energy) = exact(at.rpm);
        assert!(
            (at.amplitude_m.unwrap() / amplitude - 1.0).abs() < 1e-5,
            "{at:?} {amplitude}"
        );
        for beside in [0.997, 1.003] {
            assert!(exact(beside * at.rpm).1 < energy, "{at:?}");
        }
        compared += 1;
    }
    assert!(compared > 2, "{compared}");
}

/// The speeds are 1 % below the first critical speed, far from all, and next to an edge of flutter, by a tenth of its error.
#[test]
fn an_operating_speed_that_is_hardly_stable_is_named() {
    let at = |rpm: f64| {
        let saw = scene(SideForceFile::of(1.0), ResponseFile::default(), |saw| {
            saw.operating_rpm = Some(rpm);
        });
        response(&saw, &Options::default()).unwrap()
    };
    let bands = at(600.0).instabilities;
    let flutter = bands
        .iter()
        .find(|band| !band.counted_rpm.is_empty() && band.frequency_hz > 0.0)
        .unwrap();
    let error_rpm = flutter.estimated_relative_error.unwrap() * flutter.from_rpm;
    let critical_rpm = Analysis::new(&Scene::paper()).unwrap().model.critical[0].speed_rad_per_s;
    for (operating, words) in [
        (600.0, None),
        (
            0.99 * rpm(critical_rpm),
            Some("within 5 % of the critical speed"),
        ),
        (
            flutter.from_rpm - 0.1 * error_rpm,
            Some("too close to call"),
        ),
    ] {
        let warnings = at(operating).warnings;
        let named = |words: &str| warnings.iter().any(|warning| warning.contains(words));
        let all = ["within 5 % of", "too close to call"];
        assert_eq!(
            all.iter().any(|words| named(words)),
            words.is_some(),
            "{warnings:?}"
        );
        assert!(words.is_none_or(named), "{warnings:?}");
    }
}

/// Without damping no deflection is reported at a resonance: it is unbounded, and the text gives no height of a neighbouring speed. No
/// steady state exists where the saw is unstable by its verdict, which a band below the threshold does not change. A run-out of a blade
/// that tilts freely is refused.
#[test]
fn no_number_is_given_where_there_is_no_steady_state() {
    let saw = scene(SideForceFile::of(1.0), ResponseFile::default(), |_| ());
    let report = response(&saw, &Options::default()).unwrap();
    let analysis = Analysis::new(&saw).unwrap();
    let line = &report.lines[0];
    assert!(!line.resonances.is_empty());
    for (rpm, amplitude) in report.rpm.iter().zip(&line.amplitude_m) {
        let is_stable = analysis.verdict(rad_per_s(*rpm)).band.is_none();
        let critical = line.resonances.iter().any(|at| at.rpm == *rpm);
        assert!((is_stable && !critical) || amplitude.is_none(), "{rpm}");
    }
    let mut bands = analysis.bands().iter();
    let weak = bands.find(|band| band.peak_growth_per_s < saw.flutter_threshold_per_s());
    let weak_rpm = rpm(weak.unwrap().peak_rad_per_s);
    let slow = scene(SideForceFile::of(1.0), ResponseFile::default(), |saw| {
        saw.operating_rpm = Some(weak_rpm);
    });
    let operating = response(&slow, &Options::default()).unwrap().operating;
    assert_eq!(operating.unwrap().steady_state, SteadyState::Bounded);
    for (found, critical) in line.resonances.iter().zip(&analysis.model.critical) {
        assert!((rad_per_s(found.rpm) / critical.speed_rad_per_s - 1.0).abs() < 1e-9);
        assert_eq!(found.steady_state, SteadyState::Unbounded);
    }
    let text = report.summary();
    assert!(text.contains("static  unbounded"), "{text}");
    let points = report.points.unwrap();
    assert!(!points.unbounded_hz.is_empty());
    for natural in &points.unbounded_hz {
        let place = points
            .frequency_hz
            .iter()
            .position(|hz| hz == natural)
            .unwrap();
        assert_eq!(points.receptance_m_per_n[place], None);
    }
    let tilting = ResponseFile {
        runout_m: 1e-4,
        ..ResponseFile::default()
    };
    let refused = response(
        &scene(SideForceFile::default(), tilting, |_| ()),
        &Options::default(),
    );
    let said = refused.unwrap_err().to_string();
    assert!(said.starts_with("response.runout_m must be "), "{said}");
    assert!(said.contains("(you gave 0.0001)"), "{said}");
}

/// A damper that is fixed in space exerts no force on a wave that stands still, so that a constant force deflects this wave without
/// bound at its critical speed, which damping of the pad does not change.
#[test]
fn a_damped_pad_does_not_bound_a_static_deflection() {
    let saw = scene(SideForceFile::of(1.0), ResponseFile::default(), |saw| {
        saw.guides[0].damping_n_s_per_m = 50.0;
    });
    let report = response(&saw, &Options::default()).unwrap();
    let critical = Analysis::new(&saw).unwrap().model.critical;
    assert!(report.damped && !report.lines[0].resonances.is_empty());
    for (found, critical) in report.lines[0].resonances.iter().zip(&critical) {
        assert!((rad_per_s(found.rpm) / critical.speed_rad_per_s - 1.0).abs() < 1e-9);
        assert!(
            matches!(
                found.steady_state,
                SteadyState::Unbounded | SteadyState::None
            ),
            "{found:?}"
        );
    }
    assert!(
        report.lines[0]
            .resonances
            .iter()
            .any(|at| at.steady_state == SteadyState::Unbounded)
    );
}
