//! The saw in the cut: time histories compared with eigenvalues, the full model and values of an independent
//! implementation.

use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{InPlane, Mount, Polar, SceneFile};
use crate::model::system::GyroscopicSystem;
use crate::modes::fastest_growing;
use crate::motion::transient::{Integrator, Propagator, State, at_point, lateral_load};
use faer::{Col, Mat};

use super::history::CutHistory;

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};
/// The basis of the accuracy `design`.
const DESIGN: Resolution = Resolution {
    max_diameters: 16,
    radial_functions: 8,
};

fn paper_plate(resolution: Resolution) -> Plate {
    Plate::new(&Scene::paper(), resolution)
}

/// The paper's cut on four teeth, as the independent implementation computes it.
fn paper_cut() -> Cut {
    let four = |file: &mut SceneFile| file.cut.iter_mut().for_each(|c| c.teeth_in_cut = Some(4));
    let paper = Scene::paper().edited(four).expect("four teeth");
    paper.cut().expect("the paper's scene has a cut").clone()
}

fn run_at(rpm: f64) -> CutRun {
    paper_cut().at_rpm(rpm).unwrap()
}

/// With the forces of Table 3 an independent implementation finds the saw stable at 1800 rpm, and a growth of
/// 6.0 1/s at 4.53 Hz at 2800 rpm. The time history does not use eigenvalues.
#[test]
fn the_paper_saw_is_stable_at_1800_and_flutters_at_2800() {
    let plate = paper_plate(DESIGN);
    let probe = Scene::paper().probe();
    let history_at = |rpm: f64| {
        let (cut, run) = (paper_cut(), run_at(rpm));
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        cut_history(&saw, probe, 0.85).unwrap()
    };
    let quiet = history_at(1800.0);
    assert_eq!(quiet.in_cut().growth_per_s, 0.0);
    let quiet_growth = quiet.fitted.unwrap().growth_per_s;
    assert!(quiet_growth.abs() < 1e-3, "{quiet_growth:e}");

    let loud = history_at(2800.0);
    let growth = loud.in_cut().growth_per_s;
    let hertz = loud.in_cut().frequency_rad_per_s / TAU;
    assert!((growth - 6.0).abs() < 0.05, "{growth}");
    assert!((hertz - 4.53).abs() < 0.01, "{hertz}");
    let fitted = loud.fitted.unwrap();
    assert!(
        (fitted.growth_per_s / growth - 1.0).abs() < 1e-4,
        "{fitted:?}"
    );
    let dominant = loud.dominant_rad_per_s.unwrap() / TAU;
    assert!((dominant / hertz - 1.0).abs() < 1e-4, "{dominant} {hertz}");
    // With the force that follows from the measured power, both are stable.
    for history in [quiet, loud] {
        assert_eq!(history.in_cut_by_power.unwrap().growth_per_s, 0.0);
        assert_eq!(history.idle().growth_per_s, 0.0);
    }
}

/// The record of the probe in the reduced basis equals that of the full model.
#[test]
fn few_motions_make_the_record_of_the_full_model() {
    let plate = paper_plate(SMALL);
    let (cut, run) = (paper_cut(), run_at(2800.0));
    let probe = Scene::paper().probe();
    let history = cut_history(&SawInCut::new(&plate, &cut, &run).unwrap(), probe, 0.85).unwrap();
    let system = GyroscopicSystem::of_plate(&plate.in_cut(&cut, &run));
    let mut load: Col<f64> = Col::zeros(system.order());
    for angle in cut.teeth.standing().iter().map(|tooth| tooth.angle_rad) {
        load += at_point(&plate, Polar::new(plate.blade.outer_radius_m, angle));
    }
    let read = at_point(&plate, probe.polar());
    let propagator =
        Propagator::new(&system, run.speed_rad_per_s, &[load], run.duration_s).unwrap();
    let force = [run.lateral_n];
    let rest = State::rest(system.order());
    let whole = propagator
        .step(&rest, [&force, &force])
        .unwrap()
        .displacement
        .transpose()
        * &read;
    let (record, end_s) = (&history.record, cut.idle_s + run.duration_s);
    let end = record.time_s.partition_point(|t| *t < end_s - 1e-9);
    let few = record.deflection_m[end];
    assert!((few / whole - 1.0).abs() < 1e-3, "{few} {whole}");
}

