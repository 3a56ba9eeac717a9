//! Bands of instability.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::stability::InstabilityKind;

/// A band of unstable speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InstabilityEntry {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// Speed at which the band begins.
    pub from_rpm: f64,
    /// Speed at which the band ends, or the end of the sweep.
    pub to_rpm: f64,
    /// False if the sweep begins or ends inside the band.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak_rpm: f64,
    /// Largest growth rate.
    pub peak_growth_per_s: f64,
    /// Frequency at the peak.
    pub frequency_hz: f64,
    /// Waves of the band at its own speed: "2 diameters" for divergence, "4 reflected with 2 forward" for
    /// flutter; null without a diagram. The branches are named by their modes at rest, which may differ.
    #[serde(default)]
    pub name: Option<String>,
    /// Numbers of the branches that become unstable; empty without a diagram.
    pub branches: Vec<usize>,
    /// Waves of the band one by one, reflected ones first: "4 diameters, reflected".
    pub modes: Vec<String>,
    /// Intervals [from, to] in which the band counts as an instability: divergence as a whole; flutter of an
    /// undamped blade as a whole if its largest growth reaches the threshold, of a damped one where its
    /// growth does.
    pub counted_rpm: Vec<[f64; 2]>,
    /// Amplitude to which flutter rises from a small motion at the speed of largest growth, limited by
    /// stretching, without damping; up to 1.41 times as large near one edge of the band. Null unless
    /// requested, for divergence, if only damping makes the blade flutter, and if it was not computed.
    #[serde(default)]
    pub saturated_amplitude_m: Option<f64>,
    /// Reason for which the amplitude was not computed, although it was requested; null if there is none.
    #[serde(default)]
    pub amplitude_not_computed: Option<String>,
    /// Estimated relative error of the onset.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the largest growth rate. As a small difference of large numbers it may
    /// exceed the tolerance.
    #[serde(default)]
    pub estimated_relative_growth_error: Option<f64>,
}
