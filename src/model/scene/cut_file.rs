//! The cut as typed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::quantities::typical_value;
use super::rule::is_default;
use super::washboarding::WashboardingFile;
use super::wood::WoodFile;

/// Forces of the wood on the teeth in the cut, fixed in space. Give the number of teeth or the depth of cut,
/// and the tangential force or the power.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutFile {
    /// Angle of the middle of the cut, positive in the direction of rotation.
    #[serde(default)]
    pub angle_deg: f64,
    /// Depth of cut, required unless `teeth_in_cut` is given; divided by the pitch of the teeth it gives the mean number of
    /// teeth in the cut, which need not be whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_m: Option<f64>,
    /// Number of teeth that cut at the same time, in place of the mean number that follows from the depth; it has
    /// precedence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teeth_in_cut: Option<u32>,
    /// Force on each tooth against the rotation, required unless `power_w` is given; it has precedence over the power.
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
    /// Feed speed of the wood; with the length of the board it determines the duration of the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_m_per_s: Option<f64>,
    /// Length of the board. Without it, or without the feed, the cut takes one second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub board_length_m: Option<f64>,
    /// Time shown before and after the cut.
    #[serde(default = "default_idle_s")]
    pub idle_s: f64,
    /// Speed of the cut whose forces, as dead loads at every speed, and wood act on the saw in all commands but `cut` and
    /// `washboard`, which have speeds of their own. By default these commands compute the idling saw.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chart_rpm: Option<f64>,
    /// Contact of the blade with the wood in the kerf. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wood: Option<WoodFile>,
    /// Force on a tooth that cuts the surface left by the preceding one, for `sawflutter washboard`. None by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub washboarding: Option<WashboardingFile>,
    /// Whether the model includes stretching of the middle surface at large deflections: then the record ends
    /// where slopes exceed 0.1, and not at five thicknesses. The criteria of growth remain linear. It takes
    /// longer.
    #[serde(default, skip_serializing_if = "is_default")]
    pub stretching: bool,
    /// Speeds of the cut, with the values that differ. By default the operating speed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub speeds: Vec<CutSpeedFile>,
}

fn default_idle_s() -> f64 {
    const { typical_value("cut.idle_s") }
}

/// A speed of the cut. Missing values are those of the cut.
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
    /// Feed speed of the wood.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_m_per_s: Option<f64>,
}
