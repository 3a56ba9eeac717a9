//! The operating speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::stability::StabilityState;

/// Comparison of the operating speed with the lowest critical speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperatingEntry {
    /// The scene's operating speed.
    pub rpm: f64,
    /// Lowest critical speed, also above the sweep; null if the blade has none.
    #[serde(default)]
    pub lowest_critical_rpm: Option<f64>,
    /// Ratio of operating speed to lowest critical speed; null if the blade has no critical speed.
    pub of_lowest_critical: Option<f64>,
    /// Usual limit of that ratio, 0.85.
    pub limit: f64,
    /// Whether the ratio is at most the limit; null without a ratio.
    pub within_limit: Option<bool>,
    /// Whether the saw is stable at that speed.
    pub verdict: StabilityState,
    /// Index into `instabilities` of the band that makes it unstable.
    pub inside_instability: Option<usize>,
    /// Critical speed within 5 % of the operating speed; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Deflection of the rim at the cut under a constant side force there, relative to that at rest; negative if the
    /// blade moves against the force. Null unless the saw is stable and within 5 % of a critical speed, if nothing
    /// holds the blade's rigid motions, and so close to the critical speed that its error decides.
    #[serde(default)]
    pub side_force_factor: Option<f64>,
    /// The window without instability: speeds of the sweep around the operating speed at which no instability
    /// counts, and which are at least 5 % from critical speeds; null if the saw is unstable or at a critical
    /// speed.
    pub safe_window_rpm: Option<[f64; 2]>,
    /// Re λ of the mode that grows fastest, or decays most slowly; null outside the sweep.
    pub growth_per_s: Option<f64>,
    /// Im λ/2π of this mode.
    pub frequency_hz: Option<f64>,
}
