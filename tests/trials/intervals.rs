//! Goal: the intervals of `fit` contain the truth as often as they state.

use rayon::prelude::*;
use sawflutter::analyses::fit::{FitReport, FittedParameter, Measurement, Options, fit};

use crate::common::scene;
use crate::measurements::{Noise, SMALL, SPEEDS, exact, measured};
use crate::numbers::{freed, with};
use crate::trial::{Trial, mine};

const RADIUS: &str = "guides[0].radius_m";
const STIFFNESS: &str = "guides[0].stiffness_n_per_m";
const SECOND_STIFFNESS: &str = "guides[1].stiffness_n_per_m";

const DRAWS: usize = 100;

/// A saw whose numbers are fitted to drawn measurements.
struct Drawn {
    name: &'static str,
    scene: &'static str,
    /// Path, true value, lowest and highest allowed.
    numbers: Vec<(&'static str, f64, f64, f64)>,
    confidence: f64,
    starts: usize,
    /// Standard deviations of the noise: in Hz, and as a share of the frequency.
    noise_hz: f64,
    noise_share: f64,
}

/// With equal pads of unequal stiffness the saw with exchanged stiffnesses has the same frequencies.
fn drawn_saws() -> [Drawn; 2] {
    [
        Drawn {
            name: "the paper's saw",
            scene: "paper",
            numbers: vec![(RADIUS, 0.21, 0.15, 0.3), (STIFFNESS, 8e6, 1e6, 1e8)],
            confidence: 0.9,
            starts: 1,
            noise_hz: 0.1,
            noise_share: 0.0,
        },
        Drawn {
            name: "two pads that may be exchanged",
            scene: "two-pads",
            numbers: vec![
                (STIFFNESS, 2e6, 1e5, 1e8),
                (SECOND_STIFFNESS, 2e7, 1e5, 1e8),
                ("guides[1].angle_deg", 60.0, 0.0, 120.0),
            ],
            confidence: 0.95,
            starts: 1,
            noise_hz: 0.0,
            noise_share: 0.005,
        },
    ]
}

#[test]
#[ignore = "a hundred fits of each saw"]
fn intervals_cover_the_truth_as_often_as_they_say() {
    let mut trial = Trial::new("intervals of fit");
    for drawn in mine(drawn_saws()) {
        trial.saw(drawn.name, || {
            let expected = drawn.confidence * DRAWS as f64;
            // The tolerance is three standard deviations of such a count.
            let allowed = 3.0 * (expected * (1.0 - drawn.confidence)).sqrt();
            let covered = covered(&drawn);
            let is_off = |count: &usize| (*count as f64 - expected).abs() > allowed;
            let wrong = covered.iter().any(is_off);
            let said = format!("{covered:?} of {DRAWS} cover the truth, expected {expected}");
            wrong.then_some(said).into_iter().collect()
        });
    }
    trial.end();
}

/// The number of measurements among 100 of which the interval of the best saw, or of another one that fits about as well,
/// contains the true value, for each number.
fn covered(drawn: &Drawn) -> Vec<usize> {
    let saw = scene(drawn.scene);
    let values: Vec<_> = drawn.numbers.iter().map(|n| (n.0, n.1)).collect();
    let bounds: Vec<_> = drawn.numbers.iter().map(|n| (n.0, n.2, n.3)).collect();
    let exact = exact(&with(&saw, &values), &SPEEDS, 5);
    let free = freed(&saw, &bounds);
    let options = Options {
        confidence: drawn.confidence,
        starts: drawn.starts,
        resolution: Some(SMALL),
        ..Options::default()
    };
    let mut noise = Noise(20_241_122);
    let mut read = |hz: f64| hz + (drawn.noise_hz + drawn.noise_share * hz) * noise.normal();
    let measurements: Vec<Measurement> = (0..DRAWS).map(|_| measured(&exact, &mut read)).collect();
    let fits: Vec<FitReport> = measurements
        .par_iter()
        .map(|drawn| fit(&saw, drawn, &free, &options, &|_, _| ()).unwrap())
        .collect();
    let covers = |found: &FittedParameter, truth: f64| {
        let ends = found.interval_from.zip(found.interval_to);
        ends.is_some_and(|(from, to)| (from..=to).contains(&truth))
    };
    let of_number = |k: usize| {
        let truth = values[k].1;
        let is_covered = |fit: &&FitReport| {
            let others = fit.other_minima.iter().map(|other| &other.parameters[k]);
            std::iter::once(&fit.parameters[k])
                .chain(others)
                .any(|found| covers(found, truth))
        };
        fits.iter().filter(is_covered).count()
    };
    (0..values.len()).map(of_number).collect()
}