/// A saw between collars with a stiff pad, whose modes lie close together.
fn collar_saw(idle_s: f64) -> Scene {
    let scene = Scene::paper().edited(|file| {
        (file.spline, file.runup, file.measured, file.probe) = (None, None, None, None);
        let blade = &mut file.blade;
        (blade.outer_diameter_m, blade.inner_diameter_m) = (1.4, 0.42);
        (blade.thickness_m, blade.teeth) = (3.2e-3, Some(57));
        file.mount = Mount::Collar {
            diameter_m: 0.84,
            in_plane: InPlane::Fixed,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
        let pad = &mut file.guides[0];
        (pad.radius_m, pad.angle_deg, pad.stiffness_n_per_m) = (0.64, 157.0, 2.57e7);
        (pad.radial_length_m, pad.tangential_length_m) = (0.035, 0.068);
        if let Some(cut) = &mut file.cut {
            cut.teeth_in_cut = Some(3);
            cut.idle_s = idle_s;
        }
    });
    scene.unwrap()
}

/// The record of a saw at 640 rpm under a force of 1 N on each tooth for a tenth of a second.
fn collar_history(idle_s: f64) -> (Plate, Cut, CutRun, CutHistory) {
    let scene = collar_saw(idle_s);
    let plate = Plate::new(&scene, SMALL);
    let cut = scene.needed_cut().unwrap().clone();
    let run = CutRun {
        lateral_n: 1.0,
        duration_s: 0.1,
        ..cut.at_rpm(640.0).unwrap()
    };
    let saw = SawInCut::new(&plate, &cut, &run).unwrap();
    let history = cut_history(&saw, scene.probe(), 0.85).unwrap();
    (plate, cut, run, history)
}

/// After the cut the blade swings without a force. All its functions, moved by the exact propagator in steps of 10 µs and read at 720
/// places, deflect as far as the record says, which has samples a millisecond apart. The times at which samples are taken do not matter.
#[test]
fn the_largest_deflection_of_the_rim_is_that_between_the_samples() {
    for idle_s in [0.1, 0.0951] {
        let (plate, cut, run, history) = collar_history(idle_s);
        let found = history.largest_deflections_m(idle_s + run.duration_s);
        let load = lateral_load(&plate, &cut.teeth.standing());
        let systems = [plate.in_cut(&cut, &run), plate.clone()];
        let rim = plate.blade.outer_radius_m;
        let places = Mat::from_fn(720, load.nrows(), |k, i| {
            let angle = TAU * k as f64 / 720.0;
            plate.functions_at(rim, angle)[i]
        });
        let mut state = State::rest(load.nrows());
        for (k, (plate, duration_s)) in systems.iter().zip([run.duration_s, idle_s]).enumerate() {
            let force = [if k == 0 { run.lateral_n } else { 0.0 }];
            let system = GyroscopicSystem::of_plate(plate);
            let steps = (duration_s / 1e-5).round() as usize;
            let step_s = duration_s / steps as f64;
            let loads = [load.clone()];
            let propagator = Propagator::new(&system, run.speed_rad_per_s, &loads, step_s).unwrap();
            let mut exact = 0.0_f64;
            for step in 0..steps {
                state = propagator.step(&state, [&force, &force]).unwrap();
                if step % 4 == 0 {
                    exact = exact.max((&places * &state.displacement).norm_max());
                }
            }
            let error = found[k].unwrap() / exact - 1.0;
            assert!(error.abs() < 0.01, "{idle_s} {k}: {found:?} {exact:e}");
        }
    }
}

/// Floquet multipliers of moving loads approach those of mean loads as the teeth follow each other faster. At
/// 1960 teeth a second the two differ by 0.06 %; stationary loads differ from both by 3 %.
#[test]
fn passing_teeth_act_like_their_mean() {
    let plate = paper_plate(DESIGN);
    let probe = Scene::paper().probe();
    let passing_at = |rpm: f64, stages: usize| -> ToothPassing {
        let (cut, run) = (paper_cut(), run_at(rpm));
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        tooth_passing(&saw, probe, stages).unwrap().found
    };
    let passing = passing_at(2800.0, 8);
    let of_mean = passing.passing_growth_per_s / passing.mean_growth_per_s - 1.0;
    assert!(of_mean.abs() < 1e-3, "{passing:?}");
    let of_standing = passing.passing_growth_per_s / passing.standing_growth_per_s - 1.0;
    assert!((-0.04..-0.02).contains(&of_standing), "{passing:?}");
    let finer = passing_at(2800.0, 16);
    let change = finer.passing_growth_per_s / passing.passing_growth_per_s - 1.0;
    assert!(change.abs() < 1e-3, "{change:e}");
    let quiet = passing_at(1800.0, 8);
    // On an undamped saw moving loads couple two high modes wherever their frequencies add up to a multiple
    // of the tooth passing frequency. One such resonance, 0.07 rpm wide, is near 1800 rpm; its position
    // depends on the basis. Its growth stays below the threshold of flutter.
    let threshold = Scene::paper().flutter_threshold_per_s();
    assert!(quiet.passing_growth_per_s < threshold, "{quiet:?}");
}

/// Points of the map between its snapshots equal the growth of saws whose guides are moved and whose loads are
/// scaled, on the full model.
#[test]
fn the_map_holds_what_moved_guides_and_scaled_loads_do() {
    let (cut, run) = (paper_cut(), run_at(2800.0));
    let plate = paper_plate(DESIGN);
    let turns = [-30.0, -5.0, 0.0, 10.0, 30.0].map(f64::to_radians);
    let levels = [0.9, 1.2];
    let map = verdict_map(
        &SawInCut::new(&plate, &cut, &run).unwrap(),
        &Scene::paper(),
        &turns,
        &levels,
        &|_, _| (),
    )
    .unwrap();
    for (column, turn) in turns.iter().enumerate().take(4).skip(1) {
        for (row, level) in levels.iter().enumerate() {
            let scene = Scene::paper().edited(|saw| {
                for guide in &mut saw.guides {
                    guide.angle_deg += turn.to_degrees();
                }
            });
            let moved = Plate::new(&scene.unwrap(), DESIGN);
            let scaled = CutRun {
                tangential_n: level * run.tangential_n,
                radial_n: level * run.radial_n,
                ..run
            };
            let cutting = moved.in_cut(&cut, &scaled);
            let system = GyroscopicSystem::of_plate(&cutting);
            let exact = fastest_growing(&system, run.speed_rad_per_s)
                .unwrap()
                .map_or(0.0, |lambda| lambda.re);
            let mapped = map.growth_per_s[row][column];
            let scale = exact.max(0.1);
            assert!(
                (mapped - exact).abs() < 5e-3 * scale,
                "{turn} {level}: {mapped} {exact}"
            );
        }
    }
}
