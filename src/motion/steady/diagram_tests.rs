//! Oscillations over the speed, compared with time histories and with dense linear solutions.

use std::f64::consts::TAU;

use faer::linalg::solvers::Solve;
use faer::{Col, c64};

use super::{Found, OscillatingBlade, Oscillators, loads};
use crate::model::plate::Plate;
use crate::model::scene::{ContactLaw, Scene, rad_per_s};
use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
use crate::motion::history::{History, Moving, SMALL, at_cut, norm, product, saws, with_pads};

const SPEEDS_RPM: [f64; 12] = [
    150.0, 250.0, 350.0, 450.0, 550.0, 650.0, 750.0, 850.0, 950.0, 1050.0, 1150.0, 1250.0,
];

/// The blade of a scene with all functions of its basis.
fn oscillating(scene: &Scene) -> OscillatingBlade {
    let plate = Plate::new(scene, SMALL);
    let oscillators = Oscillators::of(scene).unwrap();
    let loads = loads(&plate, scene, 0.0).unwrap();
    let order = plate.degrees_of_freedom();
    let asked = (rad_per_s(700.0), rad_per_s(1400.0));
    OscillatingBlade::new(&plate, scene, (&oscillators, loads), asked, order).unwrap()
}

/// State of a motion at the phase zero.
fn begun(blade: &OscillatingBlade, found: &Found, frequency: f64) -> Moving {
    let whole = |p: Col<f64>| -> Vec<f64> { (blade.blade.shapes() * p).iter().copied().collect() };
    let step = 1e-4;
    let [before, after] = [-step, step].map(|phase| whole(found.motion.at(phase)));
    let rate = before.iter().zip(&after);
    Moving {
        q: whole(found.motion.at(0.0)),
        v: rate
            .map(|(before, after)| frequency * (after - before) / (2.0 * step))
            .collect(),
    }
}

/// Distance of two states.
fn apart(a: &Moving, b: &Moving, speed: f64) -> f64 {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
    norm(&of(&a.v, &b.v)) + speed * norm(&of(&a.q, &b.q))
}

