//! The speed and the range of the frequency response.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::scene::{RefusedValue, SpeedRange, rad_per_s, rpm, speed_rad_per_s};
use crate::page::text::shown;

/// Computes the steady state over the speed for the excitation of the blocks side_force and response of the scene, or for
/// a side force of 1 N. For the response between points of one's own at one speed see Matrices.response.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Speed of the frequency response from the side force to the probe, within the sweep; by default the operating speed.
    pub rpm: Option<f64>,
    /// Largest frequency of that; by default that up to which the diagram is complete.
    #[schemars(extend("x-option" = "to-frequency"))]
    pub to_hz: Option<f64>,
}

impl Options {
    /// Refuses invalid numbers.
    ///
    /// # Errors
    /// [`RefusedValue`].
    pub fn checked(&self) -> Result<(), RefusedValue> {
        // A speed of zero is allowed, because at rest the response is that of a tap test.
        if let Some(rpm) = self.rpm.filter(|rpm| *rpm != 0.0) {
            speed_rad_per_s("rpm", rpm)?;
        }
        match self.to_hz {
            Some(hz) if !(hz > 0.0 && hz <= 1e6) => {
                let remedy = "give the largest frequency in Hz, such as 500";
                Err(RefusedValue::new(
                    "to_hz",
                    hz,
                    "above 0 and at most 1e6",
                    remedy,
                ))
            }
            _ => Ok(()),
        }
    }

    /// The speed of the frequency response, which must be one of the sweep: beyond it the saw was not analysed.
    pub(super) fn speed_rad_per_s(&self, sweep: SpeedRange) -> Result<Option<f64>, RefusedValue> {
        let Some(asked) = self.rpm else {
            return Ok(None);
        };
        let speed = rad_per_s(asked);
        if !sweep.contains(speed) {
            let [from, to] = sweep.ends().map(|end| shown(rpm(end)));
            let allowed = format!("a speed of the sweep, {from} to {to} rpm");
            let remedy = "change sweep.from_rpm or sweep.to_rpm";
            return Err(RefusedValue::new("rpm", asked, allowed, remedy));
        }
        Ok(Some(speed))
    }
}
