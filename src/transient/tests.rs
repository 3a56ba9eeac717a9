//! The saw in the cut and in the run-up: time histories compared with closed forms, invariants, another
//! integrator, and eigenvalues.

use std::f64::consts::TAU;

use crate::plate::{Plate, Resolution};
use crate::scene::{Cut, CutRun, RunUp, Scene, SceneFile, SpeedRange, rad_per_s, rpm};
use crate::spectrum::{fastest_growing, lowest_eigenpairs, orthonormal, split};
use crate::system::GyroscopicSystem;
use crate::transient::cut::cut_history;
use crate::transient::propagator::Propagator;
use crate::transient::runup::{RunUpHistory, run_up};
use crate::transient::saw_in_cut::SawInCut;
use crate::transient::teeth::{ToothPassing, tooth_passing};
use crate::transient::verdict_map::verdict_map;
use crate::transient::{Integrator, Newmark, State, at_point};
use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};

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

/// ½ q̇ᵀq̇ + ½ qᵀKq, which is conserved because the gyroscopic force does no work.
fn energy(system: &GyroscopicSystem, speed: f64, q: &Col<f64>, v: &Col<f64>) -> f64 {
    let stiffness = system.stiffness_at(speed);
    0.5 * (v.transpose() * v) + 0.5 * (q.transpose() * stiffness * q)
}

fn bent(order: usize) -> Col<f64> {
    Col::from_fn(order, |i| {
        (1.3 * i as f64 + 0.2).sin() / (1.0 + i as f64).powi(2)
    })
}

/// The speed is below the first critical one, where every mode has positive energy.
#[test]
fn an_undamped_unloaded_saw_keeps_its_energy() {
    let plate = paper_plate(Resolution {
        max_diameters: 3,
        radial_functions: 3,
    });
    let system = GyroscopicSystem::of_plate(&plate);
    let speed = rad_per_s(1200.0);
    let begun = State::still(bent(system.order()));
    let energy = |state: &State| energy(&system, speed, &state.displacement, &state.velocity);
    let before = energy(&begun);
    let kept = |integrator: &dyn Integrator| {
        let mut state = begun.clone();
        for _ in 0..100_000 {
            state = integrator.step(&state, [&[], &[]]).unwrap();
        }
        (energy(&state) / before - 1.0).abs()
    };
    let lost = kept(&Propagator::new(&system, speed, &[], 2e-3).unwrap());
    assert!(lost < 1e-10, "{lost:e}");
    // Each step solves with a matrix whose condition number is about 1e4, and rounding errors accumulate.
    let lost = kept(&Newmark::new(&system, (speed, 0.0), &[], 2e-3));
    assert!(lost < 1e-8, "{lost:e}");
}

/// The lowest modes of a system at a speed, as a basis.
fn low_modes(system: &GyroscopicSystem, speed: f64) -> Mat<f64> {
    let vectors: Vec<Col<f64>> = lowest_eigenpairs(system, speed, 6, 300.0)
        .unwrap()
        .into_iter()
        .flat_map(|(_, q)| {
            let (re, im) = split(&q);
            [re, im]
        })
        .collect();
    orthonormal(system.order(), &vectors, 1e-9)
}

/// Both integrators compute the saw in the paper's cut at 2800 rpm under a load that grows with time. Half of
/// Newmark's step gives a quarter of its error.
#[test]
fn newmark_tends_to_the_exact_answer_in_second_order() {
    let plate = paper_plate(SMALL);
    let run = run_at(2800.0);
    let speed = run.speed_rad_per_s;
    let system = GyroscopicSystem::of_plate(&plate.in_cut(&paper_cut(), &run));
    // The basis contains few modes, because the stiffest would require steps of a microsecond.
    let basis = low_modes(&system, speed);
    let system = system.project(basis.as_ref());
    let loads = [basis.transpose() * at_point(&plate, plate.blade.outer_radius_m, 0.3)];
    let end_s = 0.2;
    let exact = Propagator::new(&system, speed, &loads, end_s)
        .unwrap()
        .step(&State::rest(system.order()), [&[0.0], &[end_s]])
        .unwrap()
        .displacement;
    let distance = |steps: usize| {
        let step_s = end_s / steps as f64;
        let newmark = Newmark::new(&system, (speed, 0.0), &loads, step_s);
        let mut state = State::rest(system.order());
        for step in 0..steps {
            let size = |step: usize| [step as f64 * step_s];
            let sizes = [size(step), size(step + 1)];
            state = newmark.step(&state, [&sizes[0], &sizes[1]]).unwrap();
        }
        (&state.displacement - &exact).norm_l2() / exact.norm_l2()
    };
    let (coarse, fine) = (distance(8000), distance(16000));
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.02, "{order}: {coarse:e} {fine:e}");
}

