//! `runup.json`: the deflection of the saw during a run-up, and its causes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::{CampbellDiagram, CriticalSpeed, InstabilityBand};
use crate::model::scene::SceneFile;

/// Report of a run-up (`runup.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunUpReport {
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
    /// First speed of the run-up.
    pub from_rpm: f64,
    /// Last speed of the run-up.
    pub to_rpm: f64,
    /// Rate of the run-up.
    pub rate_rpm_per_s: f64,
    /// Time step.
    pub step_s: f64,
    /// Largest deflection that is given; beyond it the linear model is not valid.
    pub linear_limit_m: f64,
    /// Speed at which the deflection of the rim exceeds this limit and the record ends; null if it does not.
    pub linear_until_rpm: Option<f64>,
    /// Speeds of the record.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection of the rim, or of the probe if that is larger.
    #[serde(default)]
    pub largest_deflection_m: f64,
    /// Speed of the largest deflection.
    #[serde(default)]
    pub largest_deflection_rpm: f64,
    /// Critical speeds up to the end of the run-up.
    pub critical_speeds: Vec<CriticalSpeed>,
    /// Bands of instability and their effect on the run-up.
    pub bands: Vec<RunUpBand>,
    /// Onset of the first band that more than doubles a motion at this rate; null if none does.
    pub first_doubling_rpm: Option<f64>,
    /// Results with stretching, if the scene requests it.
    #[serde(default)]
    pub stretching: Option<RunUpStretching>,
    /// Branches over the speeds of the run-up.
    pub campbell: CampbellDiagram,
    /// Response over speed and frequency.
    pub response: ResponseMap,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A band of instability in a run-up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunUpBand {
    /// The band.
    pub band: InstabilityBand,
    /// Time that the run-up spends in the band.
    pub time_s: f64,
    /// Re λ of the band's eigenvalue integrated over that time: a motion in its mode grows by e to this
    /// power.
    pub growth_exponent: f64,
    /// Ratio of the largest deflection at the probe within the band to that in an interval of equal length
    /// before it; null if the record ends before the band does. All vibrating modes contribute: with a small
    /// exponent the ratio shows beating of other modes, not growth.
    pub seen_amplification: Option<f64>,
}

/// A run-up with stretching.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "StretchingEntry")]
pub struct RunUpStretching {
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest slope of the blade.
    pub largest_slope: f64,
    /// Speed above which slopes exceed 0.1 and the record ends; null if they do not.
    pub valid_until_rpm: Option<f64>,
    /// Speeds of the spectrum.
    pub rpm: Vec<f64>,
    /// Frequencies of the spectrum.
    pub frequency_hz: Vec<f64>,
    /// Amplitude at the probe about a straight line, with Hann's window, one row for each speed.
    pub amplitude_m: Vec<Vec<f64>>,
}

/// Magnitude of the deflection at the probe for a harmonic force of one newton, over speed and frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ResponseEntry")]
pub struct ResponseMap {
    /// Rotation speeds.
    pub rpm: Vec<f64>,
    /// Frequencies of the force.
    pub frequency_hz: Vec<f64>,
    /// |w/F|, one row for each speed.
    pub receptance_m_per_n: Vec<Vec<f64>>,
}
