//! The run-up, and the probe at which its deflection is read.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::is_default;
use super::speed_range::check_rise;
use super::{Blade, SceneError, SpeedRange};

/// Run-up at a constant rate, under the constant force of `side_force`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunUpFile {
    /// First speed.
    #[serde(default)]
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Duration of the run-up.
    pub duration_s: f64,
    /// Whether the model includes stretching of the middle surface at large deflections: then the record ends
    /// where slopes exceed 0.1, and not at five thicknesses. It takes longer.
    #[serde(default, skip_serializing_if = "is_default")]
    pub stretching: bool,
}

/// Point at which the deflection is read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProbeFile {
    /// Distance from the axis; the rim by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Angle, positive in the direction of rotation.
    pub angle_deg: f64,
}

/// The paper's position of the displacement probe, section 3.1.
pub(super) const DEFAULT_PROBE_DEG: f64 = 90.0;

impl RunUpFile {
    /// Checks that the speed rises.
    pub(super) fn checked(&self) -> Result<(), SceneError> {
        let remedy = "a run-up goes from a lower to a higher speed";
        check_rise("runup", self.from_rpm, self.to_rpm, remedy)
    }

    /// Range of speeds.
    pub fn speeds(&self) -> SpeedRange {
        SpeedRange::between_rpm(self.from_rpm, self.to_rpm)
    }

    /// Rate Ω̇ at which the rotation speed rises, in rad/s².
    pub fn acceleration_rad_per_s2(&self) -> f64 {
        let speeds = self.speeds();
        (speeds.to_rad_per_s - speeds.from_rad_per_s) / self.duration_s
    }
}

impl ProbeFile {
    /// Checks that the probe is over the moving part of the blade.
    pub(super) fn checked(&self, blade: &Blade) -> Result<(), SceneError> {
        let remedy = "put the probe over the moving part of the blade";
        let radius_m = self.radius_m.unwrap_or(blade.outer_radius_m);
        blade.check_on("probe.radius_m", radius_m, remedy)
    }
}
