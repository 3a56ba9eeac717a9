//! The report: the results for a saw, complete enough to draw every figure from it alone.
//!
//! Reports are made from an [`Analysis`](crate::stability::Analysis), a [`Check`](crate::check::Check), a
//! fit, a placement or the history of a cut, and are written as JSON with speeds in rpm, frequencies in Hz
//! and growth rates in 1/s. The contents of a report are computed before it is made; only [`WhirlEntry`],
//! [`EventShapeEntry`] and [`SensitivityEntry`] are computed on request and added.

mod branches;
mod build;
mod certificate;
mod chart;
mod check;
mod compare;
mod csv;
mod cut;
mod deflect;
mod event_shape;
mod excitation;
mod fit;
mod gap;
mod gap_oscillation;
mod in_cut;
mod map;
mod membrane;
mod mode;
mod place;
mod remarks;
mod response;
mod resting;
mod runup;
mod saturated;
mod spline;
mod vtu;
mod washboard;
mod whirl;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::certificate::{CertificateEntry, MiscountEntry, MismatchEntry};
pub use self::chart::{BranchEntry, CampbellEntry, RootLociEntry, RootPathEntry};
pub use self::check::{CheckReport, CriterionEntry, RimStiffnessEntry};
pub use self::compare::{CompareReport, ComparedEntry, DifferenceEntry, over_common_speeds};
pub use self::cut::{
    ByPowerEntry, CutCertificateEntry, CutCriterion, CutCriterionEntry, CutReport, CutRunEntry,
    CutVerdict, ToothPassingEntry, Verdict, VerdictMapEntry,
};
pub use self::deflect::{
    ArcEntry, DeflectReport, EquilibriumCurveEntry, JumpEntry, SlowSweepEntry, TurnEntry,
};
pub use self::event_shape::{EventShapeEntry, ShapeOccasion};
pub use self::excitation::{CrossingEntry, ExcitationEntry, ExcitationLineEntry};
pub use self::fit::{FitReport, ParameterEntry, ResidualEntry};
pub use self::gap::{
    AtAmplitudeEntry, BasisErrorEntry, DeviationEntry, FrictionEntry, FrictionPadEntry, GapReport,
};
pub use self::gap_oscillation::{
    OscillationAtEntry, OscillationEntry, OscillationLineEntry, OscillationPadEntry,
    OscillationPlaceEntry,
};
pub use self::in_cut::{IdlingEntry, InCutEntry};
pub use self::map::{ContourEntry, ContouredEntry, MapAxisEntry, MapReport, MappedSawEntry};
pub use self::membrane::{
    HeatCurveEntry, HeatEntry, HeatLimitEntry, MeasuredGapEntry, MembraneEntry, RollBandEntry,
    StraightEdgeEntry,
};
pub use self::mode::{ComplexEntry, ModeEntry, WaveEntry};
pub use self::place::{
    FragileOptimumEntry, GoalEntry, MapEntry, NeighbourEntry, OutcomeEntry, PlaceCertificateEntry,
    PlaceReport, PlacedEntry,
};
pub(crate) use self::remarks::side_force_in_words;
pub use self::response::{
    CauseEntry, FrequencyResponseEntry, OperatingResponseEntry, ResonanceEntry, ResponseLineEntry,
    ResponseReport,
};
pub use self::resting::{HarmonicEntry, RestMode, ShapeEntry};
pub use self::runup::{ResponseEntry, RunUpBand, RunUpReport, StretchingEntry};
pub use self::spline::SplineEntry;
pub use self::vtu::VTK_NAMES;
pub use self::washboard::{LobesEntry, WashboardModeEntry, WashboardReport};
pub use self::whirl::{WhirlEntry, WhirlMode};
use crate::scene::{Accuracy, SceneFile};
pub use crate::spectrum::Direction;
pub use crate::stability::{InstabilityKind, StabilityState};

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

/// A speed at which a wave stands still in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalSpeedEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Number of the branch that stands still, if the diagram shows it.
    pub branch: Option<usize>,
    /// The wave that stands still: "2 diameters", or the shares of waves if none dominates, "3 (52 %) + 2 (41
    /// %)". The branch is named by its mode at rest, which may differ.
    pub name: String,
    /// Nodal diameters of that wave, or of the one with the largest share.
    pub nodal_diameters: usize,
    /// Nodal circles of that wave.
    pub nodal_circles: usize,
    /// Estimated relative error of the speed.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
}

/// A band of unstable speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InstabilityEntry {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// Speed at which the band begins.
    pub from_rpm: f64,
    /// Speed at which the band ends, or the end of the sweep.
    pub to_rpm: f64,
    /// False if the sweep begins or ends inside the band.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak_rpm: f64,
    /// Largest growth rate.
    pub peak_growth_per_s: f64,
    /// Frequency at the peak.
    pub frequency_hz: f64,
    /// Waves of the band at its own speed: "2 diameters" for divergence, "4 reflected with 2 forward" for
    /// flutter; null without a diagram. The branches are named by their modes at rest, which may differ.
    #[serde(default)]
    pub name: Option<String>,
    /// Numbers of the branches that become unstable; empty without a diagram.
    pub branches: Vec<usize>,
    /// Waves of the band one by one, reflected ones first: "4 diameters, reflected".
    pub modes: Vec<String>,
    /// Intervals [from, to] in which the band counts as an instability: divergence as a whole; flutter of an
    /// undamped blade as a whole if its largest growth reaches the threshold, of a damped one where its
    /// growth does.
    pub counted_rpm: Vec<[f64; 2]>,
    /// Amplitude to which flutter rises from a small motion at the speed of largest growth, limited by
    /// stretching, without damping; up to 1.41 times as large near one edge of the band. Null unless
    /// requested, for divergence, if only damping makes the blade flutter, and if it was not computed.
    #[serde(default)]
    pub saturated_amplitude_m: Option<f64>,
    /// Reason for which the amplitude was not computed, although it was requested; null if there is none.
    #[serde(default)]
    pub amplitude_not_computed: Option<String>,
    /// Estimated relative error of the onset.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the largest growth rate. As a small difference of large numbers it may
    /// exceed the tolerance.
    #[serde(default)]
    pub estimated_relative_growth_error: Option<f64>,
}

