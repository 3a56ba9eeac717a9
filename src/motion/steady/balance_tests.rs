//! The balance compared with chosen motions, with the describing function, and with eigenvalues of linear motions.

use faer::{c64, mat};

use std::f64::consts::{PI, TAU};

use super::super::along::Along;
use super::super::periodic::function;
use super::*;
use crate::motion::transient::Force;

/// A spring on the first coordinate beyond a gap on both sides, or on one side only.
struct Stop {
    stiffness: f64,
    gap: f64,
    is_one_sided: bool,
}

impl Stop {
    fn force(&self, q: f64) -> f64 {
        let lower = if self.is_one_sided {
            0.0
        } else {
            (-q - self.gap).max(0.0)
        };
        -self.stiffness * ((q - self.gap).max(0.0) - lower)
    }
}

impl Force for Stop {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        force[0] += self.force(displacement[0]);
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        if self.force(displacement[0]) != 0.0 {
            stiffness[(0, 0)] += self.stiffness;
        }
    }
}

/// A cubic spring on the second coordinate.
struct Cubic(f64);

impl Force for Cubic {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        force[1] -= self.0 * displacement[1].powi(3);
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        stiffness[(1, 1)] += 3.0 * self.0 * displacement[1].powi(2);
    }
}

/// Two coupled coordinates with gyroscopic and viscous terms at a speed of 3 rad/s.
fn pair() -> GyroscopicSystem {
    let mut system = GyroscopicSystem::undamped(
        mat![[90.0, -20.0], [-20.0, 160.0]],
        mat![[0.5, 0.1], [0.1, -0.3]],
        mat![[0.0, 0.7], [-0.7, 0.0]],
    );
    system.damping = Some(mat![[1.2, 0.3], [0.3, 0.9]]);
    system
}

const SPEED: f64 = 3.0;

/// A motion is chosen, and its loads are integrated over fine steps of time: under these loads the balance gives the chosen
/// mean and harmonics.
#[test]
fn a_motion_that_is_chosen_comes_back_from_its_loads() {
    let (harmonics, frequency) = (4, 7.0);
    let system = pair();
    let (stop, cubic) = (
        Stop {
            stiffness: 4000.0,
            gap: 0.3,
            is_one_sided: true,
        },
        Cubic(80.0),
    );
    let chosen = Mat::from_fn(2, 9, |i, k| {
        [0.25, 0.4, -0.2, 0.05, 0.1, 0.02, 0.0, -0.01, 0.03][k] * if i == 0 { 1.0 } else { -0.6 }
    });
    let chosen = Periodic(chosen);
    let (stiffness, velocity) = (system.stiffness_at(SPEED), system.velocity_at(SPEED));
    let count = 100_000;
    let mut load = Mat::<f64>::zeros(2, 9);
    for time in 0..count {
        let phase = TAU * time as f64 / count as f64;
        let q = chosen.at(phase);
        let (mut rate, mut inertia) = (Col::<f64>::zeros(2), Col::<f64>::zeros(2));
        for k in 1..=harmonics {
            let (sin, cos) = (k as f64 * phase).sin_cos();
            let w = k as f64 * frequency;
            for i in 0..2 {
                let [a, b] = [chosen.0[(i, 2 * k - 1)], chosen.0[(i, 2 * k)]];
                rate[i] += w * (b * cos - a * sin);
                inertia[i] -= w * w * (a * cos + b * sin);
            }
        }
        let mut force = Col::<f64>::zeros(2);
        stop.add_to(&q, &mut force);
        cubic.add_to(&q, &mut force);
        let needed = &inertia + &velocity * &rate + &stiffness * &q - force;
        for k in 0..9 {
            let norm = if k == 0 { 1.0 } else { 2.0 };
            for i in 0..2 {
                load[(i, k)] += norm / f64::from(count) * function(k, phase) * needed[i];
            }
        }
    }
    let terms = [
        Term {
            force: &cubic,
            is_cubic: true,
        },
        Term {
            force: &stop,
            is_cubic: false,
        },
    ];
    let balance = Balance::new(&system, SPEED, (frequency, harmonics), &terms, 1e-3);
    let found = balance.motion(&Col::zeros(2), &load).unwrap();
    let error = (&found.0 - &chosen.0).norm_max();
    assert!(error < 5e-4, "{error:e}");
    let first = found.harmonic(1, &Col::from_fn(2, |i| [1.0, 0.0][i]));
    assert!((first - c64::new(0.4, 0.2)).norm() < 1e-3, "{first}");
}

