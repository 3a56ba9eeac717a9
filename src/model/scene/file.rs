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
use super::guide_file::{ContactLaw, GuideFile};
use super::limits::LimitsFile;
use super::membrane::MembraneFile;
use super::quantities::typical_value;
use super::response::ResponseFile;
use super::runup::{ProbeFile, RunUpFile};
use super::side_force::{SideForceFile, USUAL_SIDE_FORCE_N};
use super::spline::SplineFile;
use crate::page::text::shown_to;

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
    /// Limits that the saw has to keep; by default those of practice.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitsFile>,
    /// Lines of the Campbell diagram at multiples of the rotation speed. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excitation: Option<ExcitationFile>,
    /// Range of speeds; by default from rest to twice the first critical speed, or past an operating speed of up to three times the first critical speed, or to the fortieth.
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

impl SceneFile {
    /// Constant side force in N: the given one, or 1 N.
    pub fn side_force_n(&self) -> f64 {
        let typed = self.side_force.and_then(|typed| typed.force_n);
        typed.unwrap_or(USUAL_SIDE_FORCE_N)
    }

    /// Whether a guide touches the blade only beyond a gap.
    pub(crate) fn has_gaps(&self) -> bool {
        let mut guides = self.guides.iter();
        guides.any(|guide| guide.contact == ContactLaw::OneSided)
    }

    /// Place of the side force for a reader: "at the cut", or like "at the rim at 30°".
    pub(crate) fn side_force_place_in_words(&self) -> String {
        let typed = self.side_force.unwrap_or_default();
        let radius = match typed.radius_m {
            None => "the rim".to_owned(),
            Some(radius_m) => format!("{} m", shown_to(4, radius_m)),
        };
        let angle_deg = typed.angle_deg.unwrap_or(self.cut_angle_deg());
        let is_in_cut = self.cut.is_some() && angle_deg == self.cut_angle_deg();
        if typed.radius_m.is_none() && is_in_cut {
            "at the cut".to_owned()
        } else {
            format!("at {radius} at {}°", shown_to(4, angle_deg))
        }
    }

    /// Angle of the middle of the cut; without a cut, zero, the direction from which angles are counted.
    pub(crate) fn cut_angle_deg(&self) -> f64 {
        self.cut.as_ref().map_or(0.0, |cut| cut.angle_deg)
    }
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
    /// Number of nodal diameters of each frequency, for a row at rest. Without it the frequencies ascend from the lowest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameters: Option<Vec<u32>>,
    /// Frequencies in the space-fixed frame, ascending; null for one that was not measured.
    pub frequencies_hz: Vec<Option<f64>>,
}

impl MeasuredRow {
    /// The measured frequencies, in Hz.
    pub fn seen_hz(&self) -> impl Iterator<Item = f64> {
        self.frequencies_hz.iter().copied().flatten()
    }
}
