//! The balance compared with chosen motions, with the describing function, and with eigenvalues of linear motions.

use faer::mat;

use super::*;
use crate::analyses::gap::equivalent_share;

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
            is_smooth: true,
        },
        Term {
            force: &stop,
            is_smooth: false,
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
        is_smooth: false,
    }];
    let balance = Balance::new(&system, 0.0, (frequency, 1), &terms, 1e-3);
    for force in [3.0, 10.0, 60.0] {
        let mut load = balance.no_load();
        load[(0, 1)] = force;
        // The search starts beyond the gap, because inside it the mass moves against the force.
        let near = Periodic(mat![[0.0, 2.0 * gap, 0.0]]);
        let found = balance.refined(&near, &load).unwrap();
        let amplitude = found.harmonic(1, &Col::full(1, 1.0)).re;
        let share = equivalent_share(amplitude.abs() / gap);
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
    let growth = balance.growth(&motion).unwrap();
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
