//! The delayed force on few modes, compared with lobe theory for one mode, with its own equation, and with limiting cases.

use std::f64::consts::TAU;

use faer::{Mat, c64};
use nalgebra::DMatrix;

use super::count::LoopGains;
use super::delayed_saw::DelayedSaw;
use super::modes::Pattern;
use super::roots::{right_of_axis, roots_with_all_growing};
use crate::model::analytical::regenerative::OneMode;
use crate::model::scene::{TeethInCut, Washboarding, WashboardingFile};
use crate::model::system::GyroscopicSystem;
use crate::modes::companion_eigenpairs;

const MODE: OneMode = OneMode {
    frequency_rad_per_s: 300.0,
    damping_ratio: 0.02,
};
const CEILING: f64 = 1e7;

fn system(frequencies: &[f64], damping_ratio: f64) -> GyroscopicSystem {
    let order = frequencies.len();
    let zero = || Mat::<f64>::zeros(order, order);
    let diagonal = |of: &dyn Fn(f64) -> f64| {
        Mat::from_fn(
            order,
            order,
            |i, k| if i == k { of(frequencies[i]) } else { 0.0 },
        )
    };
    GyroscopicSystem {
        stiffness: diagonal(&|omega| omega * omega),
        spin: zero(),
        gyroscopic: zero(),
        damping: Some(diagonal(&|omega| 2.0 * damping_ratio * omega)),
        circulatory: None,
        nonconservative: None,
        free_rigid: Vec::new(),
        drift: None,
    }
}

/// A delayed force whose pitches in rad are the delays in s at a speed of 1 rad/s.
fn cutting(stiffness: f64, overlap: f64, delays_s: &[f64]) -> Washboarding {
    Washboarding {
        typed: WashboardingFile {
            stiffness_n_per_m: stiffness,
            overlap,
            arc_deg: None,
            pitches_deg: Vec::new(),
        },
        teeth: TeethInCut {
            angle_deg: 0.0,
            mean: 1.0,
            all: 1,
        },
        pitches_rad: delays_s.to_vec(),
    }
}

fn saw(frequencies: &[f64], overlap: f64, delays_s: &[f64]) -> DelayedSaw {
    let columns = Mat::from_fn(frequencies.len(), 1, |i, _| 1.0 - 0.2 * i as f64);
    let washboarding = cutting(1.0, overlap, delays_s);
    let system = system(frequencies, MODE.damping_ratio);
    let flexibility = DMatrix::zeros(1, 1);
    DelayedSaw::new(&system, &columns, flexibility, &washboarding, 1.0).unwrap()
}

/// The lowest of all lobes at a delay, by bisection of the closed form of each lobe.
fn exact_boundary(delay_s: f64) -> [f64; 2] {
    let mut best = [f64::INFINITY, 0.0];
    for lobe in 0..12 {
        let late = |omega: f64| MODE.lobe(omega, lobe).map_or(0.0, |p| p.delay_s - delay_s);
        let omegas: Vec<f64> = (1..200_000).map(|k| 300.0 + 0.03 * f64::from(k)).collect();
        for pair in omegas.windows(2) {
            let (mut low, mut high) = (pair[0], pair[1]);
            if late(low) * late(high) > 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if late(low) * late(middle) > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
            }
            let stiffness = MODE.lobe(low, lobe).unwrap().stiffness;
            if stiffness < best[0] {
                best = [stiffness, low];
            }
        }
    }
    best
}

#[test]
fn the_boundary_of_one_mode_is_that_of_lobe_theory() {
    for turns in [0.62, 0.75, 0.97, 1.3, 1.71, 2.02, 3.6] {
        let delay = turns * TAU / MODE.frequency_rad_per_s;
        let saw = saw(&[300.0], 1.0, &[delay]);
        let gains = LoopGains::new(&saw, CEILING).unwrap();
        let found = gains.boundary().unwrap();
        let [stiffness, omega] = exact_boundary(delay);
        let error = (found.stiffness_n_per_m / stiffness - 1.0).abs();
        assert!(error < 1e-9, "{turns}: {found:?} {stiffness}");
        assert!(
            (found.frequency_rad_per_s / omega - 1.0).abs() < 1e-9,
            "{turns}"
        );
        assert!(found.stiffness_n_per_m >= MODE.least_stiffness());
        assert!(gains.confirms(Some(found)));
        assert_eq!(gains.growing(0.999 * stiffness), Some(0));
        assert_eq!(gains.growing(1.001 * stiffness), Some(2));
    }
}

