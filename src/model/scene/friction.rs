//! Friction of the guide pads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::typical_value;

/// Friction of the guide pads and cooling of the blade that it heats, for `sawflutter gap`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionFile {
    /// Coefficient of friction of dry contact. Pads with `contact` linear have no friction.
    pub coefficient: f64,
    /// Share of the power of friction that enters the blade.
    #[serde(default = "usual_heat_share")]
    pub heat_share: f64,
    /// Heat transfer coefficient of each face of the blade.
    #[serde(default = "usual_convection_w_per_m2_k")]
    pub convection_w_per_m2_k: f64,
    /// Thermal conductivity of the blade.
    #[serde(default = "usual_conductivity_w_per_m_k")]
    pub conductivity_w_per_m_k: f64,
}

fn usual_heat_share() -> f64 {
    const { typical_value("friction.heat_share") }
}

fn usual_convection_w_per_m2_k() -> f64 {
    const { typical_value("friction.convection_w_per_m2_k") }
}

fn usual_conductivity_w_per_m_k() -> f64 {
    const { typical_value("friction.conductivity_w_per_m_k") }
}

impl FrictionFile {
    /// Friction with a coefficient, where all heat enters a blade of steel in air.
    pub fn of(coefficient: f64) -> Self {
        FrictionFile {
            coefficient,
            heat_share: usual_heat_share(),
            convection_w_per_m2_k: usual_convection_w_per_m2_k(),
            conductivity_w_per_m_k: usual_conductivity_w_per_m_k(),
        }
    }
}
