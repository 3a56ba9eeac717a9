//! The study as typed: the JSON that a user writes, key by key.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::scene_number::with_unit;
use crate::model::scene::{RefusedValue, SceneError, SceneFile};
use crate::page::text::{KeyedError, from_keyed_json};
use crate::stability::AnalysisError;

/// Numbers of a scene that vary, their distributions, and limits of the saws.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyFile {
    /// Name of the study: the title of reports and figures.
    pub name: String,
    /// Origin of the numbers: measured, assumed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// The numbers that vary, independently of each other.
    pub parameters: Vec<ParameterFile>,
    /// Number of random saws, in every point of the grid; omit it if all parameters are grids. Powers of two
    /// are most evenly distributed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub saws: Option<u32>,
    /// Seed of the random saws.
    #[serde(default)]
    pub seed: u32,
    /// Last speed of the sweep; by default the end of the scene's sweep. Limits at higher speeds extend the sweep.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to_rpm: Option<f64>,
    /// Limits of each saw, in place of those of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<StudyLimits>,
    /// Computations for guides with a gap; at least one guide of the scene is one-sided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<GapFile>,
    /// Shares of the saws for which quantiles of the speeds are reported.
    #[serde(default = "default_quantiles")]
    pub quantiles: Vec<f64>,
    /// Confidence of the interval around the probability of passing.
    #[serde(default = "default_confidence")]
    pub confidence: f64,
    /// Whether the table lists the bands of instability of each saw, in the column `bands`: kind, onset and end in rpm, whether both
    /// are within the sweep, speed in rpm, growth rate in 1/s and frequency in Hz of the largest growth, and the ranges of speed in
    /// which the band counts, and after a bar those in which it is felt; bands are separated by semicolons.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub bands: bool,
}

/// Limits of the saws of a study. An absent one is that of the scene, or of practice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyLimits {
    /// Operating speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_rpm: Option<f64>,
    /// Largest ratio of the operating speed to the first critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Lower limit of the flutter speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_flutter_rpm: Option<f64>,
    /// Lower limit of the first critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_critical_rpm: Option<f64>,
}

/// The deflection at the cut of a saw with guides with a gap under the side force of its scene, as of `sawflutter gap`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GapFile {
    /// Rotation speed; by default the operating speed of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpm: Option<f64>,
    /// Upper limit of the deflection at the cut; the saws that keep it are counted. By default `limits.max_deviation_m` of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_deviation_m: Option<f64>,
    /// Amplitude of an oscillation at the guides, with whose mean stiffness the first critical speed is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude_m: Option<f64>,
}

impl GapFile {
    /// Upper limit of the deflection at the cut of the saws of a scene.
    pub(super) fn limit_m(&self, scene: &SceneFile) -> Option<f64> {
        let of_scene = scene.limits.as_ref();
        self.max_deviation_m.or_else(|| of_scene?.max_deviation_m)
    }
}

fn default_quantiles() -> Vec<f64> {
    vec![0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99]
}

fn default_confidence() -> f64 {
    0.95
}

/// A number of the scene that varies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParameterFile {
    /// JSON path of the number in the scene, like `guides[0].radius_m`.
    pub path: String,
    /// Distribution, in the unit of the number.
    pub distribution: DistributionFile,
}

/// Distribution of a number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum DistributionFile {
    /// Uniform about the scene's value.
    Tolerance {
        /// Largest deviation to either side.
        plus_minus: f64,
    },
    /// Uniform between two values.
    Uniform {
        /// Lower limit.
        from: f64,
        /// Upper limit.
        to: f64,
    },
    /// Normal, truncated on both sides, because saws far outside are not sold.
    Normal {
        /// Mean; the scene's value by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        mean: Option<f64>,
        /// Standard deviation before truncation.
        standard_deviation: f64,
        /// Truncation, in standard deviations from the mean.
        #[serde(default = "default_truncation")]
        truncated_at_deviations: f64,
    },
    /// Every value of a list, combined with all values of the others.
    Grid {
        /// The values.
        values: Vec<f64>,
    },
}

impl ParameterFile {
    /// The number and how it varies: "blade.thickness_m ± 0.05 mm".
    pub(super) fn in_words(&self) -> String {
        let path = &self.path;
        let shown = |value: f64| with_unit(path, value);
        match &self.distribution {
            DistributionFile::Tolerance { plus_minus } => {
                format!("{path} ± {}", shown(*plus_minus))
            }
            DistributionFile::Uniform { from, to } => {
                format!("{path} from {} to {}", shown(*from), shown(*to))
            }
            DistributionFile::Normal {
                mean,
                standard_deviation,
                truncated_at_deviations,
            } => {
                let about = mean.map_or(String::new(), |mean| format!("about {}, ", shown(mean)));
                let deviation = shown(*standard_deviation);
                format!(
                    "{path} normal, {about}σ = {deviation}, truncated at ± {truncated_at_deviations} σ"
                )
            }
            DistributionFile::Grid { values } => format!("{path} at {} values", values.len()),
        }
    }
}

/// Limits at three standard deviations, which 0.3 % of the untruncated values exceed.
fn default_truncation() -> f64 {
    3.0
}

/// Reason for which a study was refused.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The text is not JSON or not a study: wrong type, unknown or missing key.
    #[error("{key}: {message}")]
    Syntax {
        /// JSON path of the key.
        key: String,
        /// Description of the error, with remedy and line.
        message: String,
        /// What may be given there, if a key or a value is another.
        allowed: Option<String>,
        /// The remedy, if a key or a value is another or missing.
        remedy: Option<String>,
    },
    /// A value is outside its range.
    #[error(transparent)]
    Value(#[from] RefusedValue),
    /// The scene is refused, as typed or with a varied number.
    #[error("{key}: {source}")]
    Scene {
        /// JSON path of the key of the study that causes this.
        key: String,
        /// The error of the scene.
        source: SceneError,
    },
    /// The scene itself, without deviations, cannot be analysed.
    #[error("the saw of the scene itself: {0}")]
    Nominal(#[from] AnalysisError),
    /// The values of more than a million saws could not be kept in temporary files.
    #[error("cannot keep the saws in temporary files: {0}")]
    Kept(#[from] std::io::Error),
}

impl StudyFile {
    /// A study in which no number varies.
    pub(super) fn named(name: String) -> Self {
        StudyFile {
            name,
            notes: Vec::new(),
            parameters: Vec::new(),
            saws: None,
            seed: 0,
            to_rpm: None,
            limits: None,
            gap: None,
            quantiles: default_quantiles(),
            confidence: default_confidence(),
            bands: false,
        }
    }

    /// Reads a study from JSON text.
    ///
    /// # Errors
    /// [`StudyError::Syntax`] with the JSON path of the offending key.
    pub fn from_json(text: &str) -> Result<Self, StudyError> {
        from_keyed_json(text, "the study").map_err(syntax)
    }
}

fn syntax(error: KeyedError) -> StudyError {
    let KeyedError {
        key,
        message,
        allowed,
        remedy,
        ..
    } = error.pointing_to("`sawflutter schema --study` prints the keys and types of a study, and scenes/studies/ has examples");
    StudyError::Syntax {
        key,
        message,
        allowed,
        remedy,
    }
}

/// The JSON schema of a study file, derived from [`StudyFile`].
pub fn json_schema() -> serde_json::Value {
    schemars::schema_for!(StudyFile).to_value()
}
