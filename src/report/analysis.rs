//! The report of an analysis.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::accuracy::{AccuracyEntry, WorkEntry};
use super::certificate::CertificateEntry;
use super::chart::{CampbellEntry, RootLociEntry};
use super::critical_speed::CriticalSpeedEntry;
use super::event_shape::EventShapeEntry;
use super::excitation::ExcitationEntry;
use super::in_cut::InCutEntry;
use super::instability::InstabilityEntry;
use super::membrane::MembraneEntry;
use super::operating::OperatingEntry;
use super::resting::RestMode;
use super::sensitivity::SensitivityEntry;
use super::whirl::WhirlEntry;
use crate::scene::SceneFile;

/// Report of an analysis (`report.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Terms of the equation of motion that were assembled.
    pub terms: Vec<String>,
    /// Lowest oscillating modes of the blade at rest, ascending.
    pub modes_at_rest: Vec<RestMode>,
    /// Number of modes at rest that decay without oscillating (overdamped), at rates up to 2π
    /// `campbell.complete_to_hz`; they are not listed.
    #[serde(default)]
    pub overdamped_modes_at_rest: usize,
    /// Every critical speed up to the end of the sweep, ascending.
    pub critical_speeds: Vec<CriticalSpeedEntry>,
    /// Whether `critical_speeds` are those of the saw without its damping: with damping that turns with the
    /// blade no eigenvalue of the damped saw is zero at any speed.
    #[serde(default)]
    pub critical_speeds_without_damping: bool,
    /// Bands of instability within the sweep, by onset; `certificate` gives the share of the sweep that is
    /// proven to have no others.
    pub instabilities: Vec<InstabilityEntry>,
    /// Flutter speed: lowest speed at which flutter counts, see `counted_rpm` of the bands.
    pub flutter_speed_rpm: Option<f64>,
    /// Onset of the first flutter band, including weak ones.
    pub first_merge_rpm: Option<f64>,
    /// Growth rate from which on a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// The forces of the cut in the diagram, and the idling saw, if the scene requests it.
    #[serde(default)]
    pub in_cut: Option<InCutEntry>,
    /// Multiples of the rotation speed and their crossings with natural frequencies, if the scene requests
    /// them.
    #[serde(default)]
    pub excitation: Option<ExcitationEntry>,
    /// Comparison of the operating speed with the 85 % rule, if the scene has an operating speed.
    pub operating: Option<OperatingEntry>,
    /// Modes at one speed, on request.
    pub whirl: Option<WhirlEntry>,
    /// Shapes of the blade at every critical speed, at the peak of every band, at the operating speed and at
    /// further speeds, on request.
    #[serde(default)]
    pub shapes: Vec<EventShapeEntry>,
    /// Size of the basis and estimated errors.
    pub accuracy: AccuracyEntry,
    /// Number of eigenproblems solved.
    pub work: WorkEntry,
    /// Checks of the list of bands: the share of the sweep that is proven to have no unlisted instability,
    /// intervals that were searched without proof, and disagreements.
    pub certificate: CertificateEntry,
    /// Branches over speed.
    pub campbell: CampbellEntry,
    /// Eigenvalues of the two modes that coalesce at the flutter speed, or else at the onset of the first
    /// flutter band, over the speeds around it.
    pub root_loci: Option<RootLociEntry>,
    /// Stress of heat, roll tension and manufacture, if the scene has any.
    pub membrane: Option<MembraneEntry>,
    /// Derivatives of critical speeds and onsets by numbers of the scene, on request.
    pub sensitivities: Vec<SensitivityEntry>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}
