//! The cut as typed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::runup::is_false;
use super::washboarding::WashboardingFile;
use super::wood::WoodFile;

/// Forces of the wood on the teeth in the cut, fixed in space. Give the number of teeth,
/// or the depth of cut; the tangential force, or the power.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutFile {
    /// Angle of the middle of the cut, positive with the rotation.
    #[serde(default)]
    pub angle_deg: f64,
    /// Depth of cut; over the pitch of the teeth it gives their number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_m: Option<f64>,
    /// Number of teeth in the cut at a time; wins over the depth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teeth_in_cut: Option<u32>,
    /// Force against the rotation on each tooth; wins over the power.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_n_per_tooth: Option<f64>,
    /// Force towards the axis on each tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radial_n_per_tooth: Option<f64>,
    /// Force across the blade on each tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_n_per_tooth: Option<f64>,
    /// Power of the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_w: Option<f64>,
    /// Speed at which the wood is fed; with the length of the board it tells how long
    /// the cut takes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_m_per_s: Option<f64>,
    /// Length of the board. Without it, or without the feed, the cut takes one second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub board_length_m: Option<f64>,
    /// Time shown before and after the cut.
    #[serde(default = "default_idle_s")]
    pub idle_s: f64,
    /// Speed of the cut whose forces bear on the saw in `analyze`, `check`, `fit`, `place` and
    /// `study`, whatever the speed there: a dead load. By default they look at the idling saw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chart_rpm: Option<f64>,
    /// The wood that leans against the blade in the kerf. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wood: Option<WoodFile>,
    /// The force on a tooth that cuts the surface left by the one before, for
    /// `sawflutter washboard`. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub washboarding: Option<WashboardingFile>,
    /// Whether the blade stretches where it bends by more than a part of its thickness: then the record does not end
    /// at five thicknesses, but where slopes exceed 0.1. What says whether a motion grows stays linear. It takes longer.
    #[serde(default, skip_serializing_if = "is_false")]
    pub stretching: bool,
    /// Speeds at which the saw cuts, and what differs there. By default the operating
    /// speed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub speeds: Vec<CutSpeedFile>,
}

fn default_idle_s() -> f64 {
    0.5
}

/// A speed at which the saw cuts. What is not given is that of the cut.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutSpeedFile {
    /// Rotation speed.
    pub rpm: f64,
    /// Force against the rotation on each tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_n_per_tooth: Option<f64>,
    /// Force towards the axis on each tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radial_n_per_tooth: Option<f64>,
    /// Force across the blade on each tooth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_n_per_tooth: Option<f64>,
    /// Power of the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_w: Option<f64>,
    /// Speed at which the wood is fed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_m_per_s: Option<f64>,
}