/// With one harmonic the amplitude A of a mass between two stops obeys A (k N(A/g) − ω²) = F, with the describing function N.
#[test]
fn one_harmonic_is_the_describing_function() {
    let (stiffness, gap, frequency) = (900.0, 0.01, 12.0);
    let stop = Stop {
        stiffness,
        gap,
        is_one_sided: false,
    };
    let none = || Mat::<f64>::zeros(1, 1);
    let system = GyroscopicSystem::undamped(none(), none(), none());
    let terms = [Term {
        force: &stop,
        is_cubic: false,
    }];
    let balance = Balance::new(&system, 0.0, (frequency, 1), &terms, 1e-3);
    for force in [3.0, 10.0, 60.0] {
        let mut load = balance.no_load();
        load[(0, 1)] = force;
        // The search starts beyond the gap, because inside it the mass moves against the force.
        let near = Periodic(mat![[0.0, 2.0 * gap, 0.0]]);
        let found = balance.refined(&near, &load).unwrap();
        let amplitude = found.harmonic(1, &Col::full(1, 1.0)).re;
        let over = gap / amplitude.abs();
        let share = 1.0 - 2.0 / PI * (over.asin() + over * (1.0 - over * over).sqrt());
        let needed = amplitude * (stiffness * share - frequency * frequency);
        assert!(
            (needed / force - 1.0).abs() < 2e-3,
            "{amplitude} {needed} {force}"
        );
    }
}

/// Without a force that depends on the motion the exponents are the eigenvalues of the system, folded by its frequency.
#[test]
fn the_growth_of_a_linear_motion_is_its_eigenvalue() {
    let system = pair();
    let expected = crate::modes::companion_eigenpairs(&system, SPEED).unwrap();
    let slowest = expected
        .iter()
        .map(|(lambda, _)| *lambda)
        .max_by(|a, b| a.re.total_cmp(&b.re))
        .unwrap();
    let frequency = 7.0;
    let balance = Balance::new(&system, SPEED, (frequency, 2), &[], 1e-3);
    let motion = balance.motion(&Col::zeros(2), &balance.no_load()).unwrap();
    let growth = Along::new(&balance, &motion).unwrap().growth().unwrap();
    assert!(
        (growth.per_s - slowest.re).abs() < 1e-3 * slowest.re.abs(),
        "{growth:?} {slowest}"
    );
    let folded = slowest.im.abs() % frequency;
    let folded = folded.min(frequency - folded);
    assert!(
        (growth.frequency_rad_per_s - folded).abs() < 1e-2,
        "{growth:?} {folded}"
    );
}

/// One coordinate with a stiffness, a viscous damping, and a force f(q) beside them.
fn single(stiffness: f64, damping: f64) -> GyroscopicSystem {
    let none = || Mat::<f64>::zeros(1, 1);
    let mut system = GyroscopicSystem::undamped(mat![[stiffness]], none(), none());
    system.damping = Some(mat![[damping]]);
    system
}

