//! Trial of the tuned constants: effects of half and of double their values.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::{Analysis, AnalysisError, Instability};
use crate::model::scene::{Accuracy, Scene, rpm};
use crate::model::tuning::trial;

/// Compared results for a saw.
struct Answer {
    critical_rpm: Vec<f64>,
    bands: Vec<Instability>,
    /// Estimated error of critical speeds.
    estimate: f64,
    mismatches: usize,
    /// Numbers of eigenproblems on the full model, on projections and on states, and of refined pairs.
    work: [usize; 4],
}

impl Answer {
    fn new(scene: &Scene) -> Result<Self, AnalysisError> {
        let analysis = Analysis::new(scene)?;
        let counters = &analysis.model.counters;
        let count = |counter: &AtomicUsize| counter.load(Ordering::Relaxed);
        let critical = analysis.model.critical.iter().map(|c| c.speed_rad_per_s);
        let within = critical.take_while(|speed| *speed <= analysis.range_rad_per_s.to_rad_per_s);
        Ok(Answer {
            critical_rpm: within.map(rpm).collect(),
            bands: analysis.bands().to_vec(),
            estimate: analysis.estimated_relative_error.unwrap_or(f64::NAN),
            mismatches: analysis.chart.certificate.mismatches.len(),
            work: [
                count(&counters.full_solves),
                count(&counters.reduced_solves),
                count(&counters.local_solves),
                count(&counters.refined_pairs),
            ],
        })
    }

    /// Largest relative differences of critical speeds, edges and peaks from another result; infinite if
    /// their numbers differ.
    fn differences(&self, other: &Answer) -> [f64; 3] {
        let largest = |pairs: Vec<(f64, f64)>| {
            let off = pairs.iter().map(|(x, y)| (x - y).abs() / y.abs());
            off.filter(|off| off.is_finite()).fold(0.0, f64::max)
        };
        if self.bands.len() != other.bands.len()
            || self.critical_rpm.len() != other.critical_rpm.len()
        {
            return [f64::INFINITY; 3];
        }
        let critical = self.critical_rpm.iter().zip(&other.critical_rpm);
        let bands = || self.bands.iter().zip(&other.bands);
        let edges = bands().flat_map(|(x, y)| {
            [
                (x.from_rad_per_s, y.from_rad_per_s),
                (x.to_rad_per_s, y.to_rad_per_s),
            ]
        });
        let peaks = bands().map(|(x, y)| (x.peak_growth_per_s, y.peak_growth_per_s));
        [
            largest(critical.map(|(x, y)| (*x, *y)).collect()),
            largest(edges.collect()),
            largest(peaks.collect()),
        ]
    }
}

/// Saws with one pad, with two, damped, heated, with a loose collar, and free.
fn saws() -> Vec<Scene> {
    let root = env!("CARGO_MANIFEST_DIR");
    [
        "paper",
        "two-pads",
        "gallery/damped-pad",
        "gallery/heated-rim",
        "gallery/loose-collar",
        "free-blade",
    ]
    .iter()
    .map(|name| Scene::from_path(format!("{root}/scenes/{name}.json")).unwrap())
    .map(|scene| {
        scene
            .edited(|scene| scene.accuracy = Accuracy::Draft)
            .unwrap()
    })
    .collect()
}

/// Prints a row for each constant and factor: the largest relative changes of the results over all saws, and the
/// total work. A constant is accurate enough if only the last digits of results change, and well chosen if half
/// or double its value takes longer or changes the results.
#[test]
#[ignore = "takes minutes: run it when a constant is changed"]
fn constants() {
    trial::switch(true);
    let saws = saws();
    let reference: Vec<Answer> = saws.iter().map(|s| Answer::new(s).unwrap()).collect();
    println!(
        "{:<48} {:>6}  {:>8} {:>8} {:>8} {:>8}  {:>5}  whole/free/waves/newton",
        "constant", "times", "critical", "edges", "peaks", "estimate", "wrong"
    );
    let total = |answers: &[Answer]| {
        let sum = |k: usize| answers.iter().map(|a| a.work[k]).sum::<usize>();
        [0, 1, 2, 3].map(sum)
    };
    println!("{:<48} {:>6}  {:?}", "as it is", 1, total(&reference));
    for name in trial::used() {
        for factor in [0.5, 2.0] {
            let answers: Result<Vec<Answer>, AnalysisError> =
                trial::with_factor(name, factor, || saws.iter().map(Answer::new).collect());
            let Ok(answers) = answers else {
                println!("{name:<48} {factor:>6}  refused");
                continue;
            };
            let mut worst = [0.0_f64; 4];
            for (answer, own) in answers.iter().zip(&reference) {
                let [critical, edges, peaks] = answer.differences(own);
                let estimate = (answer.estimate / own.estimate - 1.0).abs();
                for (worst, new) in worst.iter_mut().zip([critical, edges, peaks, estimate]) {
                    *worst = worst.max(new);
                }
            }
            let wrong: usize = answers.iter().map(|a| a.mismatches).sum();
            println!(
                "{name:<48} {factor:>6}  {:>8.1e} {:>8.1e} {:>8.1e} {:>8.1e}  {wrong:>5}  {:?}",
                worst[0],
                worst[1],
                worst[2],
                worst[3],
                total(&answers)
            );
        }
    }
    trial::switch(false);
}