/// With several modes and one delay or two, beyond several boundaries, Newton's method finds every growing
/// eigenvalue that is counted, and each satisfies the equation.
#[test]
fn what_is_counted_is_found() {
    let modes = [300.0, 310.0, 700.0, 1100.0];
    let mut growing = 0;
    for delays in [&[0.018][..], &[0.0105], &[0.016, 0.021]] {
        let saw = saw(&modes, 0.9, delays);
        let gains = LoopGains::new(&saw, CEILING).unwrap();
        for stiffness in [1e2, 3e3, 1e4, 1e5, 4e5] {
            let count = gains.growing(stiffness);
            let found = roots_with_all_growing(&saw, stiffness, count);
            for root in &found {
                let gain = saw.gain(root.lambda)[(0, 0)];
                let left = (c64::new(1.0, 0.0) + gain * stiffness).norm();
                assert!(left < 1e-6, "{stiffness} {}: {left}", root.lambda);
            }
            let listed = right_of_axis(&found);
            assert_eq!(count, Some(listed), "{delays:?} {stiffness}");
            growing += listed;
        }
    }
    assert!(growing > 20, "{growing}");
}

/// A small cutting stiffness moves the eigenvalues in proportion to it.
#[test]
fn without_stiffness_nothing_is_moved() {
    let saw = saw(&[300.0, 700.0], 1.0, &[0.018]);
    let moved = |stiffness: f64| {
        let found = roots_with_all_growing(&saw, stiffness, None);
        let moves: Vec<c64> = found
            .iter()
            .map(|r| r.lambda - r.without.unwrap())
            .collect();
        moves
    };
    let (small, smaller) = (moved(1e-1), moved(1e-2));
    assert_eq!(small.len(), 2);
    for (x, y) in small.iter().zip(&smaller) {
        assert!(y.norm() < 1e-4 && y.norm() > 0.0);
        assert!((x / y - 10.0).norm() < 1e-2, "{x} {y}");
    }
}

/// Without overlap the force is that of a spring, so that the modes are the eigenvectors of a matrix.
#[test]
fn without_overlap_it_is_a_spring() {
    let modes = [300.0, 310.0, 700.0];
    let saw = saw(&modes, 0.0, &[0.018]);
    let stiffness = 4e4;
    let mut sprung = system(&modes, MODE.damping_ratio);
    for i in 0..3 {
        for k in 0..3 {
            sprung.stiffness[(i, k)] += stiffness * (1.0 - 0.2 * i as f64) * (1.0 - 0.2 * k as f64);
        }
    }
    let exact = companion_eigenpairs(&sprung, 1.0).unwrap();
    let found = roots_with_all_growing(&saw, stiffness, None);
    assert_eq!(found.len(), exact.len());
    for (lambda, _) in &exact {
        let nearest = found
            .iter()
            .map(|root| (root.lambda - lambda).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9 * lambda.norm(), "{lambda}: {nearest}");
    }
    let gains = LoopGains::new(&saw, CEILING).unwrap();
    assert_eq!((gains.boundary(), gains.growing(CEILING)), (None, Some(0)));
}

/// The surface left by successive teeth is a wave of the reported pitch.
#[test]
fn the_pattern_is_what_the_teeth_leave() {
    let (passing, feed) = (TAU * 1500.0, 0.8);
    for hz in [1380.0, 1495.0, 1504.0, 2990.0, 40.0] {
        let pattern = Pattern::new(TAU * hz, passing, Some(feed));
        let pitch = pattern.pitch_m.unwrap();
        for tooth in 0..200 {
            let time = f64::from(tooth) / 1500.0;
            let left = (TAU * hz * time).cos();
            let wave = (TAU * feed * time / pitch).cos();
            assert!((left - wave).abs() < 1e-9, "{hz}: {left} {wave}");
        }
    }
    assert_eq!(
        Pattern::new(2.0 * passing, passing, Some(feed)).pitch_m,
        None
    );
    assert_eq!(Pattern::new(passing, passing, None).multiple, 1);
}
