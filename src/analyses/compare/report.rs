//! `compare.json`: saws side by side, the first being the one that the others are compared with.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::{CampbellDiagram, CriticalSpeed, InstabilityBand, OperatingPoint};
use crate::analyses::verdict::Verdict;
use crate::model::scene::SceneFile;

/// Report of a comparison (`compare.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompareReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The first scene, with which the others are compared.
    pub scene: SceneFile,
    /// The saws.
    pub saws: Vec<ComparedSaw>,
    /// Keys of the scenes that are not the same in all of them; names, notes and measured frequencies are not compared.
    pub differences: Vec<Difference>,
}

/// A saw among others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ComparedEntry")]
pub struct ComparedSaw {
    /// Name of the saw: that of its file, or the change of its scene.
    pub name: String,
    /// Scene of the saw.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// First critical speed, also above the sweep; null if the blade has none.
    pub first_critical_rpm: Option<f64>,
    /// Critical speeds up to the end of its sweep, ascending.
    pub critical_speeds: Vec<CriticalSpeed>,
    /// The bands of instability within its sweep.
    pub instabilities: Vec<InstabilityBand>,
    /// Lowest speed at which flutter counts.
    pub flutter_rpm: Option<f64>,
    /// Whether the saw can run at its operating speed.
    pub verdict: Verdict,
    /// Motions at its operating speed.
    pub operating: Option<OperatingPoint>,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest; null if the blade has free rigid
    /// motions, and for a saw whose report was given instead of its scene.
    pub rim_stiffness_at_rest_n_per_m: Option<f64>,
    /// Estimated relative error of its critical speeds.
    pub estimated_relative_error: Option<f64>,
    /// Branches of the saw over speed.
    pub campbell: CampbellDiagram,
    /// Numbers that no saw has, and remarks on the validity of its result.
    pub warnings: Vec<String>,
}

/// A key that is not the same in all scenes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "DifferenceEntry")]
pub struct Difference {
    /// JSON path of the key.
    pub path: String,
    /// Its value in each scene, as in the file; empty where a scene has none.
    pub values: Vec<String>,
}

impl CompareReport {
    /// Whether the saws idle or are in their cuts: one statement, or one for each saw where they differ.
    pub fn condition(&self) -> String {
        let mut conditions: Vec<&str> = self.saws.iter().map(|saw| &*saw.condition).collect();
        if conditions.windows(2).all(|pair| pair[0] == pair[1]) {
            conditions.truncate(1);
        }
        conditions.join(" | ")
    }
}
