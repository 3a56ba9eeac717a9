//! A guide pad as typed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::guide_arm::GuideArmFile;
use super::guide_controller::GuideControllerFile;
use super::guide_film::GuideFilmFile;
use super::rule::is_default;

/// A guide pad with one length along and one across the radius at its centre. With zero size it is a point
/// spring.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideFile {
    /// Distance of the pad's centre from the axis.
    pub radius_m: f64,
    /// Angle of the pad's centre, from the cut (θ = 0), positive in the direction of rotation.
    pub angle_deg: f64,
    /// Length along the radius.
    pub radial_length_m: f64,
    /// Length across the radius.
    pub tangential_length_m: f64,
    /// Shape of the pad; a rectangle by default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub shape: GuideShape,
    /// Lateral stiffness of the whole pad, both faces together.
    pub stiffness_n_per_m: f64,
    /// Lateral viscous damping of the whole pad, fixed in space.
    #[serde(default, skip_serializing_if = "is_default")]
    pub damping_n_s_per_m: f64,
    /// Gap between the pad and a face of the blade, such as the thickness of a film of water; `check` compares it
    /// with the static deflection in the cut. A linear pad acts as if it had no gap. Required where `contact` is one_sided,
    /// otherwise not checked by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_m: Option<f64>,
    /// Whether the pad acts at any deflection, which is the default, or only beyond the gap.
    #[serde(default, skip_serializing_if = "is_default")]
    pub contact: ContactLaw,
    /// Sides of the blade on which a one-sided pad is; both by default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub side: GuideSide,
    /// Lateral stiffness of the whole one-sided pad inside the gap, such as that of a film of water. Zero by
    /// default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub film_stiffness_n_per_m: f64,
    /// Lateral offset of the middle between the faces of a one-sided pad from the plane of the flat blade, positive in the
    /// direction of positive deflection. Zero by default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub offset_m: f64,
    /// The arm that holds the pad. By default the pad stands on the frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arm: Option<GuideArmFile>,
    /// The film between pad and blade. By default the force of the damping does not lag.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film: Option<GuideFilmFile>,
    /// A controller that acts on the pad beside its spring and damper. By default none does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub controller: Option<GuideControllerFile>,
}

/// Shape of a guide pad.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GuideShape {
    /// A rectangle with sides along and across the radius.
    #[default]
    Rectangle,
    /// An ellipse whose axes are the lengths along and across the radius: a circle if they are equal.
    Round,
}

/// Contact law of a guide pad.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactLaw {
    /// A spring in both directions at any deflection: a preloaded pad, or one with a film.
    #[default]
    Linear,
    /// A spring only beyond the gap, which presses and never pulls. `deflect`, `runup.stretching` and
    /// `cut.stretching` include the contact; linear analyses such as the Campbell diagram treat the pad as
    /// linear.
    OneSided,
}

/// Sides of the blade on which a guide pad is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GuideSide {
    /// Both sides, with a gap on each.
    #[default]
    Both,
    /// The side of positive deflections, on the left when looking from the cut towards the axis with θ = 90°
    /// up.
    Left,
    /// The side of negative deflections.
    Right,
}
