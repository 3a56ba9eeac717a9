//! `washboard.json`: whether the cutting force, which depends on the surface left by the preceding tooth,
//! makes a motion of the blade grow.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::Verdict;
use crate::model::scene::SceneFile;
use crate::modes::Direction;

/// Report of a washboarding analysis (`washboard.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WashboardReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// The cut of the verdict: "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Rotation speed of the verdict.
    pub rpm: f64,
    /// Whether a vibration grows at that speed.
    pub verdict: Verdict,
    /// Number of teeth that pass per second.
    pub tooth_passing_hz: f64,
    /// Times between successive teeth: one for even teeth, otherwise one for each pitch that repeats.
    pub delays_s: Vec<f64>,
    /// Lateral cutting stiffness of all teeth in the cut together.
    pub stiffness_n_per_m: f64,
    /// Share of a tooth's cut on the surface left by the preceding tooth.
    pub overlap: f64,
    /// Arc of the rim on which the force acts.
    pub arc_deg: f64,
    /// Feed speed of the wood, if given.
    pub feed_m_per_s: Option<f64>,
    /// Smallest cutting stiffness at which a vibration grows at the speed `rpm`; null if it exceeds
    /// `ceiling_n_per_m`, zero if a vibration grows without the delayed force.
    pub critical_stiffness_n_per_m: Option<f64>,
    /// Frequency of this motion.
    pub critical_frequency_hz: Option<f64>,
    /// Number of eigenvalues in the right half plane by the argument principle, two for each oscillation;
    /// null if one lies on the imaginary axis.
    pub growing_eigenvalues: Option<usize>,
    /// Number of growing eigenvalues without the delayed force.
    pub growing_eigenvalues_without: usize,
    /// Modes at the speed `rpm`, in descending order of growth.
    pub modes: Vec<WashboardMode>,
    /// Smallest cutting stiffness at which a vibration grows, over the speed.
    pub lobes: Lobes,
    /// Largest cutting stiffness of the search.
    pub ceiling_n_per_m: f64,
    /// Frequency up to which the modes are complete.
    pub complete_to_hz: f64,
    /// Largest number of nodal diameters of the basis.
    pub max_diameters: usize,
    /// Number of radial functions for each number of nodal diameters.
    pub radial_functions: usize,
    /// Estimated relative error of the critical speeds in this basis.
    pub estimated_relative_error: Option<f64>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A mode with the delayed force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "WashboardModeEntry")]
pub struct WashboardMode {
    /// Harmonics of the mode, with shares if none dominates.
    pub name: String,
    /// Direction of the wave, seen from space.
    pub direction: Direction,
    /// Im λ/2π in space.
    pub frequency_hz: f64,
    /// Re λ.
    pub growth_per_s: f64,
    /// Re λ of the mode without the delayed force; null for a mode that exists only because of the delay.
    pub growth_without_per_s: Option<f64>,
    /// Im λ/2π of the mode without the delayed force.
    pub frequency_without_hz: Option<f64>,
    /// Multiple of the tooth passing frequency that is nearest to `frequency_hz`; null for unevenly spaced
    /// teeth.
    pub tooth_passing_multiple: Option<u32>,
    /// `frequency_hz` minus this multiple.
    pub beside_tooth_passing_hz: Option<f64>,
    /// Wavelength, along the feed, of the pattern that the mode leaves on the board; null without a feed.
    pub pattern_pitch_m: Option<f64>,
}

/// The lobe diagram.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "LobesEntry")]
pub struct Lobes {
    /// Rotation speeds.
    pub rpm: Vec<f64>,
    /// Smallest cutting stiffness at which a vibration grows; null if it exceeds `ceiling_n_per_m`, zero if a
    /// motion grows without the delayed force.
    pub critical_stiffness_n_per_m: Vec<Option<f64>>,
    /// Frequency of this motion.
    pub frequency_hz: Vec<Option<f64>>,
    /// Cutting stiffness up to which it is known that no vibration grows: the critical one, or the largest of the
    /// search; less where only damping prevents the growth of omitted modes, zero where the count does not confirm it.
    pub stable_to_n_per_m: Vec<f64>,
    /// Whether the argument principle confirms that no vibration grows just below this stiffness.
    pub confirmed: Vec<bool>,
}

impl WashboardReport {
    /// The mode of fastest growth, if one grows.
    pub fn growing_mode(&self) -> Option<&WashboardMode> {
        self.modes.first().filter(|mode| mode.growth_per_s > 0.0)
    }
}