/// Displacement and velocity of q̈ + c q̇ + f(q) = F cos ωt after a period from the phase zero, by the Runge-Kutta method.
fn after_a_period(
    [mut q, mut v]: [f64; 2],
    acceleration: impl Fn(f64, f64, f64) -> f64,
    (frequency, steps): (f64, u32),
    mut seen: impl FnMut(f64, f64),
) -> [f64; 2] {
    let step = TAU / frequency / f64::from(steps);
    for k in 0..steps {
        let t = step * f64::from(k);
        seen(frequency * t, q);
        let (v1, a1) = (v, acceleration(t, q, v));
        let v2 = v + 0.5 * step * a1;
        let a2 = acceleration(t + 0.5 * step, q + 0.5 * step * v1, v2);
        let v3 = v + 0.5 * step * a2;
        let a3 = acceleration(t + 0.5 * step, q + 0.5 * step * v2, v3);
        let v4 = v + step * a3;
        let a4 = acceleration(t + step, q + step * v3, v4);
        q += step / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    [q, v]
}

/// A hardening spring on the only coordinate.
struct Hardening(f64);

impl Force for Hardening {
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
        force[0] -= self.0 * displacement[0].powi(3);
    }

    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
        stiffness[(0, 0)] += 3.0 * self.0 * displacement[0].powi(2);
    }
}

/// Independent value: time histories of q̈ + c q̇ + k q + g q³ = F cos ωt. Of its three motions, from the closed form of one harmonic,
/// that of middle amplitude is a saddle, which a history beside it leaves at the rate of growth; the others are foci, to which it
/// returns with half of the damping, because the product of both multipliers is exp(−cT) (Liouville).
#[test]
fn histories_leave_unstable_oscillations_and_return_to_stable_ones() {
    let (stiffness, damping, cubic, frequency, force) = (100.0, 0.4, 100.0, 13.0, 10.0);
    let hardening = Hardening(cubic);
    let terms = [Term {
        force: &hardening,
        is_cubic: true,
    }];
    let system = single(stiffness, damping);
    let balance = Balance::new(&system, 0.0, (frequency, 9), &terms, 1e-3);
    let mut load = balance.no_load();
    load[(0, 1)] = force;
    let acceleration = |t: f64, q: f64, v: f64| {
        force * (frequency * t).cos() - damping * v - stiffness * q - cubic * q.powi(3)
    };
    let period = TAU / frequency;
    for (amplitude, is_stable) in [(0.146_f64, true), (0.888, false), (1.015, true)] {
        let elastic = stiffness - frequency * frequency + 0.75 * cubic * amplitude * amplitude;
        let viscous = damping * frequency;
        let size = force / (elastic * elastic + viscous * viscous);
        let near = Periodic(mat![[0.0, size * elastic, size * viscous]]);
        let motion = balance.refined(&near, &load).unwrap();
        let found = motion.harmonic(1, &Col::full(1, 1.0)).norm();
        assert!(
            (found / amplitude - 1.0).abs() < 0.03,
            "{found} {amplitude}"
        );
        let growth = Along::new(&balance, &motion)
            .unwrap()
            .growth()
            .unwrap()
            .per_s;
        let velocity: f64 = (1..=9)
            .map(|k| k as f64 * frequency * motion.0[(0, 2 * k)])
            .sum();
        let begun = [motion.at(0.0)[0], velocity];
        let mut state = [begun[0] + if is_stable { 1e-3 } else { 1e-7 }, begun[1]];
        let distances: Vec<f64> = (0..60)
            .map(|_| {
                state = after_a_period(state, acceleration, (frequency, 400), |_, _| ());
                (state[0] - begun[0]).hypot((state[1] - begun[1]) / frequency)
            })
            .collect();
        if is_stable {
            assert!(
                (growth + 0.5 * damping).abs() < 1e-3,
                "{amplitude} {growth}"
            );
            assert!(
                distances[59] < 0.02 * distances[0],
                "{amplitude} {distances:?}"
            );
        } else {
            // After eight periods the decaying direction is gone, and after sixteen the distance is still small.
            let rate = (distances[15] / distances[7]).ln() / (8.0 * period);
            assert!(
                growth > 0.5 && (growth / rate - 1.0).abs() < 0.02,
                "{growth} {rate}"
            );
            assert!(distances[59] > 0.1, "{distances:?}");
        }
    }
}

