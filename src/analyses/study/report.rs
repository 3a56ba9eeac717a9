//! The statistics of a study: `study.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::StudyFile;
use crate::model::scene::SceneFile;

/// Quantiles and probabilities of a study, and its inputs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene without deviations, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// The study, as typed.
    pub study: StudyFile,
    /// Last speed of the sweep.
    pub swept_to_rpm: f64,
    /// Largest estimated relative error of the critical speeds of any saw.
    pub largest_estimated_relative_error: f64,
    /// Number of saws with a speed at which the Krein index disagrees; 0 is expected.
    pub saws_with_krein_violations: usize,
    /// All saws together.
    pub all: Group,
    /// Saws of each point of the grid, if the study has random saws and at most 10 000 points.
    pub groups: Vec<Group>,
    /// The first saws that were not analysed.
    pub not_analysed: Vec<Refusal>,
    /// Share of saws that can run, over the operating speed; null if no saw has a critical or a flutter
    /// speed.
    #[serde(default)]
    pub reliability: Option<Reliability>,
    /// The saws with the lowest first critical speed, ascending.
    #[serde(default)]
    pub worst_first_critical: Vec<WorstSaw>,
    /// The saws with the lowest flutter speed, ascending.
    #[serde(default)]
    pub worst_flutter: Vec<WorstSaw>,
    /// Kinds of processors that have computed the saws, if there are several: the last digits of a speed may
    /// differ between them.
    #[serde(default)]
    pub processors: Vec<String>,
}

/// Share of saws that can run, over the operating speed: at that speed they keep the margin to their lowest
/// critical speed and do not flutter. A saw that was refused or failed cannot run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reliability {
    /// Largest ratio of the operating speed to the first critical speed: that of the limits, or the usual
    /// one.
    pub margin: f64,
    /// Highest operating speeds for given shares of the saws, as fine as the number of saws allows; null if it exceeds the speeds of
    /// the study, or fewer saws were analysed.
    pub fastest: Vec<Quantile>,
    /// Shares of the saws that can run at evenly spaced speeds.
    pub curve: Vec<ReliabilityPoint>,
}

/// Share of the saws that can run at a speed.
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
    /// Number of the saw in the study.
    pub saw: usize,
    /// First critical speed or flutter speed of the saw.
    pub rpm: f64,
    /// Values of the varying numbers, in the order of the study.
    pub values: Vec<f64>,
}

/// A group of saws.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Point of the grid; empty for all saws.
    pub grid: Vec<GridNumber>,
    /// Number of saws.
    pub saws: usize,
    /// Number of saws with impossible values.
    pub refused: usize,
    /// Number of saws that could not be analysed.
    pub failed: usize,
    /// First critical speed of the analysed saws.
    pub first_critical: SpeedStatistics,
    /// Flutter speed of the analysed saws.
    pub flutter: SpeedStatistics,
    /// Share of saws that keep the limits, if the study has any.
    pub passing: Option<Passing>,
    /// Numbers of guides with a gap, if the study has a block `gap`.
    #[serde(default)]
    pub gap: Option<GapStatistics>,
}

/// Deflections and pad forces of the analysed saws of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GapStatistics {
    /// Deflection of the rim at the cut, in m, as an absolute value.
    pub deflection_at_cut: NumberStatistics,
    /// Largest force of a pad, in N, as an absolute value.
    pub largest_pad_force: NumberStatistics,
    /// First critical speed at the amplitude of the study, in rpm; null without an amplitude.
    pub critical_at_amplitude: Option<NumberStatistics>,
    /// Number of saws whose deflection keeps its limit; null without a limit.
    pub saws_within: Option<usize>,
}

/// Distribution of a number of the analysed saws, in SI units or rpm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "NumberEntry")]
pub struct NumberStatistics {
    /// Number of saws whose number is known. The number of the other analysed saws counts as larger than any: the
    /// deflection is not known where slopes of the blade exceed 0.1.
    pub saws: usize,
    /// Median; null if it is not known.
    pub median: Option<f64>,
    /// Numbers below which given shares of the saws lie, as fine as the number of saws allows.
    pub quantiles: Vec<NumberQuantile>,
}

/// A number below which a share of the saws lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberQuantile {
    /// The share.
    pub share: f64,
    /// The number; null if it is not known.
    pub value: Option<f64>,
}

/// A number of a point of the grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "GridEntry")]
pub struct GridNumber {
    /// JSON path in the scene.
    pub parameter: String,
    /// Value of the number.
    pub value: f64,
}

/// Distribution of a speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SpeedEntry")]
pub struct SpeedStatistics {
    /// Number of saws with such a speed.
    pub saws: usize,
    /// Number of analysed saws without such a speed within the speeds of the study.
    pub beyond: usize,
    /// Median; null if it exceeds the speeds of the study.
    pub median_rpm: Option<f64>,
    /// Speeds below which given shares of the saws lie, as fine as the number of saws allows.
    pub quantiles: Vec<Quantile>,
    /// Histogram; null without saws.
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
    /// Lowest speed.
    pub from_rpm: f64,
    /// Highest speed.
    pub to_rpm: f64,
    /// Number of saws in each bar.
    pub counts: Vec<usize>,
}

/// Share of saws that keep all limits. A saw that was refused or failed keeps none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Passing {
    /// Speed at which the saws are judged.
    pub operating_rpm: f64,
    /// Number of saws that keep every limit.
    pub passed: usize,
    /// Share of these saws among all saws of the group.
    pub probability: f64,
    /// Confidence of the interval.
    pub confidence: f64,
    /// Interval of the probability (by Clopper and Pearson for independent saws; scrambled Sobol points are
    /// more even). Null for a grid, whose share is exact, and for all saws of several groups, because the groups have
    /// the same deviations.
    pub interval: Option<[f64; 2]>,
    /// Number of saws that keep each limit.
    pub criteria: Vec<LimitStatistics>,
}

/// Number of saws that keep one limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CriterionEntry")]
pub struct LimitStatistics {
    /// Short name, as in the columns of the table.
    pub key: String,
    /// The limit in words.
    pub name: String,
    /// Speed required.
    pub asked_rpm: f64,
    /// Number of saws that keep the limit.
    pub passed: usize,
}

/// A saw that was not analysed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Refusal {
    /// Number of the saw in the study.
    pub saw: usize,
    /// Reason for which it was not analysed.
    pub reason: String,
}
