//! The wood that touches the blade in the kerf.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::refuse;
use super::teeth_in_cut::TeethInCut;
use super::{Blade, SceneError};
use crate::page::text::shown;

/// Wood in the kerf, a spring and a damper fixed in space around the middle of the cut.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WoodFile {
    /// Lateral stiffness of the whole contact, both faces of the blade together.
    #[serde(default)]
    pub stiffness_n_per_m: f64,
    /// Lateral viscous damping of the whole contact.
    #[serde(default)]
    pub damping_n_s_per_m: f64,
    /// Extent of the contact from the rim towards the axis; by default it is an arc of the rim.
    #[serde(default)]
    pub depth_m: f64,
    /// Arc of the contact; by default that of the teeth in the cut, one pitch for each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arc_deg: Option<f64>,
}

/// Wood in the kerf, or another contact on an arc of the rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wood {
    /// The contact as typed.
    pub typed: WoodFile,
    /// The teeth, around the middle of whose cut it lies.
    pub teeth: TeethInCut,
}

impl Wood {
    /// Validates the contact; `None` if it has neither stiffness nor damping.
    pub(super) fn new(
        typed: &WoodFile,
        teeth: &TeethInCut,
        blade: &Blade,
    ) -> Result<Option<Self>, SceneError> {
        let width = blade.outer_radius_m - blade.inner_radius_m;
        if typed.depth_m > width {
            let allowed = format!("at most the width of the moving ring ({})", shown(width));
            let remedy = "give the distance from the rim to which the wood touches the blade";
            return Err(refuse("cut.wood.depth_m", typed.depth_m, allowed, remedy));
        }
        let any = typed.stiffness_n_per_m > 0.0 || typed.damping_n_s_per_m > 0.0;
        Ok(any.then_some(Wood {
            typed: *typed,
            teeth: *teeth,
        }))
    }

    /// Angle that the contact spans.
    pub fn arc_rad(&self) -> f64 {
        let given = self.typed.arc_deg.map(f64::to_radians);
        given.unwrap_or(self.teeth.arc_rad())
    }
}
