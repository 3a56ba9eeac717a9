//! `size.json`: the values of a number with which a saw keeps its limits.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::verdict::{Answer, Verdict};
use crate::model::scene::SceneFile;

/// The values of a number with which a saw keeps its limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizeReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut.
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy.
    pub unusual_numbers: Vec<String>,
    /// JSON paths of the number in the scene; several if it is that of several guides.
    pub paths: Vec<String>,
    /// Name of the number.
    pub name: String,
    /// Unit of the number; empty if it has none.
    pub unit: String,
    /// Value in the scene.
    pub of_scene: f64,
    /// First value that was tried.
    pub from: f64,
    /// Last value that was tried.
    pub to: f64,
    /// Operating speed; null if it is the number itself.
    pub operating_rpm: Option<f64>,
    /// Values that were tried, ascending.
    pub values: Vec<f64>,
    /// Whether the saw can run at each of these values; null where it was refused.
    pub answers: Vec<Option<Answer>>,
    /// Every limit, with its margin at each of these values.
    pub limits: Vec<SizedLimit>,
    /// Ranges of values in which the saw keeps all limits.
    pub windows: Vec<SizedWindow>,
    /// A value in the range that is nearest to the value of the scene; null if there is no range.
    pub answer: Option<SizeAnswer>,
    /// The ranges for values of another number; null if none was asked for.
    pub each: Option<SizedEach>,
    /// Relative tolerance with which the ranges were searched; their ends and the answer have that of the scene.
    pub searched_tolerance: f64,
    /// Number of saws that were checked.
    pub saws: usize,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A limit, and its margin over the values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizedLimit {
    /// Short name of the limit, for programs, as in the report of a check.
    pub key: String,
    /// Requirement in words.
    pub name: String,
    /// Distance from the limit relative to it, negative if it is not kept; null if it has no number there, or the saw was refused.
    pub margins: Vec<Option<f64>>,
}

/// A range of values in which a saw keeps all limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizedWindow {
    /// Smallest value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// The limit that a smaller value does not keep, with what was found there; null at the first value that was tried.
    pub below: Option<String>,
    /// The limit that a larger value does not keep, with what was found there; null at the last value that was tried.
    pub above: Option<String>,
}

/// The ranges for values of another number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizedEach {
    /// JSON paths of the other number in the scene; several if it is that of several guides.
    pub paths: Vec<String>,
    /// Name of the other number.
    pub name: String,
    /// Unit of the other number; empty if it has none.
    pub unit: String,
    /// Every value, ascending, with that of the scene.
    pub rows: Vec<SizedFor>,
}

/// The ranges for a value of another number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizedFor {
    /// Value of the other number.
    pub value: f64,
    /// Whether the scene has it.
    pub is_of_scene: bool,
    /// First value of the sized number that was tried.
    pub from: f64,
    /// Last value of the sized number that was tried.
    pub to: f64,
    /// Ranges of the sized number in which the saw keeps all limits.
    pub windows: Vec<SizedWindow>,
}

/// A value with which the saw keeps its limits, checked at the accuracy of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SizeAnswer {
    /// The value, rounded to a usual step towards the inside of the range.
    pub value: f64,
    /// Whether the scene has it already.
    pub is_of_scene: bool,
    /// The scene with this value.
    pub scene: SceneFile,
    /// Whether the saw can run with this value, with every limit.
    pub verdict: Verdict,
    /// First critical speed at this value; null if there is none.
    pub first_critical_rpm: Option<f64>,
    /// Deflection of the rim at the cut at this value; null if it is unknown.
    pub deflection_m: Option<f64>,
    /// Change of the first critical speed if the number is larger by 1 %; null if it is unknown.
    pub critical_rpm_per_percent: Option<f64>,
    /// Change of the deflection at the cut if the number is larger by 1 %; null if it is unknown.
    pub deflection_m_per_percent: Option<f64>,
}
