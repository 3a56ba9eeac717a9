//! The sum of a study: `study.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::distribution::Distribution;
use super::file::StudyFile;
use super::plan::Study;
use super::saw::{Found, Outcome, Saw};
use super::statistics::{interval, quantile};
use crate::scene::{SceneFile, rpm};

/// Saws that were not analysed, of which the reasons are listed; the table has them all.
const LISTED: usize = 20;
/// Most bars of a histogram that can be told apart.
const MOST_BARS: usize = 40;

/// Quantiles and probabilities of a study, and what it was asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyReport {
    /// Version of the program.
    pub sawflutter: String,
    /// The saw without deviations.
    pub scene: SceneFile,
    /// The study.
    pub study: StudyFile,
    /// Last speed looked at.
    pub swept_to_rpm: f64,
    /// Largest estimated relative error of the critical speeds of any saw.
    pub largest_estimated_relative_error: f64,
    /// Saws with a speed at which the Krein index did not match; expected 0.
    pub saws_with_krein_violations: usize,
    /// All saws together.
    pub all: Group,
    /// The saws drawn in each point of the grid, where there are both.
    pub groups: Vec<Group>,
    /// The first saws that were not analysed.
    pub not_analysed: Vec<Refusal>,
}

/// Saws that belong together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Where in the grid; empty for all saws.
    pub grid: Vec<GridEntry>,
    /// Number of saws.
    pub saws: usize,
    /// Of these, saws with numbers that no saw can have.
    pub refused: usize,
    /// Of these, saws that could not be analysed.
    pub failed: usize,
    /// Lowest critical speed of those analysed.
    pub lowest_critical: SpeedEntry,
    /// Flutter speed of those analysed.
    pub flutter: SpeedEntry,
    /// How many keep the limits, where the study has any.
    pub passing: Option<Passing>,
}

/// A number of a point of the grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridEntry {
    /// JSON path in the scene.
    pub parameter: String,
    /// Its value.
    pub value: f64,
}

/// How a speed is distributed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedEntry {
    /// Saws with such a speed.
    pub saws: usize,
    /// Saws without one: it lies beyond the speeds of the study, if anywhere.
    pub beyond: usize,
    /// Half of the saws lie below; null where it lies beyond the speeds of the study.
    pub median_rpm: Option<f64>,
    /// Speeds below which given shares of the saws lie.
    pub quantiles: Vec<Quantile>,
    /// Counts; none without saws.
    pub histogram: Option<Histogram>,
}

/// A speed below which a share of the saws lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Quantile {
    /// The share.
    pub share: f64,
    /// The speed; null where it lies beyond the speeds of the study.
    pub rpm: Option<f64>,
}

/// Counts of saws in bars of equal width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Histogram {
    /// Least speed.
    pub from_rpm: f64,
    /// Greatest speed.
    pub to_rpm: f64,
    /// Saws in each bar.
    pub counts: Vec<usize>,
}

/// How many saws keep all limits. A saw that was refused or failed keeps none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Passing {
    /// Saws that keep every limit.
    pub passed: usize,
    /// Their share of all.
    pub probability: f64,
    /// Confidence of the interval.
    pub confidence: f64,
    /// Interval of the probability (Clopper and Pearson's, for as many independent saws;
    /// scrambled Sobol points are spread more evenly than these). Null for a grid, of which the
    /// share is exact, and for all of several groups, which share their deviations.
    pub interval: Option<[f64; 2]>,
    /// Saws that keep each limit.
    pub criteria: Vec<CriterionEntry>,
}

/// How many saws keep one limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriterionEntry {
    /// In a word, as in the columns of the table.
    pub key: String,
    /// What is compared, in words.
    pub name: String,
    /// The speed asked for.
    pub asked_rpm: f64,
    /// Saws that keep it.
    pub passed: usize,
}

/// A saw that was not analysed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Refusal {
    /// Its number.
    pub saw: usize,
    /// Why.
    pub reason: String,
}

