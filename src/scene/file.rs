//! The scene as typed: the JSON that a user writes, key by key.
//!
//! Every key carries its unit. Unknown keys are refused, so that a misspelt `thicknes_m` is an error and is
//! not ignored.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cut_file::CutFile;
use super::excitation::ExcitationFile;
use super::membrane::MembraneFile;
use super::runup::{ProbeFile, RunUpFile};
use super::spline::SplineFile;
use super::thickness::{RimFile, ThicknessRow};

/// A saw and what to find out about it, as written in a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Title of reports and figures.
    pub name: String,
    /// Where the numbers come from: measured, assumed, calibrated.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// The blade.
    pub blade: BladeFile,
    /// How the bore is held.
    pub mount: Mount,
    /// Guide pads, fixed in space. None by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub guides: Vec<GuideFile>,
    /// Damping. None by default, as in the classical analysis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<DampingFile>,
    /// Membrane stress from heat, roll tension or as measured. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub membrane: Option<MembraneFile>,
    /// Contact between bore and splined arbor. Not simulated by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spline: Option<SplineFile>,
    /// Speed at which the saw is run, held against the 85 % rule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_rpm: Option<f64>,
    /// Lines of the Campbell diagram at multiples of the rotation speed. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excitation: Option<ExcitationFile>,
    /// Range of speeds; by default from rest to twice the lowest critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepFile>,
    /// Speed for accuracy.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// Relative error allowed of critical speeds and onsets, instead of a named accuracy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Growth rate from which an oscillatory band counts as flutter of the saw.
    #[serde(default = "default_flutter_threshold_per_s")]
    pub flutter_threshold_per_s: f64,
    /// Forces of the wood on the teeth, for `sawflutter cut`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cut: Option<CutFile>,
    /// Run-up under a lateral force, for `sawflutter runup`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub runup: Option<RunUpFile>,
    /// Where the deflection is read; by default at the rim, 90° past the cut.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probe: Option<ProbeFile>,
    /// Measured or published frequencies to show beside the computed ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
}

/// About the decay rate of a lightly damped steel blade; damping suppresses slower growth.
fn default_flutter_threshold_per_s() -> f64 {
    0.25
}

/// An annular blade.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BladeFile {
    /// Diameter of the rim.
    pub outer_diameter_m: f64,
    /// Diameter of the bore.
    pub inner_diameter_m: f64,
    /// Thickness of the plate; with a profile, from the bore to the first row of it.
    pub thickness_m: f64,
    /// Thickness at ascending radii, straight between the rows and constant beyond the last; two
    /// rows of one radius make a step, and so does a first row of another thickness. By default
    /// the blade has one thickness.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profile: Vec<ThicknessRow>,
    /// Number of teeth; they carry no stiffness in the model, and mass where `rim` gives it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teeth: Option<u32>,
    /// Mass of teeth or carbide tips. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim: Option<RimFile>,
    /// Linear elastic, isotropic.
    pub material: Material,
}

/// Isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio ν, −1 < ν < 0.5.
    pub poisson_ratio: f64,
    /// Density ρ.
    pub density_kg_per_m3: f64,
}

/// How the bore is held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Mount {
    /// Loose on a splined arbor: the bore is free in bending and in plane.
    Spline {},
    /// Clamped between collars: no deflection and no slope at the collar's edge.
    Collar {
        /// Diameter of the collar; the blade inside it does not move.
        diameter_m: f64,
        /// Whether the collar also holds the blade in its plane.
        in_plane: InPlane,
    },
}

/// In-plane condition at the edge of a collar. It moves critical speeds by
/// 15 % on a 400 mm blade, so there is no default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum InPlane {
    /// No radial displacement at the collar.
    Fixed,
    /// No radial stress at the collar.
    Free,
}

/// A rectangular guide pad, its sides along and across the radius at its
/// centre. Without size it is a point spring.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideFile {
    /// Distance of the pad's centre from the axis.
    pub radius_m: f64,
    /// Angle of the pad's centre, from the cut (θ = 0), positive with the rotation.
    pub angle_deg: f64,
    /// Side along the radius.
    pub radial_length_m: f64,
    /// Side across the radius.
    pub tangential_length_m: f64,
    /// Lateral stiffness of the whole pad, both faces together.
    pub stiffness_n_per_m: f64,
    /// Lateral viscous damping of the whole pad, fixed in space.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub damping_n_s_per_m: f64,
    /// Gap between the pad and a face of the blade, such as its film of water: `check` holds the static
    /// deflection in the cut against it. A linear pad acts within it all the same. Not looked at by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_m: Option<f64>,
    /// Whether the pad acts at any deflection, which is the default, or only beyond the gap.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub contact: ContactLaw,
    /// Sides of the blade on which a one-sided pad stands; both by default.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub side: GuideSide,
    /// Lateral stiffness of the whole pad inside the gap if it is one-sided, such as that of a film of water. Zero by
    /// default.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub film_stiffness_n_per_m: f64,
}

/// How a guide pad holds the blade.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ContactLaw {
    /// A spring in both directions at any deflection: a preloaded pad, or one that is carried by a film.
    #[default]
    Linear,
    /// A spring beyond the gap only, which presses and never pulls. `deflect`, `runup.stretching` and `cut.stretching`
    /// follow the contact; linear analyses such as the Campbell diagram treat the pad as linear.
    OneSided,
}

/// Sides of the blade on which a guide pad stands.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GuideSide {
    /// Both: a gap on each.
    #[default]
    Both,
    /// The side of positive deflections, which is left when looking from the cut towards the axis with θ = 90° up.
    Left,
    /// The side of negative deflections.
    Right,
}

fn is_usual<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Damping of the blade. Each number states the frame it lives in.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DampingFile {
    /// Kelvin–Voigt retardation time η of the material (turns with the blade).
    #[serde(default, skip_serializing_if = "is_zero")]
    pub material_retardation_time_s: f64,
    /// Viscous resistance of the surrounding air per area (at rest in space, unless it turns).
    #[serde(default, skip_serializing_if = "is_zero")]
    pub air_n_s_per_m3: f64,
    /// Share of the blade's speed with which this air turns: 0 for air at rest, by default; 1 for
    /// air that goes with the blade.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub air_rotation_share: f64,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
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

/// Named accuracies: the relative error allowed of critical speeds and onsets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Accuracy {
    /// 1 %, for looking around.
    Draft,
    /// 0.1 %, for designing.
    #[default]
    Design,
    /// 0.01 %, for comparing with others.
    Reference,
}

impl Accuracy {
    /// The relative error that belongs to the name.
    pub fn tolerance(self) -> f64 {
        match self {
            Accuracy::Draft => 1e-2,
            Accuracy::Design => 1e-3,
            Accuracy::Reference => 1e-4,
        }
    }
}

/// Frequencies from elsewhere, drawn over the chart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Who measured or published them.
    pub source: String,
    /// One row a speed.
    pub rows: Vec<MeasuredRow>,
}

/// Frequencies at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredRow {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequencies in the space-fixed frame, lowest first; null in the place of one that was not seen.
    pub frequencies_hz: Vec<Option<f64>>,
}

impl MeasuredRow {
    /// The measured frequencies, in Hz.
    pub fn seen_hz(&self) -> impl Iterator<Item = f64> {
        self.frequencies_hz.iter().copied().flatten()
    }
}
