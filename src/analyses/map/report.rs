//! `map.json`: a grid of saws over one number and the speed, or over two numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::InstabilityBand;
use crate::analyses::verdict::{Criterion, Verdict};
use crate::model::scene::SceneFile;

/// Report of a map (`map.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// The number along the horizontal axis.
    pub x: MapAxis,
    /// The number along the vertical axis; null if that is the speed.
    pub y: Option<MapAxis>,
    /// Speed at which each saw is judged; null if neither the scene nor the options have one.
    pub rpm: Option<f64>,
    /// Last speed of the sweep, the same for every saw; flutter beyond it is unknown.
    pub to_rpm: f64,
    /// Growth rate above which a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// The saws, row by row: x varies fastest.
    pub saws: Vec<MappedSaw>,
    /// Contours of a map over two numbers; empty for a map over the speed.
    pub contours: Vec<Contour>,
    /// Largest estimated relative error of the critical speeds of any saw.
    pub largest_estimated_relative_error: f64,
    /// Number of saws with a speed at which the Krein index disagrees; 0 is expected.
    pub saws_with_krein_violations: usize,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A number along an axis of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MapAxisEntry")]
pub struct MapAxis {
    /// JSON path in the scene.
    pub path: String,
    /// Name of the number.
    pub name: String,
    /// Unit of the values; empty for a dimensionless number.
    pub unit: String,
    /// Values, ascending; on a logarithmic scale if the last is at least ten times the first.
    pub values: Vec<f64>,
    /// Value of the scene.
    pub of_scene: f64,
}

/// A saw of a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MappedSawEntry")]
pub struct MappedSaw {
    /// Value of the number along the horizontal axis.
    pub x: f64,
    /// Value of the number along the vertical axis; null for a map over the speed.
    pub y: Option<f64>,
    /// First critical speed; null if the blade has none.
    pub first_critical_rpm: Option<f64>,
    /// Flutter speed; null if no flutter counts within the sweep.
    pub flutter_rpm: Option<f64>,
    /// Critical speeds within the sweep, ascending.
    pub critical_rpm: Vec<f64>,
    /// Bands of instability within the sweep, by onset.
    pub instabilities: Vec<InstabilityBand>,
    /// Whether the saw can run at the speed at which the saws are judged; null if it was not analysed.
    pub verdict: Option<Verdict>,
    /// Deflection of the rim at the cut under a constant side force there at that speed, relative to that at rest, as in the
    /// verdict of `analyze`; null without such a speed, unless the saw is stable, and where no verdict gives it.
    #[serde(default)]
    pub side_force_factor: Option<f64>,
    /// Reason for which the saw was not analysed; null if it was.
    pub not_analysed: Option<String>,
}

impl MappedSaw {
    /// Smallest distance from a limit of a speed relative to it, negative if one is not kept.
    pub(super) fn distance(&self) -> Option<f64> {
        self.criteria()
            .filter_map(Criterion::distance)
            .reduce(f64::min)
    }

    /// The limits, with their results.
    pub(super) fn criteria(&self) -> impl Iterator<Item = &Criterion> {
        self.verdict.iter().flat_map(|verdict| &verdict.limits)
    }
}

/// A quantity of which a map over two numbers has contours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "ContouredEntry")]
pub enum Contoured {
    /// The flutter speed.
    FlutterSpeed,
    /// The first critical speed.
    FirstCriticalSpeed,
    /// The distance from the limits of speeds, where it is zero at the speed of the map.
    Limits,
}

/// A line of equal speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ContourEntry")]
pub struct Contour {
    /// Quantity that is constant along the line.
    pub quantity: Contoured,
    /// Value of this quantity; for the limits, the speed at which the saws are judged.
    pub rpm: f64,
    /// Points of the line: values of x and of y.
    pub points: Vec<[f64; 2]>,
}

impl MapReport {
    /// Rows of the saws, one for each value of y.
    pub fn rows(&self) -> std::slice::Chunks<'_, MappedSaw> {
        self.saws.chunks(self.x.values.len().max(1))
    }
}
