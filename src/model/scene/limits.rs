//! Limits that a saw has to keep.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Limits that the saw has to keep, for every verdict. An absent one is that of practice, if there is one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Largest ratio of the operating speed to the first critical speed; 0.85 where it is absent, the rule of saw makers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Lowest allowed first critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_critical_rpm: Option<f64>,
    /// Lowest allowed flutter speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_flutter_rpm: Option<f64>,
    /// Largest allowed speed of the rim; 100 m/s where it is absent, the most that makers of carbide-tipped blades allow. Saws for
    /// stone have 80 m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_rim_m_per_s: Option<f64>,
    /// Largest allowed amplitude of flutter in any band up to the operating speed, without damping.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_amplitude_m: Option<f64>,
    /// Largest allowed deflection of the rim at the cut under the lateral force, at the operating speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_deviation_m: Option<f64>,
}

/// Largest share of the first critical speed at which saw makers run a saw.
pub(crate) const USUAL_MARGIN: f64 = 0.85;

/// Largest rim speed that manufacturers of carbide-tipped blades allow. Saws for wood have 60 to 90 m/s.
pub(crate) const USUAL_MAX_RIM_M_PER_S: f64 = 100.0;

impl LimitsFile {
    /// The limit of the ratio of the operating speed to the first critical speed.
    pub fn margin(&self) -> f64 {
        self.margin.unwrap_or(USUAL_MARGIN)
    }

    /// The limit of the rim speed.
    pub fn max_rim_m_per_s(&self) -> f64 {
        self.max_rim_m_per_s.unwrap_or(USUAL_MAX_RIM_M_PER_S)
    }
}
