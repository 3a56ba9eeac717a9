//! The lateral force on the blade, fixed in space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::typical_value;
use super::rule::is_default;
use super::{Blade, Point, RefusedValue, SceneError};

/// Lateral force at a point fixed in space, constant and oscillating. `deflect` and `runup` compute with the constant force, by default
/// 1 N; so do `response`, `gap`, `place`, studies of guides with a gap and every deviation of the board, by default with the mean lateral
/// force of the cut, without a cut 1 N; `response` and `gap` also with the oscillating one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideForceFile {
    /// Constant force, positive in the direction of positive deflections.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_n: Option<f64>,
    /// Distance of the force from the axis; the rim by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Angle of the force, positive in the direction of rotation; by default that of the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Amplitude of a force at the same point that oscillates, for `response` and `gap`.
    #[serde(default, skip_serializing_if = "is_default")]
    pub oscillating_n: f64,
    /// Ratio of its frequency to that of rotation; 1, once a turn, by default. The number of teeth is the tooth passing frequency.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<u32>,
}

/// The constant side force and its place, given or assumed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SideForce {
    /// Force in the direction of positive deflections.
    pub force_n: f64,
    /// Point on which it acts.
    pub at: Point,
}

/// A side force that oscillates with a multiple of the rotation frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OscillatingForce {
    /// Amplitude of the force.
    pub amplitude_n: f64,
    /// Ratio of its frequency to that of rotation.
    pub order: u32,
}

/// Side force of a scene that has none.
pub(crate) const USUAL_SIDE_FORCE_N: f64 = typical_value("side_force.force_n");

impl SideForceFile {
    /// A constant force at the rim at the cut.
    pub fn of(force_n: f64) -> Self {
        SideForceFile {
            force_n: Some(force_n),
            ..SideForceFile::default()
        }
    }

    /// Checks the place of the force, and that an order belongs to a force.
    pub(super) fn checked(&self, blade: &Blade) -> Result<(), SceneError> {
        if let Some(radius_m) = self.radius_m {
            let remedy = "put the force on the moving part of the blade";
            blade.check_on("side_force.radius_m", radius_m, remedy)?;
        }
        if self.order.is_some() && self.oscillating_n == 0.0 {
            let allowed = "given where side_force.order is";
            let remedy = "give the amplitude of the oscillating force, such as 2";
            return Err(RefusedValue::missing("side_force.oscillating_n", allowed, remedy).into());
        }
        Ok(())
    }
}
