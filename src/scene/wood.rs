//! The wood that touches the blade in the kerf.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::refuse;
use super::teeth_in_cut::TeethInCut;
use super::{Blade, SceneError};
use crate::text::shown;

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

/// Validated wood in the kerf.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wood {
    /// Angle of the middle of the contact.
    pub angle_rad: f64,
    /// Angle that the contact spans.
    pub arc_rad: f64,
    /// Extent from the rim towards the axis; zero for contact along the rim only.
    pub depth_m: f64,
    /// Stiffness of the whole contact.
    pub stiffness_n_per_m: f64,
    /// Damping of the whole contact.
    pub damping_n_s_per_m: f64,
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
        let wood = Wood {
            angle_rad: teeth.angle_rad,
            arc_rad: teeth.arc_rad(typed.arc_deg),
            depth_m: typed.depth_m,
            stiffness_n_per_m: typed.stiffness_n_per_m,
            damping_n_s_per_m: typed.damping_n_s_per_m,
        };
        let any = wood.stiffness_n_per_m > 0.0 || wood.damping_n_s_per_m > 0.0;
        Ok(any.then_some(wood))
    }
}