/// A mode of 40 Hz about a motion of 0.8 Hz decays with half of its damping.
#[test]
fn the_decay_of_a_mode_far_above_the_motion_is_resolved() {
    let (natural, damping) = (TAU * 40.0, 3.0);
    let system = single(natural * natural, damping);
    let balance = Balance::new(&system, 0.0, (TAU * 0.8, 6), &[], 1e-3);
    let motion = balance.motion(&Col::zeros(1), &balance.no_load()).unwrap();
    let growth = Along::new(&balance, &motion).unwrap().growth().unwrap();
    assert!(
        (growth.per_s + 0.5 * damping).abs() < 0.01 * damping,
        "{growth:?}"
    );
}

/// Independent value: the harmonics of the steady state of a time history. A mass on a soft spring is pressed on a stop once in a slow
/// period and rings there; the balance of a few harmonics states the size of those that it neglects.
#[test]
fn neglected_harmonics_are_those_of_the_time_history() {
    for frequency in [1.1, 2.0] {
        compare_harmonics(frequency);
    }
}

fn compare_harmonics(frequency: f64) {
    let (stiffness, damping, force) = (100.0, 3.0, 2.0);
    let stop = Stop {
        stiffness: 400.0,
        gap: 0.01,
        is_one_sided: true,
    };
    let terms = [Term {
        force: &stop,
        is_cubic: false,
    }];
    let system = single(stiffness, damping);
    let acceleration = |t: f64, q: f64, v: f64| {
        force * (frequency * t).cos() - damping * v - stiffness * q + stop.force(q)
    };
    let steps = 8000;
    let mut state = [0.0, 0.0];
    let mut exact = vec![c64::new(0.0, 0.0); 25];
    for period in 0..4 {
        state = after_a_period(state, acceleration, (frequency, steps), |phase, q| {
            if period == 3 {
                for (k, sum) in exact.iter_mut().enumerate() {
                    let turned = c64::from_polar(1.0, -(k as f64) * phase);
                    *sum += 2.0 / f64::from(steps) * q * turned;
                }
            }
        });
    }
    let solve = |harmonics: usize| {
        let balance = Balance::new(&system, 0.0, (frequency, harmonics), &terms, 1e-3);
        let mut load = balance.no_load();
        load[(0, 1)] = force;
        let motion = balance.motion(&Col::zeros(1), &load).unwrap();
        let neglected = Along::new(&balance, &motion).unwrap().neglected();
        (motion, neglected)
    };
    let (_, neglected) = solve(6);
    let size = |k: usize| exact[k].norm();
    let expected: f64 = (7..=12).map(size).sum();
    let stated: f64 = neglected
        .iter()
        .filter(|(k, _)| *k <= 12)
        .map(|(_, q)| q[0].norm())
        .sum();
    // The stop rings with the twentieth harmonic of the slower motion, and with one of those neglected of the faster, which their
    // linear response overestimates.
    let most = if frequency < 1.5 { 1.2 } else { 2.5 };
    assert!(
        (0.8..most).contains(&(stated / expected)),
        "{stated:e} {expected:e}"
    );
    assert!(neglected.last().unwrap().0 >= 12);
    let (fine, rest) = solve(20);
    let tolerance = if frequency < 1.5 { 5e-3 } else { 1e-3 };
    for (k, exact) in exact.iter().enumerate().take(21).skip(1) {
        let own = fine.harmonic(k, &Col::full(1, 1.0));
        assert!(
            (own - exact).norm() < tolerance * size(1),
            "{k}: {own} {exact}"
        );
    }
    assert!(rest.iter().map(|(_, q)| q[0].norm()).sum::<f64>() < 0.2 * stated);
}
