//! `check.json` and `sawflutter check --json`: every limit with its result.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::verdict::Verdict;
use crate::model::scene::{LimitsFile, SceneFile};

/// A comparison of a saw with limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Whether a saw with unusual numbers may pass.
    #[serde(default)]
    pub accept_unusual: bool,
    /// Whether the answer is yes, and unusual numbers are absent or accepted.
    pub passed: bool,
    /// Whether the saw can run at the operating speed, with every limit.
    pub verdict: Verdict,
    /// Operating speed.
    pub operating_rpm: f64,
    /// Last speed of the sweep; results are limited to it.
    pub to_rpm: f64,
    /// First critical speed, also above the sweep; null if the blade has none.
    pub first_critical_rpm: Option<f64>,
    /// Critical speeds within the sweep, ascending.
    pub critical_rpm: Vec<f64>,
    /// Every band of instability within the sweep.
    pub instabilities: Vec<InstabilityBand>,
    /// Growth rate above which a band counts.
    pub flutter_threshold_per_s: f64,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest.
    pub rim_stiffness_at_rest_n_per_m: f64,
    /// Lateral stiffness of this point at the operating speed; null above the first critical speed, where it is
    /// not defined.
    pub rim_stiffness_n_per_m: Option<f64>,
    /// Deflection of this point under a constant side force there at the operating speed, relative to that at rest, as in the report of
    /// `analyze`.
    #[serde(default)]
    pub side_force_factor: Option<f64>,
    /// Deflection of this point under the constant lateral force of the scene at the operating speed.
    #[serde(default)]
    pub deviation: Option<BoardDeviation>,
    /// Lateral stiffness of this point over the speed.
    pub rim_stiffness: RimStiffness,
    /// Rim speed at the operating speed.
    pub rim_speed_m_per_s: f64,
    /// Limits that the scene and the options set.
    pub limits: LimitsFile,
    /// Estimated relative error of the critical speeds.
    pub estimated_relative_error: Option<f64>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Lateral stiffness of a point of the rim over the speed: a force fixed in space, in N, over the deflection
/// under it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "RimStiffnessEntry")]
pub struct RimStiffness {
    /// Speeds from rest to just below the first critical one; empty if nothing holds the blade.
    pub rpm: Vec<f64>,
    /// Stiffness at these speeds.
    pub n_per_m: Vec<f64>,
}

impl CheckReport {
    /// Unusual numbers, unless they are accepted, and limits that are not kept, for assertions.
    pub fn failures(&self) -> Vec<String> {
        let refused = self.unusual_numbers.iter().filter(|_| !self.accept_unusual);
        let failed = self
            .verdict
            .limits
            .iter()
            .filter(|criterion| !criterion.is_kept())
            .map(|criterion| format!("{}: {}", criterion.name, criterion.finding));
        refused.cloned().chain(failed).collect()
    }

    /// Sentence about the rim stiffness, for text and figure.
    pub fn rim_stiffness_in_words(&self) -> String {
        if self.rim_stiffness_at_rest_n_per_m == 0.0 {
            return "no rim stiffness: nothing holds the blade's rigid motions".to_owned();
        }
        let at_rest = 1e-3 * self.rim_stiffness_at_rest_n_per_m;
        let operating = match self.rim_stiffness_n_per_m {
            Some(stiffness) => format!("{:.1} N/mm at the operating speed", 1e-3 * stiffness),
            None => "none above the first critical speed".to_owned(),
        };
        let touching = if self.scene.has_gaps() {
            ", with guides that touch the blade"
        } else {
            ""
        };
        format!("stiffness of the rim at the cut{touching}: {at_rest:.1} N/mm at rest, {operating}")
    }
}
