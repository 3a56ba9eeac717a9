//! Tooth loads that move with the teeth: Floquet multipliers compared with another integrator.

use std::f64::consts::PI;

use super::*;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Cut, CutRun, Scene, TeethInCut};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};

/// The paper's saw with few teeth, a given number of which is in the cut in the mean.
fn saw_with_teeth(teeth: u32, in_cut: f64, tangential_n: f64) -> Scene {
    let mut file = Scene::paper().file().clone();
    file.blade.teeth = Some(teeth);
    let cut = file.cut.as_mut().unwrap();
    cut.depth_m = Some(in_cut * PI * file.blade.outer_diameter_m / f64::from(teeth));
    cut.teeth_in_cut = None;
    cut.tangential_n_per_tooth = Some(tangential_n);
    cut.power_w = None;
    cut.speeds.clear();
    Scene::try_from(file).unwrap()
}

/// The forces of the teeth that are in the cut when the last one entered it some pitches ago.
fn loads(cut: &Cut, run: &CutRun, entered: f64) -> Vec<RimForce> {
    let TeethInCut {
        angle_deg, mean, ..
    } = cut.teeth;
    let (angle_rad, pitch_rad) = (angle_deg.to_radians(), cut.teeth.pitch_rad());
    let places = (0..8).map(|k| entered + f64::from(k));
    let in_cut = places.filter(|place| *place < mean);
    let force = in_cut.map(|place| RimForce {
        angle_rad: angle_rad + (place - 0.5 * mean) * pitch_rad,
        radial_n: -run.radial_n,
        tangential_n: -run.tangential_n,
    });
    force.collect()
}

/// max ln|μ| / T by the classical Runge–Kutta method, with K_e of the loads at each of `stages` positions.
fn by_runge_kutta(plate: &Plate, cut: &Cut, run: &CutRun, stages: usize, steps: usize) -> f64 {
    let speed = run.speed_rad_per_s;
    let period_s = cut.teeth.pitch_rad() / speed;
    let step_s = period_s / (stages * steps) as f64;
    let order = plate.degrees_of_freedom();
    let mut q = Mat::from_fn(order, 2 * order, |i, k| f64::from(u8::from(i == k)));
    let mut v = Mat::from_fn(order, 2 * order, |i, k| f64::from(u8::from(i + order == k)));
    for stage in 0..stages {
        let loads = loads(cut, run, (stage as f64 + 0.5) / stages as f64);
        let system = GyroscopicSystem::of_plate(&plate.with_edge_loads(&loads));
        let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
        let pull = |q: &Mat<f64>, v: &Mat<f64>| -(&stiffness * q) - &velocity * v;
        for _ in 0..steps {
            let half = Scale(0.5 * step_s);
            let (q1, v1) = (v.clone(), pull(&q, &v));
            let (q2, v2) = (
                &v + half * &v1,
                pull(&(&q + half * &q1), &(&v + half * &v1)),
            );
            let (q3, v3) = (
                &v + half * &v2,
                pull(&(&q + half * &q2), &(&v + half * &v2)),
            );
            let whole = Scale(step_s);
            let (q4, v4) = (
                &v + whole * &v3,
                pull(&(&q + whole * &q3), &(&v + whole * &v3)),
            );
            q += Scale(step_s / 6.0) * (q1 + Scale(2.0) * (q2 + q3) + q4);
            v += Scale(step_s / 6.0) * (v1 + Scale(2.0) * (v2 + v3) + v4);
        }
    }
    // Both halves of the state need a common unit, or rounding of the larger one conceals the smaller one.
    let scale = 300.0;
    let monodromy = Mat::from_fn(2 * order, 2 * order, |i, k| {
        let value = if i < order {
            q[(i, k)]
        } else {
            v[(i - order, k)] / scale
        };
        if k < order { value } else { value * scale }
    });
    let multipliers = monodromy.eigenvalues().unwrap();
    let largest = multipliers.iter().fold(0.0_f64, |max, z| max.max(z.norm()));
    largest.ln() / period_s
}

/// Saws that are stable under stationary loads and under their mean.
#[test]
fn moving_loads_alone_grow_as_another_integrator_finds() {
    let scene = saw_with_teeth(4, 1.0, 4000.0);
    for rpm in [300.0, 600.0, 1200.0, 3000.0] {
        let found = compared(&scene, rpm);
        let others = [found.standing_growth_per_s, found.mean_growth_per_s];
        assert_eq!(others, [0.0; 2], "{rpm}");
        let growth = found.passing_growth_per_s;
        assert!(growth > 0.25, "{rpm}: {growth}");
    }
}

/// Half of the time no tooth cuts, or one of two leaves the cut; the forces are those of whole teeth, which come and go.
#[test]
fn teeth_that_come_and_go_grow_as_another_integrator_finds() {
    for (teeth, in_cut) in [(4, 0.5), (6, 1.5)] {
        let scene = saw_with_teeth(teeth, in_cut, 4000.0);
        let cut = scene.cut().unwrap();
        assert!((cut.teeth.mean - in_cut).abs() < 1e-12);
        let growth = compared(&scene, 1200.0).passing_growth_per_s;
        assert!(growth > 0.1, "{teeth} {in_cut}: {growth}");
    }
}

fn compared(scene: &Scene, rpm: f64) -> ToothPassing {
    let plate = Plate::new(scene, SMALL);
    let cut = scene.cut().unwrap();
    let run = cut.at_rpm(rpm).unwrap();
    let saw = SawInCut::new(&plate, cut, &run).unwrap();
    let found = tooth_passing(&saw, scene.probe(), 32).unwrap().found;
    let exact = by_runge_kutta(&plate, cut, &run, 32, 16);
    let growth = found.passing_growth_per_s;
    assert!(
        (growth / exact - 1.0).abs() < 1e-3,
        "{rpm}: {growth} {exact}"
    );
    found
}

/// The mean of the moving loads is that of a force spread evenly over the arc, whatever the number of steps.
#[test]
fn the_mean_of_moving_loads_is_spread_evenly_over_the_arc() {
    let scene = saw_with_teeth(6, 1.3, 4000.0);
    let plate = Plate::new(&scene, SMALL);
    let cut = scene.cut().unwrap();
    let run = cut.at_rpm(1200.0).unwrap();
    let stiffness = |teeth: &[Tooth]| plate.edge_stiffness_of(&RimForce::of_teeth(teeth, &run));
    let arc_rad = cut.teeth.arc_rad();
    let points = 4000;
    let share = cut.teeth.mean / f64::from(points);
    let spread = (0..points).map(|k| Tooth {
        angle_rad: ((f64::from(k) + 0.5) / f64::from(points) - 0.5) * arc_rad,
        share,
    });
    let exact = stiffness(&spread.collect::<Vec<_>>());
    let error = |steps: u32| {
        let step = |k: u32| {
            cut.teeth
                .passing([k, k + 1].map(|k| f64::from(k) / f64::from(steps)))
        };
        let all = (0..steps).flat_map(step).map(|tooth| Tooth {
            share: tooth.share / f64::from(steps),
            ..tooth
        });
        (stiffness(&all.collect::<Vec<_>>()) - &exact).norm_l2() / exact.norm_l2()
    };
    let [coarse, fine] = [8, 32].map(error);
    assert!(coarse < 0.02 && fine < 0.1 * coarse, "{coarse} {fine}");
}
