//! The scene as typed: the JSON that a user writes, key by key.
//!
//! Every key carries its unit. Unknown keys are refused, so that a misspelt `thicknes_m` is an error and is
//! not ignored.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::blade::{BladeFile, Mount};
use super::cut_file::CutFile;
use super::damping::DampingFile;
use super::excitation::ExcitationFile;
use super::friction::FrictionFile;
use super::membrane::MembraneFile;
use super::quantities::typical_value;
use super::response::ResponseFile;
use super::rule::is_default;
use super::runup::{ProbeFile, RunUpFile};
use super::side_force::SideForceFile;
use super::spline::SplineFile;

/// A saw and the analysis, as written in a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Address of a JSON schema, by which editors check and complete the file. It has no influence here.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Title of reports and figures.
    pub name: String,
    /// Origin of the numbers: measured, assumed, calibrated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Dimensions and material of the blade.
    pub blade: BladeFile,
    /// Support of the bore.
    pub mount: Mount,
    /// Guide pads, fixed in space. None by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub guides: Vec<GuideFile>,
    /// Friction of the guides with a gap, for `sawflutter gap`. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<FrictionFile>,
    /// Damping. None by default, as in the classical analysis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<DampingFile>,
    /// Membrane stress from heat, roll tension or measurement. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub membrane: Option<MembraneFile>,
    /// Contact between bore and splined arbor, where `mount.kind` is spline. Not simulated by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spline: Option<SplineFile>,
    /// Operating speed, to which the 85 % rule applies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_rpm: Option<f64>,
    /// Lines of the Campbell diagram at multiples of the rotation speed. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excitation: Option<ExcitationFile>,
    /// Range of speeds; by default from rest to twice the first critical speed, or to the fortieth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepFile>,
    /// Accuracy by name; a lower one is faster.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// Relative error allowed for critical speeds and onsets, in place of a named accuracy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Growth rate from which on an oscillatory band counts as flutter.
    #[serde(default = "default_flutter_threshold_per_s")]
    pub flutter_threshold_per_s: f64,
    /// Forces of the wood on the teeth, for `sawflutter cut`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut: Option<CutFile>,
    /// Lateral force fixed in space. None by default; commands that need one assume 1 N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side_force: Option<SideForceFile>,
    /// Run-up under the side force, for `sawflutter runup`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub runup: Option<RunUpFile>,
    /// Shape and imbalance that turn with the blade and excite it, for `sawflutter response` and `gap`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<ResponseFile>,
    /// Point at which the deflection is read; by default at the rim at θ = 90°.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probe: Option<ProbeFile>,
    /// Measured or published frequencies to show beside the computed ones, and for `sawflutter fit`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
}

/// The damping of a real saw, which a scene may omit, suppresses slower growth.
fn default_flutter_threshold_per_s() -> f64 {
    const { typical_value("flutter_threshold_per_s") }
}

/// A guide pad with one length along and one across the radius at its centre. With zero size it is a point
/// spring.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
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

/// Range of rotation speeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepFile {
    /// First speed.
    #[serde(default)]
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
}

/// Named accuracies: the relative error allowed for critical speeds and onsets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Accuracy {
    /// 1 %, for exploration.
    Draft,
    /// 0.1 %, for design.
    #[default]
    Design,
    /// 0.01 %, for comparison with other results.
    Reference,
}

impl Accuracy {
    /// Relative error of critical speeds and onsets that this accuracy allows.
    pub fn tolerance(self) -> f64 {
        match self {
            Accuracy::Draft => 1e-2,
            Accuracy::Design => 1e-3,
            Accuracy::Reference => 1e-4,
        }
    }
}

/// Frequencies from another source, shown in the Campbell diagram.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Source of the frequencies.
    pub source: String,
    /// One row for each speed.
    pub rows: Vec<MeasuredRow>,
}

/// Frequencies at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredRow {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequencies in the space-fixed frame, ascending; null for one that was not measured.
    pub frequencies_hz: Vec<Option<f64>>,
}

impl MeasuredRow {
    /// The measured frequencies, in Hz.
    pub fn seen_hz(&self) -> impl Iterator<Item = f64> {
        self.frequencies_hz.iter().copied().flatten()
    }
}
