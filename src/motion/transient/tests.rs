//! Integrators and the run-up, compared with closed forms, invariants and another integrator.

use std::f64::consts::TAU;

use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Polar, RunUpFile, Scene, rad_per_s, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::{lowest_eigenpairs, orthonormal, split};
use crate::motion::transient::propagator::Propagator;
use crate::motion::transient::runup::{RunUpHistory, run_up};
use crate::motion::transient::{Integrator, Newmark, State, at_point};
use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};
fn paper_plate(resolution: Resolution) -> Plate {
    Plate::new(&Scene::paper(), resolution)
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
    let by_newmark = kept(&Newmark::new(&system, (speed, 0.0), &[], 2e-3));
    assert!(by_newmark < 1e-8, "{by_newmark:e}");
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
    let paper = Scene::paper();
    let cut = paper.cut().unwrap();
    let run = cut.at_rpm(2800.0).unwrap();
    let speed = run.speed_rad_per_s;
    let full = GyroscopicSystem::of_plate(&plate.in_cut(cut, &run));
    // The basis contains few modes, because the stiffest would require steps of a microsecond.
    let basis = low_modes(&full, speed);
    let system = full.project(basis.as_ref());
    let loads = [basis.transpose() * at_point(&plate, Polar::new(plate.blade.outer_radius_m, 0.3))];
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

/// Half the largest step changes the deflection in a run-up by less than one percent; a slow run-up below the
/// critical speed follows the static deflection.
#[test]
fn a_run_up_converges_and_is_static_when_slow() {
    let plate = paper_plate(SMALL);
    let probe = Scene::paper().probe();
    let force = Scene::paper().side_force();
    let runup = RunUpFile {
        from_rpm: 0.0,
        to_rpm: 1300.0,
        duration_s: 20.0,
        stretching: false,
    };
    let record = |highest_hz: f64, duration_s: f64| {
        let runup = RunUpFile {
            duration_s,
            ..runup
        };
        run_up(
            &plate,
            (&runup, &force),
            probe,
            TAU * highest_hz,
            &|_, _| (),
        )
        .unwrap()
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
    let force = Scale(5.0) * at_point(&plate, Polar::new(plate.blade.outer_radius_m, 0.0));
    let read = at_point(&plate, probe.polar());
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
