//! Derivatives by numbers of the scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Relative change of speeds for a change of one number of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensitivityEntry {
    /// JSON path of the number in the scene.
    pub parameter: String,
    /// The change: "1 %" or "1 degree".
    pub change: String,
    /// Change of each critical speed up to the end of the sweep, in percent; double ones of a free blade are
    /// listed twice.
    pub critical_speeds_percent: Vec<f64>,
    /// Change of the onset of each reported band, in percent; null if the sweep begins inside the band.
    pub onsets_percent: Vec<Option<f64>>,
    /// dλ/dp of each mode at the operating speed (at rest without one), times the change: real part, growth
    /// in 1/s.
    pub growth_per_s: Vec<f64>,
    /// Imaginary part of this change: frequency in Hz.
    pub frequency_hz: Vec<f64>,
}
