//! The lateral force on the blade, fixed in space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::typical_value;
use super::rule::is_default;
use super::{Blade, Point, RefusedValue, Scene, SceneError, SceneFile};
use crate::page::text::shown_to;

/// Lateral force at a point fixed in space, constant and oscillating. `deflect`, `runup`, `gap`, `place` and studies of guides with
/// a gap compute with the constant force, by default 1 N, `response` and `gap` also with the oscillating one.
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

impl SceneFile {
    /// Constant side force in N: the given one, or 1 N.
    pub fn side_force_n(&self) -> f64 {
        let typed = self.side_force.and_then(|typed| typed.force_n);
        typed.unwrap_or(USUAL_SIDE_FORCE_N)
    }

    /// Place of the side force for a reader: "at the cut", or like "at the rim at 30°".
    pub(crate) fn side_force_place_in_words(&self) -> String {
        let typed = self.side_force.unwrap_or_default();
        let radius = match typed.radius_m {
            None => "the rim".to_owned(),
            Some(radius_m) => format!("{} m", shown_to(4, radius_m)),
        };
        let angle_deg = typed.angle_deg.unwrap_or(self.cut_angle_deg());
        let is_in_cut = self.cut.is_some() && angle_deg == self.cut_angle_deg();
        if typed.radius_m.is_none() && is_in_cut {
            "at the cut".to_owned()
        } else {
            format!("at {radius} at {}°", shown_to(4, angle_deg))
        }
    }

    /// Angle of the middle of the cut; without a cut, zero, the direction from which angles are counted.
    pub(crate) fn cut_angle_deg(&self) -> f64 {
        self.cut.as_ref().map_or(0.0, |cut| cut.angle_deg)
    }
}

impl Scene {
    /// The constant side force, given or assumed.
    pub(crate) fn side_force(&self) -> SideForce {
        let typed = self.file.side_force.unwrap_or_default();
        SideForce {
            force_n: self.file.side_force_n(),
            at: Point {
                radius_m: typed.radius_m.unwrap_or(self.blade.outer_radius_m),
                angle_deg: typed.angle_deg.unwrap_or(self.file.cut_angle_deg()),
            },
        }
    }

    /// The oscillating side force, if there is one.
    pub(crate) fn oscillating_force(&self) -> Option<OscillatingForce> {
        let typed = self.file.side_force?;
        (typed.oscillating_n != 0.0).then_some(OscillatingForce {
            amplitude_n: typed.oscillating_n,
            order: typed.order.unwrap_or(1),
        })
    }
}
