//! Tooth loads that move with the teeth: Floquet multipliers compared with another integrator.

use crate::plate::{Plate, Resolution};
use crate::scene::{Cut, CutRun, Scene};
use crate::system::GyroscopicSystem;
use crate::transient::saw_in_cut::SawInCut;
use crate::transient::teeth::tooth_passing;
use faer::{Mat, Scale};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};

/// The paper's saw with few teeth, of which one is in the cut at a time.
fn saw_with_teeth(teeth: u32, tangential_n: f64) -> Scene {
    let mut file = Scene::paper().file().clone();
    file.blade.teeth = Some(teeth);
    let cut = file.cut.as_mut().unwrap();
    cut.depth_m = None;
    cut.teeth_in_cut = Some(1);
    cut.tangential_n_per_tooth = Some(tangential_n);
    cut.power_w = None;
    cut.speeds.clear();
    Scene::try_from(file).unwrap()
}

/// max ln|μ| / T by the classical Runge–Kutta method, with K_e of the loads at each of `stages` positions.
fn by_runge_kutta(plate: &Plate, cut: &Cut, run: &CutRun, stages: usize, steps: usize) -> f64 {
    let speed = run.speed_rad_per_s;
    let period_s = cut.pitch_rad / speed;
    let step_s = period_s / (stages * steps) as f64;
    let order = plate.degrees_of_freedom();
    let mut q = Mat::from_fn(order, 2 * order, |i, k| f64::from(u8::from(i == k)));
    let mut v = Mat::from_fn(order, 2 * order, |i, k| f64::from(u8::from(i + order == k)));
    for stage in 0..stages {
        let turn = ((stage as f64 + 0.5) / stages as f64 - 0.5) * cut.pitch_rad;
        let mut turned = cut.clone();
        turned.angle_rad += turn;
        let system = GyroscopicSystem::of_plate(&plate.in_cut(&turned, run));
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
    let scene = saw_with_teeth(4, 4000.0);
    let plate = Plate::new(&scene, SMALL);
    let cut = scene.cut().unwrap();
    for rpm in [300.0, 600.0, 1200.0, 3000.0] {
        let run = cut.at_rpm(rpm).unwrap();
        let saw = SawInCut::new(&plate, cut, &run).unwrap();
        let found = tooth_passing(&saw, scene.probe(), 32).unwrap();
        let others = [found.standing_growth_per_s, found.mean_growth_per_s];
        assert_eq!(others, [0.0; 2], "{rpm}");
        let growth = found.passing_growth_per_s;
        let exact = by_runge_kutta(&plate, cut, &run, 32, 16);
        assert!(
            (growth / exact - 1.0).abs() < 1e-3,
            "{rpm}: {growth} {exact}"
        );
        assert!(growth > 0.25, "{rpm}: {growth}");
    }
}
