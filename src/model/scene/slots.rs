//! Slots of the rim.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::refuse;
use super::{RefusedValue, SceneError};
use crate::page::text::shown_to;

/// Radial slots, equal and evenly spaced, from the rim inwards.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlotsFile {
    /// Number of slots.
    pub count: u32,
    /// Distance from the rim to the end of a slot.
    pub depth_m: f64,
    /// Width of a slot. Slots are cuts of width zero in the model; a width of 1 mm changes frequencies by 1 %, so that no larger one
    /// is allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// Angle between a slot and the radius. Slots are radial in the model; 20° changes frequencies by 1 %, so that no larger angle is
    /// allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inclination_deg: Option<f64>,
    /// Diameter of the hole at the end of a slot. Holes are not modelled yet, so that only 0 is allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hole_diameter_m: Option<f64>,
}

impl SlotsFile {
    /// Angles of the slots at the moment at which one of them is at 0°.
    pub(crate) fn angles_rad(&self) -> impl Iterator<Item = f64> + use<> {
        let pitch = std::f64::consts::TAU / f64::from(self.count);
        (0..self.count).map(move |k| f64::from(k) * pitch)
    }
}

/// Validated slots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slots {
    /// Number of slots.
    pub count: u32,
    /// Distance from the rim to the end of a slot.
    pub depth_m: f64,
}

/// Which branch of the pairs of waves that slots split stands for both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SplitBranch {
    /// The lower one, of which the critical speeds are the lower ones.
    #[default]
    Lower,
    /// The mean of both squares of the frequency.
    Mean,
    /// The upper one.
    Upper,
}

/// Depths of slots, in shares of the width of the moving ring.
const DEPTHS: [f64; 2] = [0.005, 0.9];
/// Least arc of the rim between two slots, in thicknesses of the blade and in widths of a slot.
const LEAST_SPACING: f64 = 2.0;

/// The moving ring that has slots.
pub(super) struct SlottedRing {
    /// Radii of its inner edge and of the rim.
    pub radii_m: [f64; 2],
    /// Its thickness.
    pub thickness_m: f64,
    /// Whether the scene has stress of heat, rolling or manufacture.
    pub has_membrane: bool,
}

impl Slots {
    /// Validates the slots of a ring.
    pub(super) fn new(typed: SlotsFile, ring: &SlottedRing) -> Result<Self, SceneError> {
        let ([inner, outer], thickness_m) = (ring.radii_m, ring.thickness_m);
        let [least, most] = DEPTHS.map(|share| share * (outer - inner));
        if !(least..=most).contains(&typed.depth_m) {
            let allowed = format!(
                "{} to {} m, from {} to {} of the width of the moving ring",
                shown_to(3, least),
                shown_to(3, most),
                DEPTHS[0],
                DEPTHS[1]
            );
            let remedy = "give the distance from the rim to the end of the slot in metres, or leave blade.slots out";
            return Err(refuse(
                "blade.slots.depth_m",
                typed.depth_m,
                allowed,
                remedy,
            ));
        }
        let spacing = std::f64::consts::TAU * (outer - typed.depth_m) / f64::from(typed.count);
        if spacing < LEAST_SPACING * thickness_m {
            let most = (f64::from(typed.count) * spacing / (LEAST_SPACING * thickness_m)).floor();
            let allowed = format!(
                "at most {}, so that the ends of slots are {LEAST_SPACING} thicknesses apart",
                shown_to(4, most)
            );
            let remedy = "give the number of slots, not that of teeth";
            return Err(refuse(
                "blade.slots.count",
                f64::from(typed.count),
                allowed,
                remedy,
            ));
        }
        if let Some(width) = typed
            .width_m
            .filter(|width| spacing < LEAST_SPACING * width)
        {
            let allowed = format!(
                "at most {}, half the distance of two slots",
                shown_to(3, spacing / LEAST_SPACING)
            );
            let remedy = "give the width of one slot in metres";
            return Err(refuse("blade.slots.width_m", width, allowed, remedy));
        }
        if let Some(hole) = typed.hole_diameter_m.filter(|hole| *hole > 0.0) {
            let allowed = "0 or left out: holes at the ends of slots are not modelled yet";
            let remedy = "leave the hole out, and count on critical speeds 2 to 7 % lower than computed for one of 8 mm";
            return Err(refuse("blade.slots.hole_diameter_m", hole, allowed, remedy));
        }
        if ring.has_membrane {
            let allowed = "left out beside blade.slots: heat, roll tension and residual stress of a slotted blade are not modelled yet";
            let remedy =
                "leave out membrane or blade.slots; slots take most of the hoop stress at the rim";
            return Err(RefusedValue::new("membrane", "given", allowed, remedy).into());
        }
        Ok(Slots {
            count: typed.count,
            depth_m: typed.depth_m,
        })
    }
}
