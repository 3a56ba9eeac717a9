//! The range of speeds, and the refusal of a force.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::scene::{RefusedValue, SideForce, speed_rad_per_s};
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::page::text::{rounded_down, shown_to};

/// Computes the equilibrium deflection of the blade while its speed slowly rises and falls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Last speed; by default the end of the scene's sweep.
    pub to_rpm: Option<f64>,
}

impl Options {
    /// Checks the options.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option.
    pub fn checked(&self) -> Result<(), RefusedValue> {
        match self.to_rpm {
            Some(to_rpm) => speed_rad_per_s("to_rpm", to_rpm).map(|_| ()),
            None => Ok(()),
        }
    }
}

/// The refusal of a force that deflects the blade beyond the model at the first speed; a `gentle_n` does not.
pub(super) fn steep(force: &SideForce, gentle_n: f64) -> RefusedValue {
    let most = shown_to(2, rounded_down(2, gentle_n.abs()));
    let allowed = format!(
        "between -{most} and {most} for this saw: a larger force deflects it to slopes above {LARGEST_SLOPE}, where the model ends"
    );
    RefusedValue::new(
        "side_force.force_n",
        force.force_n,
        allowed,
        "give a smaller force",
    )
}
