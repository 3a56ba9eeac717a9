//! Rolled bands, by their eigenstrain or by the groove of the rolls.
//!
//! Plastic flow conserves volume: a groove of depth d on each face of a blade of thickness h has the strain
//! ε_z = −2d/h through the thickness, and ε_r + ε_θ = 2d/h in the plane. Between a narrow band of radius R and the rim the
//! stress depends on this sum, and on the difference ε_θ − ε_r only by the share (a/R)² of a bore of radius a. The difference
//! changes the stress within the band and between band and bore. It depends on the rolls and is not known for a blade, so
//! that both parts are taken to be equal.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::quantity;
use super::rule::refuse;
use super::{Blade, RefusedValue, SceneError};
use crate::page::text::shown;

/// A rolled band. Rolling reduces its thickness, so that it would expand in its plane; the surrounding metal
/// restrains it and is stretched along the rim.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RollBandFile {
    /// Radius of the middle of the band.
    pub radius_m: f64,
    /// Width along the radius.
    pub width_m: f64,
    /// In-plane strain that the band would have if it were free, isotropic; positive for rolling. Give either this or
    /// `groove_depth_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub eigenstrain: Option<f64>,
    /// Depth of the groove on each face, in place of `eigenstrain`, which is then this depth over the thickness of the blade at
    /// this radius: the displaced volume remains in the band, in equal parts along and across the groove.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub groove_depth_m: Option<f64>,
}

/// Validated rolled band, from its inner to its outer edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RollBand {
    /// Radius of the inner edge.
    pub from_radius_m: f64,
    /// Radius of the outer edge.
    pub to_radius_m: f64,
    /// In-plane eigenstrain, isotropic.
    pub eigenstrain: f64,
}

const MAX_EIGENSTRAIN: f64 = quantity("membrane.roll_tension[].eigenstrain").allowed.to;
/// Share of the displaced volume in each of the two directions in the plane. Rolls that are wide in comparison with the
/// length of their contact lengthen the metal along the groove (0 across), and the blade, which resists this lengthening on
/// both sides, directs the flow across (0 along); equal parts are between the two.
const SHARE: f64 = 0.5;

/// Relation of the depth of a groove to its eigenstrain at one radius of the blade.
pub(crate) struct Groove {
    thickness_m: f64,
}

impl Groove {
    /// The relation at a radius.
    pub fn at(blade: &Blade, radius_m: f64) -> Self {
        Groove {
            thickness_m: blade.thickness_m * blade.thickness_ratio(radius_m),
        }
    }

    /// In-plane eigenstrain of a groove with this depth on each face.
    pub fn eigenstrain(&self, depth_m: f64) -> f64 {
        SHARE * 2.0 * depth_m / self.thickness_m
    }

    /// Depth on each face of the groove with this eigenstrain; negative for a band that is thicker than the blade.
    pub fn depth_m(&self, eigenstrain: f64) -> f64 {
        eigenstrain * self.thickness_m / (2.0 * SHARE)
    }
}

impl RollBand {
    pub(super) fn new(
        index: usize,
        typed: &RollBandFile,
        blade: &Blade,
    ) -> Result<Self, SceneError> {
        let key = |name: &str| format!("membrane.roll_tension[{index}].{name}");
        let (radius, width) = (typed.radius_m, typed.width_m);
        let (from_radius_m, to_radius_m) = (radius - 0.5 * width, radius + 0.5 * width);
        let (inner, outer) = (blade.inner_radius_m, blade.outer_radius_m);
        if from_radius_m < inner || to_radius_m > outer {
            let allowed = format!(
                "such that its band lies on the blade, from {} to {}",
                shown(inner),
                shown(outer)
            );
            let remedy = "roll the moving part of the blade; is width_m the whole width?";
            return Err(refuse(&key("radius_m"), radius, allowed, remedy));
        }
        let groove = Groove::at(blade, radius);
        let eigenstrain = match (typed.eigenstrain, typed.groove_depth_m) {
            (Some(eigenstrain), None) => eigenstrain,
            (None, Some(depth)) => {
                let deepest = groove.depth_m(MAX_EIGENSTRAIN);
                if depth > deepest {
                    let allowed = format!(
                        "between 0 and {}, a twentieth of the thickness of the blade",
                        shown(deepest)
                    );
                    let remedy = "give the depth of the groove on one face, in m";
                    return Err(refuse(&key("groove_depth_m"), depth, allowed, remedy));
                }
                groove.eigenstrain(depth)
            }
            (eigenstrain, _) => {
                let given = match eigenstrain {
                    Some(_) => "both",
                    None => "neither",
                };
                let remedy = "give one of them, and null for the other";
                let key = format!("membrane.roll_tension[{index}]");
                let allowed = "given by eigenstrain or by groove_depth_m";
                return Err(RefusedValue::new(key, given, allowed, remedy).into());
            }
        };
        Ok(RollBand {
            from_radius_m,
            to_radius_m,
            eigenstrain,
        })
    }

    /// Radius of the middle of the band.
    pub fn middle_m(&self) -> f64 {
        0.5 * (self.from_radius_m + self.to_radius_m)
    }
}
