//! The statistics of a study: `study.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::StudyFile;
use crate::scene::SceneFile;

/// Quantiles and probabilities of a study, and what it was asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyReport {
    /// Version of the program.
    pub sawflutter: String,
    /// The saw without deviations.
    pub scene: SceneFile,
    /// Numbers that no saw has, each with its key, what saws have, and the remedy: what the report
    /// says holds for them as they were typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
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
    /// The saws drawn in each point of the grid, where there are both, and no more than 10 000
    /// points.
    pub groups: Vec<Group>,
    /// The first saws that were not analysed.
    pub not_analysed: Vec<Refusal>,
    /// How many saws can be run, by the speed at which they are; null where no saw has a critical
    /// or a flutter speed.
    #[serde(default)]
    pub reliability: Option<Reliability>,
    /// The saws with the lowest first critical speed, ascending.
    #[serde(default)]
    pub worst_lowest_critical: Vec<WorstSaw>,
    /// The saws with the lowest flutter speed, ascending.
    #[serde(default)]
    pub worst_flutter: Vec<WorstSaw>,
    /// Kinds of processors that have computed the saws, where there are several: the last digits
    /// of a speed may differ between them.
    #[serde(default)]
    pub processors: Vec<String>,
}

/// How many saws can be run, by the speed at which they are: up to that speed they keep the margin
/// to their lowest critical speed, and do not flutter. A saw that was refused or failed cannot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reliability {
    /// Largest share of the lowest critical speed that the operating speed may be: that of the
    /// limits, or the usual one.
    pub margin: f64,
    /// The highest speeds at which given shares of the saws can be run; null where it lies beyond
    /// the speeds of the study, or fewer saws were analysed.
    pub fastest: Vec<Quantile>,
    /// Shares of the saws that can be run at even speeds.
    pub curve: Vec<ReliabilityPoint>,
}

/// The share of the saws that can be run at a speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReliabilityPoint {
    /// The speed.
    pub operating_rpm: f64,
    /// The share of all saws.
    pub share: f64,
}

/// A saw with a low speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorstSaw {
    /// Its number.
    pub saw: usize,
    /// Its speed.
    pub rpm: f64,
    /// The numbers that vary, in the order of the study.
    pub values: Vec<f64>,
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