/// Independent values: a history that begins on the motion, and the rate at which another beside it leaves or approaches it. A pad touches the
/// blade only near its edges, which the histories resolve to half a percent of a deflection. Returns the number of stable motions.
fn compare((name, scene): &(&str, Scene), speeds_rpm: &[f64]) -> usize {
    let blade = oscillating(scene);
    let cut = at_cut(scene);
    let mut compared = 0;
    for (k, &rpm) in speeds_rpm.iter().enumerate() {
        let speed = rad_per_s(rpm);
        let Some(found) = blade.at(speed).unwrap().0 else {
            continue;
        };
        let growth = found.growth.unwrap().per_s;
        let history = History::new(scene, speed, None, false);
        let period_s = TAU / speed;
        let steps = (period_s / history.step_s).ceil() as usize;
        let run = |state: &mut Moving, seen: &mut dyn FnMut(f64, &[f64])| {
            history.run(state, (0.0, period_s / steps as f64, steps), seen);
        };
        let periods = ((3.0 / growth.abs()).clamp(0.6, 2.5) / period_s).ceil() as usize;
        let mut state = begun(&blade, &found, speed);
        let mut beside = state.clone();
        for (k, v) in beside.v.iter_mut().enumerate() {
            *v += 1e-7 * (1.0 + k as f64).sin();
        }
        let is_compared = k % 3 == 1 || speeds_rpm.len() == 1;
        let (mut mean, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        let mut middle = 0.0;
        for period in 0..periods {
            if period == periods / 3 {
                middle = apart(&state, &beside, speed);
            }
            if is_compared {
                run(&mut beside, &mut |_, _| ());
            }
            let is_last = period + 1 == periods;
            run(&mut state, &mut |_, q| {
                if is_last {
                    let w = product(&cut, q);
                    mean += w / steps as f64;
                    (low, high) = (low.min(w), high.max(w));
                }
            });
        }
        let own = 0.5 * (high - low);
        let stated = (
            found.motion.mean(&blade.cut),
            found.motion.amplitude(&blade.cut),
        );
        let rate = is_compared.then(|| {
            let over_s = (periods - periods / 3) as f64 * period_s;
            (apart(&state, &beside, speed) / middle).ln() / over_s
        });
        if let Some(rate) = rate {
            // Faster motions have not yet decayed.
            let within = 0.25 * growth.abs() + 0.5;
            assert!(
                (rate - growth).abs() < within,
                "{name}, {rpm} rpm: {rate} {growth}"
            );
        }
        if growth < 0.0 {
            compared += 1;
            assert!(
                (stated.0 - mean).abs() < 5e-3 * mean.abs(),
                "{name}, {rpm} rpm: {mean:e} {stated:?}"
            );
            assert!(
                (stated.1 / own - 1.0).abs() < 0.02,
                "{name}, {rpm} rpm: {own:e} {stated:?}"
            );
        }
    }
    compared
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn oscillations_on_one_pad_are_those_of_time_histories() {
    let compared = compare(&saws(5e-6, 0.6, 0.4)[0], &SPEEDS_RPM);
    assert_eq!(compared, SPEEDS_RPM.len());
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn oscillations_between_two_unlike_gaps_are_those_of_time_histories() {
    let compared = compare(&saws(5e-6, 0.6, 0.4)[1], &SPEEDS_RPM);
    assert_eq!(compared, SPEEDS_RPM.len());
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn oscillations_of_a_collared_blade_are_those_of_time_histories() {
    let compared = compare(&saws(5e-6, 0.6, 0.4)[2], &SPEEDS_RPM);
    assert_eq!(compared, SPEEDS_RPM.len());
}

/// A pad that the blade hardly reaches touches with an edge.
#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn oscillations_that_hardly_reach_a_pad_are_those_of_time_histories() {
    let compared = compare(&saws(2e-5, 0.3, 0.2)[0], &[450.0, 1050.0]);
    assert_eq!(compared, 2);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn a_history_leaves_an_unstable_oscillation_between_wider_gaps() {
    let [_, wide, _] = saws(2e-5, 0.3, 0.2);
    assert_eq!(compare(&wide, &[1150.0]), 0);
    let blade = oscillating(&wide.1);
    let found = blade.at(rad_per_s(1150.0)).unwrap().0.unwrap();
    assert!(found.growth.unwrap().per_s > 2.0);
}

/// Independent value: φᵀ L(iΩ; Ω)⁻¹ f on all functions, with linear pads where the gap is nothing, and without pads where the blade does not
/// reach them.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_gap_and_within_it_oscillations_are_linear_at_every_speed() {
    let small = saws(2e-5, 1e-2, 1e-2);
    let mut cases: Vec<(Scene, Scene)> = small
        .iter()
        .map(|(_, scene)| {
            let closed = with_pads(scene, |pad| pad.gap_m = Some(1e-12));
            let linear = with_pads(scene, |pad| {
                (pad.contact, pad.gap_m) = (ContactLaw::Linear, None);
            });
            (closed, linear)
        })
        .collect();
    let collar = &small[2].1;
    let bare = collar.edited(|file| file.guides.clear()).unwrap();
    cases.push((collar.clone(), bare));
    for (place, (scene, linear)) in cases.iter().enumerate() {
        let blade = oscillating(scene);
        let plate = Plate::new(linear, SMALL);
        let system = GyroscopicSystem::of_plate(&plate);
        let force = scene.side_force().at.polar();
        let at_force = plate.functions_at(force.radius_m, force.angle_rad);
        let amplitude_n = scene.oscillating_force().unwrap().amplitude_n;
        let load = Col::from_fn(at_force.len(), |i| c64::new(amplitude_n * at_force[i], 0.0));
        let cut = at_cut(scene);
        for rpm in SPEEDS_RPM {
            let speed = rad_per_s(rpm);
            let dynamic = dynamic_stiffness(
                &system.stiffness_at(speed),
                &system.velocity_at(speed),
                c64::new(0.0, speed),
            );
            let q = dynamic.partial_piv_lu().solve(&load);
            let expected: c64 = cut.iter().enumerate().map(|(i, x)| q[i] * x).sum();
            let found = blade.at(speed).unwrap().0.unwrap();
            let own = found.motion.harmonic(1, &blade.cut);
            assert!(
                (own - expected).norm() < 1e-3 * expected.norm(),
                "{place}, {rpm} rpm: {own} {expected}"
            );
        }
    }
}
