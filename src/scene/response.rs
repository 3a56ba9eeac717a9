//! Excitation of the steady-state response.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::{is_default, refuse};
use super::{Blade, SceneError};

/// Excitation of the steady-state response, for `sawflutter response`. Causes that are 0 are absent.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseFile {
    /// Constant lateral force, fixed in space.
    #[serde(default, skip_serializing_if = "is_default")]
    pub force_n: f64,
    /// Distance of the force from the axis; the rim by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Angle of the force, positive in the direction of rotation.
    #[serde(default, skip_serializing_if = "is_default")]
    pub angle_deg: f64,
    /// Run-out of the rim: amplitude of one wave around it, of the blade at rest without guides. It turns with the blade and
    /// excites at the rotation frequency.
    #[serde(default, skip_serializing_if = "is_default")]
    pub runout_m: f64,
    /// Lack of flatness at the rim: amplitude of two waves around it, of the blade at rest without guides. It excites at twice
    /// the rotation frequency.
    #[serde(default, skip_serializing_if = "is_default")]
    pub flatness_m: f64,
    /// Imbalance at the rim beside the middle plane: mass times rim radius times distance from the middle plane. It excites at
    /// the rotation frequency and its double; an imbalance in the middle plane does not bend the blade.
    #[serde(default, skip_serializing_if = "is_default")]
    pub imbalance_kg_m2: f64,
    /// Amplitude of the lateral force at the rim at the cut with the tooth passing frequency.
    #[serde(default, skip_serializing_if = "is_default")]
    pub tooth_force_n: f64,
}

impl ResponseFile {
    /// Whether anything excites the blade.
    pub fn excites(&self) -> bool {
        let causes = [
            self.force_n,
            self.runout_m,
            self.flatness_m,
            self.imbalance_kg_m2,
            self.tooth_force_n,
        ];
        causes.iter().any(|cause| *cause != 0.0)
    }

    /// Checks the place of the force, and that the blade has teeth if they excite it.
    pub(super) fn checked(&self, blade: &Blade, teeth: Option<u32>) -> Result<(), SceneError> {
        if let Some(radius_m) = self.radius_m {
            let remedy = "put the force on the moving part of the blade";
            blade.check_on("response.radius_m", radius_m, remedy)?;
        }
        if self.tooth_force_n != 0.0 && teeth.is_none_or(|teeth| teeth == 0) {
            let allowed = "0 in a scene without blade.teeth";
            let remedy = "give the number of teeth in blade.teeth";
            return Err(refuse(
                "response.tooth_force_n",
                self.tooth_force_n,
                allowed,
                remedy,
            ));
        }
        Ok(())
    }
}
