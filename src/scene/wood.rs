//! The wood that touches the blade in the kerf.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::{MAX_GUIDE, refuse, within};
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
        let key = |name: &str| format!("cut.wood.{name}");
        let width = blade.outer_radius_m - blade.inner_radius_m;
        let arc_rad = teeth.arc_rad(&key("arc_deg"), typed.arc_deg)?;
        if !(0.0..=width).contains(&typed.depth_m) {
            let allowed = format!("from 0 to the width of the moving ring ({})", shown(width));
            let remedy = "give the distance from the rim to which the wood touches the blade";
            return Err(refuse(&key("depth_m"), typed.depth_m, allowed, remedy));
        }
        let range = (0.0, MAX_GUIDE);
        let wood = Wood {
            angle_rad: teeth.angle_rad,
            arc_rad,
            depth_m: typed.depth_m,
            stiffness_n_per_m: within(&key("stiffness_n_per_m"), typed.stiffness_n_per_m, range)?,
            damping_n_s_per_m: within(&key("damping_n_s_per_m"), typed.damping_n_s_per_m, range)?,
        };
        let any = wood.stiffness_n_per_m > 0.0 || wood.damping_n_s_per_m > 0.0;
        Ok(any.then_some(wood))
    }
}