impl StudyReport {
    /// Sums up the saws of a study, in the order of their numbers.
    pub fn new(study: &Study, saws: &[Saw]) -> Self {
        let found = || saws.iter().filter_map(Saw::found);
        let is_mixed = study.drawn() > 1 && study.drawn() < study.count();
        let groups = saws.chunks(study.drawn()).filter(|_| is_mixed);
        let refusals = saws.iter().filter_map(|saw| match &saw.outcome {
            Outcome::Analysed(_) => None,
            Outcome::Refused(reason) | Outcome::Failed(reason) => Some(Refusal {
                saw: saw.index,
                reason: reason.clone(),
            }),
        });
        StudyReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: study.scene().file().clone(),
            study: study.file().clone(),
            swept_to_rpm: rpm(study.to_rad_per_s()),
            largest_estimated_relative_error: found()
                .map(|f| f.estimated_relative_error)
                .fold(0.0, f64::max),
            saws_with_krein_violations: found().filter(|f| f.krein_violations > 0).count(),
            all: group(study, saws, Vec::new()),
            groups: groups
                .map(|saws| group(study, saws, place(study, &saws[0])))
                .collect(),
            not_analysed: refusals.take(LISTED).collect(),
        }
    }
}

/// The grid's numbers of a saw.
fn place(study: &Study, saw: &Saw) -> Vec<GridEntry> {
    let numbers = study.varying.iter().zip(&saw.values);
    numbers
        .filter(|((_, distribution), _)| matches!(distribution, Distribution::Grid(_)))
        .map(|((parameter, _), value)| GridEntry {
            parameter: parameter.path().to_owned(),
            value: *value,
        })
        .collect()
}

fn group(study: &Study, saws: &[Saw], grid: Vec<GridEntry>) -> Group {
    let count = |is: fn(&Outcome) -> bool| saws.iter().filter(|saw| is(&saw.outcome)).count();
    Group {
        grid,
        saws: saws.len(),
        refused: count(|outcome| matches!(outcome, Outcome::Refused(_))),
        failed: count(|outcome| matches!(outcome, Outcome::Failed(_))),
        lowest_critical: speed(study, saws, |found| found.lowest_critical_rpm),
        flutter: speed(study, saws, |found| found.flutter_rpm),
        passing: study.limits().map(|_| passing(study, saws)),
    }
}

fn speed(study: &Study, saws: &[Saw], of: fn(&Found) -> Option<f64>) -> SpeedEntry {
    let all: Vec<Option<f64>> = saws.iter().filter_map(Saw::found).map(of).collect();
    let mut sorted: Vec<f64> = all.iter().copied().flatten().collect();
    sorted.sort_by(f64::total_cmp);
    let beyond = all.len() - sorted.len();
    let shares = study.file().quantiles.iter();
    SpeedEntry {
        saws: sorted.len(),
        beyond,
        median_rpm: quantile(&sorted, beyond, 0.5),
        quantiles: shares
            .map(|&share| Quantile {
                share,
                rpm: quantile(&sorted, beyond, share),
            })
            .collect(),
        histogram: histogram(&sorted),
    }
}

/// Twice the cube root of the number of saws makes the bars (Rice's rule): their heights
/// scatter as little as their number allows.
fn histogram(sorted: &[f64]) -> Option<Histogram> {
    let (from, to) = (*sorted.first()?, *sorted.last()?);
    let bars = (2.0 * (sorted.len() as f64).cbrt()).round() as usize;
    let bars = bars.clamp(1, MOST_BARS);
    let mut counts = vec![0; bars];
    for rpm in sorted {
        // A range without length is one bar.
        let share = if to > from {
            (rpm - from) / (to - from)
        } else {
            0.0
        };
        counts[((share * bars as f64) as usize).min(bars - 1)] += 1;
    }
    Some(Histogram {
        from_rpm: from,
        to_rpm: to,
        counts,
    })
}

fn passing(study: &Study, saws: &[Saw]) -> Passing {
    let found = || saws.iter().filter_map(Saw::found);
    let passed = found().filter(|f| f.passed() == Some(true)).count();
    let confidence = study.file().confidence;
    // In several points of the grid the deviations are the same, so that saws are not
    // independent.
    let is_drawn = study.file().saws.is_some() && saws.len() == study.drawn();
    let criteria = study.criteria_of_nothing().into_iter().enumerate();
    Passing {
        passed,
        probability: passed as f64 / saws.len().max(1) as f64,
        confidence,
        interval: is_drawn.then(|| interval(passed, saws.len(), confidence)),
        criteria: criteria
            .map(|(k, criterion)| CriterionEntry {
                key: criterion.key.to_owned(),
                name: criterion.name.to_owned(),
                asked_rpm: rpm(criterion.asked),
                passed: found().filter(|f| f.kept[k]).count(),
            })
            .collect(),
    }
}