/// Comparison of the operating speed with the lowest critical speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperatingEntry {
    /// The scene's operating speed.
    pub rpm: f64,
    /// Lowest critical speed, also above the sweep; null if the blade has none.
    #[serde(default)]
    pub lowest_critical_rpm: Option<f64>,
    /// Ratio of operating speed to lowest critical speed; null if the blade has no critical speed.
    pub of_lowest_critical: Option<f64>,
    /// Usual limit of that ratio, 0.85.
    pub limit: f64,
    /// Whether the ratio is at most the limit; null without a ratio.
    pub within_limit: Option<bool>,
    /// Whether the saw is stable at that speed.
    pub verdict: StabilityState,
    /// Index into `instabilities` of the band that makes it unstable.
    pub inside_instability: Option<usize>,
    /// Critical speed within 5 % of the operating speed; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Deflection of the rim at the cut under a constant side force there, relative to that at rest; negative if the
    /// blade moves against the force. Null unless the saw is stable and within 5 % of a critical speed, if nothing
    /// holds the blade's rigid motions, and so close to the critical speed that its error decides.
    #[serde(default)]
    pub side_force_factor: Option<f64>,
    /// The window without instability: speeds of the sweep around the operating speed at which no instability
    /// counts, and which are at least 5 % from critical speeds; null if the saw is unstable or at a critical
    /// speed.
    pub safe_window_rpm: Option<[f64; 2]>,
    /// Re λ of the mode that grows fastest, or decays most slowly; null outside the sweep.
    pub growth_per_s: Option<f64>,
    /// Im λ/2π of this mode.
    pub frequency_hz: Option<f64>,
}

/// Size of the basis and estimated errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AccuracyEntry {
    /// Named accuracy of the scene.
    pub name: Accuracy,
    /// Largest number of nodal diameters.
    pub max_diameters: usize,
    /// Speed up to which no wave with more nodal diameters can stand still in space: at least the end of the sweep and
    /// the lowest critical speed. Critical speeds, bands, errors and the certificate hold up to it.
    pub complete_to_rpm: f64,
    /// Number of radial functions for each number of nodal diameters, including those that steps and kinks of the
    /// thickness add.
    pub radial_functions: usize,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Relative error allowed for critical speeds, onsets and the lowest frequencies at rest.
    pub tolerance: f64,
    /// Whether the estimate is within the tolerance, which the largest basis may not achieve.
    pub reached: bool,
    /// Estimated relative error of the critical speeds within the sweep, from the change with a larger basis.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the lowest frequencies at rest, measured on a larger basis.
    #[serde(default)]
    pub estimated_resting_error: Option<f64>,
    /// Estimated relative error of the frequencies in the diagram, each relative to the frequency of its wave
    /// on the blade.
    #[serde(default)]
    pub estimated_drawn_error: Option<f64>,
}

/// Numbers of eigenproblems solved, by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkEntry {
    /// Eigenproblems of the full model: Krylov iterations with a factorization each, or dense ones.
    pub full_solves: usize,
    /// Number of `full_solves` that used the block structure of the blade and the few columns of its guides, in a time
    /// linear in the number of basis functions; scenes with edge loads or dampers have no such structure.
    pub structured_solves: usize,
    /// Dense eigenproblems of the reduced model.
    pub reduced_solves: usize,
    /// Dense eigenproblems of the Hamiltonian reduction between two speeds.
    pub local_solves: usize,
    /// Pairs of modes (single modes of a damped blade or in divergence) refined by inverse iteration with a
    /// few factorizations each.
    pub refined_pairs: usize,
    /// Symmetric eigenproblems of the full model at other temperatures, for limits of heat.
    pub heat_solves: usize,
}

/// Relative change of speeds for a change of one number of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensitivityEntry {
    /// JSON path of the number in the scene.
    pub parameter: String,
    /// The change: "1 %" or "1 degree".
    pub change: String,
    /// Change of each critical speed up to the end of the sweep, in percent; double ones of a free blade are
    /// listed twice.
    pub critical_speeds_percent: Vec<f64>,
    /// Change of the onset of each reported band, in percent; null if the sweep begins inside the band.
    pub onsets_percent: Vec<Option<f64>>,
    /// dλ/dp of each mode at the operating speed (at rest without one), times the change: real part, growth
    /// in 1/s.
    pub growth_per_s: Vec<f64>,
    /// Imaginary part of this change: frequency in Hz.
    pub frequency_hz: Vec<f64>,
}