/// With the forces of Table 3 an independent implementation finds the saw stable at 1800 rpm, and a growth of
/// 6.0 1/s at 4.53 Hz at 2800 rpm. The time history does not use eigenvalues.
#[test]
fn the_paper_saw_is_stable_at_1800_and_flutters_at_2800() {
    let plate = paper_plate(DESIGN);
    let probe = *Scene::paper().probe();
    let history_at = |rpm: f64| {
        let (cut, run) = (paper_cut(), run_at(rpm));
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        cut_history(&saw, &probe).unwrap()
    };
    let quiet = history_at(1800.0);
    assert_eq!(quiet.in_cut.growth_per_s, 0.0);
    let fitted = quiet.fitted.unwrap().growth_per_s;
    assert!(fitted.abs() < 1e-3, "{fitted:e}");

    let loud = history_at(2800.0);
    let growth = loud.in_cut.growth_per_s;
    let hertz = loud.in_cut.frequency_rad_per_s / TAU;
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
        assert_eq!(history.idle.growth_per_s, 0.0);
    }
}

/// The record of the probe in the reduced basis equals that of the full model.
#[test]
fn few_motions_make_the_record_of_the_full_model() {
    let plate = paper_plate(SMALL);
    let (cut, run) = (paper_cut(), run_at(2800.0));
    let probe = *Scene::paper().probe();
    let history = cut_history(&SawInCut::new(&plate, &cut, &run).unwrap(), &probe).unwrap();
    let system = GyroscopicSystem::of_plate(&plate.in_cut(&cut, &run));
    let mut load: Col<f64> = Col::zeros(system.order());
    for angle in cut.teeth.standing().iter().map(|tooth| tooth.angle_rad) {
        load += at_point(&plate, plate.blade.outer_radius_m, angle);
    }
    let read = at_point(&plate, probe.radius_m, probe.angle_rad);
    let propagator =
        Propagator::new(&system, run.speed_rad_per_s, &[load], run.duration_s).unwrap();
    let force = [run.lateral_n];
    let rest = State::rest(system.order());
    let whole = propagator.step(&rest, [&force, &force]).unwrap();
    let whole = whole.displacement.transpose() * &read;
    let end = history
        .time_s
        .partition_point(|t| *t < history.forces_s.1 - 1e-9);
    let few = history.deflection_m[end];
    assert!((few / whole - 1.0).abs() < 1e-3, "{few} {whole}");
}

/// Floquet multipliers of moving loads approach those of mean loads as the teeth follow each other faster. At
/// 1960 teeth a second the two differ by 0.06 %; stationary loads differ from both by 3 %.
#[test]
fn passing_teeth_act_like_their_mean() {
    let plate = paper_plate(DESIGN);
    let probe = *Scene::paper().probe();
    let passing_at = |rpm: f64, stages: usize| -> ToothPassing {
        let (cut, run) = (paper_cut(), run_at(rpm));
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        tooth_passing(&saw, &probe, stages).unwrap()
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
        (&turns, &levels),
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
            let exact = fastest_growing(&system, run.speed_rad_per_s).unwrap();
            let exact = exact.map_or(0.0, |lambda| lambda.re);
            let mapped = map.growth[row][column].growth_per_s;
            let scale = exact.max(0.1);
            assert!(
                (mapped - exact).abs() < 5e-3 * scale,
                "{turn} {level}: {mapped} {exact}"
            );
        }
    }
}

/// Half the largest step changes the deflection in a run-up by less than one percent; a slow run-up below the
/// critical speed follows the static deflection.
#[test]
fn a_run_up_converges_and_is_static_when_slow() {
    let plate = paper_plate(SMALL);
    let probe = *Scene::paper().probe();
    let runup = RunUp {
        speeds: SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: rad_per_s(1300.0),
        },
        duration_s: 20.0,
        force_n: 5.0,
        angle_rad: 0.0,
        stretching: false,
    };
    let record = |highest_hz: f64, duration_s: f64| {
        let runup = RunUp {
            duration_s,
            ..runup
        };
        run_up(&plate, &runup, &probe, TAU * highest_hz, &|_, _| ()).unwrap()
    };
    let (coarse, fine) = (record(50.0, 20.0), record(100.0, 20.0));
    let at = |history: &RunUpHistory, at_rpm: f64| {
        let place = history
            .speed_rad_per_s
            .partition_point(|s| rpm(*s) < at_rpm);
        history.deflection_m[place]
    };
    let largest = fine
        .deflection_m
        .iter()
        .fold(0.0_f64, |max, w| max.max(w.abs()));
    for speed in [300.0, 900.0, 1200.0] {
        let change = (at(&coarse, speed) - at(&fine, speed)) / largest;
        assert!(change.abs() < 1e-2, "{speed}: {change:e}");
    }
    let system = GyroscopicSystem::of_plate(&plate);
    let force = Scale(5.0) * at_point(&plate, plate.blade.outer_radius_m, 0.0);
    let read = at_point(&plate, probe.radius_m, probe.angle_rad);
    let slow = record(50.0, 60.0);
    for speed in [300.0, 900.0] {
        let held = system.stiffness_at(rad_per_s(speed));
        let fixed = read.transpose() * held.partial_piv_lu().solve(&force);
        let seen = at(&slow, speed);
        assert!(
            (seen - fixed).abs() < 0.05 * largest,
            "{speed}: {seen:e} {fixed:e}"
        );
    }
}
