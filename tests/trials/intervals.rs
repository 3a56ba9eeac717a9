//! Goal: the intervals of `fit` contain the truth as often as they state.

use std::f64::consts::TAU;

use rayon::prelude::*;
use sawflutter::analyses::fit::{FitReport, Measurement, Options, fit};

use crate::common::scene;
use crate::measurements::{SMALL, SPEEDS, exact, measured};
use crate::numbers::{freed, with};
use crate::trial::{Trial, mine};

const RADIUS: &str = "guides[0].radius_m";
const STIFFNESS: &str = "guides[0].stiffness_n_per_m";

/// Normal deviates from a linear congruential generator and the formula of Box and Muller.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

const DRAWS: usize = 100;

#[test]
#[ignore = "a hundred fits"]
fn intervals_cover_the_truth_as_often_as_they_say() {
    let mut trial = Trial::new("intervals of fit");
    for what in mine(["the paper's saw"]) {
        trial.saw(what, || {
            // The tolerance is three standard deviations of such a count.
            let allowed = 3.0 * (DRAWS as f64 * 0.9 * 0.1).sqrt();
            let is_off = |count: usize| (count as f64 - 0.9 * DRAWS as f64).abs() > allowed;
            let covered = covered();
            if covered.into_iter().any(is_off) {
                vec![format!(
                    "{covered:?} of {DRAWS} cover the truth, expected 90 %"
                )]
            } else {
                Vec::new()
            }
        });
    }
    trial.end();
}

/// The number of measurements among 100 with noise of 0.1 Hz whose 90 % interval contains the true radius and the true
/// stiffness.
fn covered() -> [usize; 2] {
    let saw = scene("paper");
    let truth = with(&saw, &[(RADIUS, 0.21), (STIFFNESS, 8e6)]);
    let exact = exact(&truth, &SPEEDS, 5);
    let free = freed(&saw, &[(RADIUS, 0.15, 0.3), (STIFFNESS, 1e6, 1e8)]);
    let options = Options {
        confidence: 0.9,
        starts: 1,
        resolution: Some(SMALL),
        ..Options::default()
    };
    let mut noise = Noise(20_241_122);
    let drawn: Vec<Measurement> = (0..DRAWS)
        .map(|_| measured(&exact, || 0.1 * noise.normal()))
        .collect();
    let fits: Vec<FitReport> = drawn
        .par_iter()
        .map(|drawn| fit(&saw, drawn, &free, &options, &|_, _| ()).unwrap())
        .collect();
    [(0, 0.21), (1, 8e6)].map(|(k, truth)| {
        let covers = |fit: &&FitReport| {
            let found = &fit.parameters[k];
            found.interval_from.unwrap() <= truth && truth <= found.interval_to.unwrap()
        };
        fits.iter().filter(covers).count()
    })
}
