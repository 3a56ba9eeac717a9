//! `deflect.json`: equilibria of the blade while its speed slowly rises and falls.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::{CampbellDiagram, CriticalSpeed, InstabilityBand};
use crate::model::scene::SceneFile;
use crate::motion::stretched_blade::TurnKind;

/// Report of the equilibria over speed (`deflect.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeflectReport {
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
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest relative change of the deflection with half as many modes more; null if the blade remains
    /// flat.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of a small deflection at the force, at rest, on the basis from which the shapes are
    /// made; null without a force, and for a blade that is buckled at rest.
    #[serde(default)]
    pub basis_error: Option<f64>,
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Lateral force at the rim, fixed in space.
    pub force_n: f64,
    /// Angle of the force, positive in the direction of rotation.
    pub force_angle_deg: f64,
    /// Distance of the probe from the axis.
    pub probe_radius_m: f64,
    /// Angle of the probe.
    pub probe_angle_deg: f64,
    /// Rising speed up to which the deflection stays within the thickness everywhere; null if it does at all
    /// speeds.
    pub beyond_thickness_rpm: Option<f64>,
    /// Stable equilibria for rising speed.
    pub up: SlowSweep,
    /// Stable equilibria for falling speed.
    pub down: SlowSweep,
    /// Curves of equilibria, including unstable ones. It is not proven that there are no others.
    pub curves: Vec<EquilibriumCurve>,
    /// Critical speeds of the flat blade, up to the last speed.
    pub critical_speeds: Vec<CriticalSpeed>,
    /// Bands in which the flat blade is unstable, by the linear model.
    pub instabilities: Vec<InstabilityBand>,
    /// Branches of the flat blade over the same speeds.
    pub campbell: CampbellDiagram,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Stable equilibria for slowly rising or falling speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SlowSweepEntry")]
pub struct SlowSweep {
    /// Arcs between jumps, in the order of the sweep.
    pub arcs: Vec<Arc>,
    /// Jumps at the ends of all arcs but the last.
    pub jumps: Vec<Jump>,
    /// Speed above which slopes of the blade exceed 0.1, where the model is not valid; there are no results
    /// beyond it. Null if they do not.
    pub valid_until_rpm: Option<f64>,
    /// Speed at which the sweep stopped at its largest number of equilibria; there are no results beyond it. Null if it
    /// did not.
    #[serde(default)]
    pub stopped_at_rpm: Option<f64>,
}

/// Stable equilibria. All lists have one entry for each speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ArcEntry")]
pub struct Arc {
    /// Rotation speeds, rising or falling.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection over the blade.
    pub largest_deflection_m: Vec<f64>,
    /// Largest slope of the blade.
    pub largest_slope: Vec<f64>,
    /// Force of each pad that lifts off on the blade beyond its gap, without that of its film: a row for each such guide, in
    /// the order of the scene.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pad_forces_n: Vec<Vec<f64>>,
    /// Frequencies of small motions about the deflected blade in space, ascending, up to `campbell.complete_to_hz`.
    pub frequencies_hz: Vec<Vec<f64>>,
}

/// A jump from an equilibrium that ceases to be stable to another one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "JumpEntry")]
pub struct Jump {
    /// Fold, beyond which the equilibrium does not exist, or bifurcation, at which another one crosses it.
    pub kind: TurnKind,
    /// Rotation speed.
    pub rpm: f64,
    /// Deflection at the probe before the jump.
    pub from_m: f64,
    /// Deflection at the probe after the jump.
    pub to_m: f64,
    /// Largest deflection over the blade before the jump.
    pub largest_from_m: f64,
    /// Largest deflection over the blade after the jump.
    pub largest_to_m: f64,
}

/// A curve of equilibria. All lists have one entry for each equilibrium, in the order of the curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "EquilibriumCurveEntry")]
pub struct EquilibriumCurve {
    /// Rotation speeds, not necessarily ascending.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection over the blade.
    pub largest_deflection_m: Vec<f64>,
    /// Number of directions in which the potential energy decreases; 0 for a stable equilibrium.
    pub negative_eigenvalues: Vec<usize>,
    /// Folds and bifurcations of the curve.
    pub turns: Vec<Turn>,
}

/// A fold or a bifurcation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "TurnEntry")]
pub struct Turn {
    /// Kind of the turning point.
    pub kind: TurnKind,
    /// Rotation speed.
    pub rpm: f64,
    /// Deflection at the probe.
    pub deflection_m: f64,
}
