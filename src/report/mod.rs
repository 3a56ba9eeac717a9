//! The report: the results for a saw, complete enough to draw every figure from it alone.
//!
//! Reports are made from an [`Analysis`](crate::stability::Analysis), a [`Check`](crate::check::Check), a
//! fit, a placement or the history of a cut, and are written as JSON with speeds in rpm, frequencies in Hz
//! and growth rates in 1/s. A report solves no eigenproblem; its contents were computed before. Only
//! [`WhirlEntry`], [`EventShapeEntry`] and [`SensitivityEntry`] are computed on request.

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
#[cfg(feature = "explore")]
mod growing;
mod in_cut;
mod membrane;
mod mode;
mod place;
mod remarks;
mod resting;
mod runup;
mod saturated;
mod schema;
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
pub use self::fit::{CurvesEntry, FitReport, ParameterEntry, ResidualEntry, StartEntry};
#[cfg(feature = "explore")]
pub(crate) use self::growing::GrowingMapEntry;
pub use self::in_cut::{IdlingEntry, InCutEntry};
pub use self::membrane::{HeatCurveEntry, HeatEntry, HeatLimitEntry, MembraneEntry};
pub use self::mode::{ComplexEntry, ModeEntry, WaveEntry};
pub use self::place::{
    FragileOptimumEntry, GoalEntry, MapEntry, NeighbourEntry, OutcomeEntry, PlaceCertificateEntry,
    PlaceReport, PlacedEntry,
};
pub use self::resting::{HarmonicEntry, RestMode, ShapeEntry};
pub use self::runup::{ResponseEntry, RunUpBand, RunUpReport, StretchingEntry};
pub use self::schema::json_schema;
pub use self::spline::SplineEntry;
pub use self::vtu::VTK_NAMES;
pub use self::washboard::{LobesEntry, WashboardModeEntry, WashboardReport};
pub use self::whirl::{WhirlEntry, WhirlMode};
use crate::scene::{Accuracy, SceneFile};
pub use crate::spectrum::Direction;
pub use crate::stability::{InstabilityKind, StabilityState};

/// `report.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Numbers that no saw has, each with its key, what saws have, and the remedy: what the report
    /// says holds for them as they were typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Terms of the equation of motion that were assembled.
    pub terms: Vec<String>,
    /// The lowest modes of the blade at rest that oscillate, ascending.
    pub modes_at_rest: Vec<RestMode>,
    /// Modes at rest that decay without oscillating (overdamped), no faster than 2π `campbell.complete_to_hz`; they
    /// are counted here and not listed.
    #[serde(default)]
    pub overdamped_modes_at_rest: usize,
    /// Every critical speed up to the end of the sweep, ascending.
    pub critical_speeds: Vec<CriticalSpeedEntry>,
    /// Whether `critical_speeds` are those of the saw without its damping: where damping turns with the blade, no
    /// eigenvalue of the damped saw is zero at any speed.
    #[serde(default)]
    pub critical_speeds_without_damping: bool,
    /// The bands of instability found within the sweep, by onset; `certificate` says how much of
    /// the sweep is proven to have no other.
    pub instabilities: Vec<InstabilityEntry>,
    /// Lowest speed at which flutter counts: see `counted_rpm` of the bands.
    pub flutter_speed_rpm: Option<f64>,
    /// Onset of the first flutter band, weak ones included.
    pub first_merge_rpm: Option<f64>,
    /// Growth rate from which a band counts as flutter of the saw.
    pub flutter_threshold_per_s: f64,
    /// The forces of the cut on the chart, and the saw without them, when the scene asks for it.
    #[serde(default)]
    pub in_cut: Option<InCutEntry>,
    /// Multiples of the rotation speed and where they meet natural frequencies, when the scene
    /// asks for them.
    #[serde(default)]
    pub excitation: Option<ExcitationEntry>,
    /// The operating speed against the 85 % rule, when the scene gives one.
    pub operating: Option<OperatingEntry>,
    /// The modes of one speed, when asked for.
    pub whirl: Option<WhirlEntry>,
    /// Shapes of the blade at every critical speed, at the peak of every band, at the operating speed and at speeds
    /// asked for, when asked for.
    #[serde(default)]
    pub shapes: Vec<EventShapeEntry>,
    /// How fine the computation was, and how far it may be off.
    pub accuracy: AccuracyEntry,
    /// Number of eigenproblems solved for the chart.
    pub work: WorkEntry,
    /// What was checked of the list of bands: how much of the sweep is proven to have no
    /// instability that is not listed, which part was searched without proof, and what did not
    /// agree.
    pub certificate: CertificateEntry,
    /// Branches over speed.
    pub campbell: CampbellEntry,
    /// Eigenvalues of the two modes that coalesce at the flutter speed, or at the onset of the
    /// first flutter band where none counts, over the speeds around it.
    pub root_loci: Option<RootLociEntry>,
    /// Stress of heat, roll tension and manufacture, when the scene names one.
    pub membrane: Option<MembraneEntry>,
    /// How critical speeds and onsets move with the saw, when asked for.
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
    /// Number of the branch that stands still, where the chart shows which.
    pub branch: Option<usize>,
    /// The wave that stands still: "2 diameters", or the shares of waves where none dominates, "3 (52 %) + 2 (41 %)".
    /// The branch is named by its mode at rest, and otherwise.
    pub name: String,
    /// Nodal diameters of that wave, or of the one with the largest share.
    pub nodal_diameters: usize,
    /// Its nodal circles.
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
    /// Onset.
    pub from_rpm: f64,
    /// End, or the end of the sweep.
    pub to_rpm: f64,
    /// False when the sweep begins or ends inside the band.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak_rpm: f64,
    /// Largest growth rate.
    pub peak_growth_per_s: f64,
    /// Frequency at the peak.
    pub frequency_hz: f64,
    /// The waves that make it, at its own speed: "2 diameters" of a divergence, "4 reflected with 2 forward" of flutter;
    /// null where no chart was drawn. The branches are named by their modes at rest, and otherwise.
    #[serde(default)]
    pub name: Option<String>,
    /// Numbers of the branches that become unstable; none where no chart was drawn.
    pub branches: Vec<usize>,
    /// The same waves one by one, reflected ones first: "4 diameters, reflected".
    pub modes: Vec<String>,
    /// Stretches [from, to] in which it counts as an instability of the saw: divergence as a
    /// whole; flutter of an undamped blade as a whole when its largest growth reaches the
    /// threshold, of a damped one where its growth does.
    pub counted_rpm: Vec<[f64; 2]>,
    /// Largest deflection that flutter rises to from a small motion at the speed of largest growth, where stretching
    /// turns it back, without damping; up to 1.41 times as large near one edge of the band. Null where it was not
    /// asked for, of divergence, and where only damping makes the blade flutter.
    #[serde(default)]
    pub saturated_amplitude_m: Option<f64>,
    /// Estimated relative error of the onset.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the largest growth rate, a small difference of large numbers:
    /// it may exceed the tolerance.
    #[serde(default)]
    pub estimated_relative_growth_error: Option<f64>,
}

/// The operating speed against the lowest critical speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperatingEntry {
    /// The scene's operating speed.
    pub rpm: f64,
    /// Operating speed over lowest critical speed.
    pub of_lowest_critical: Option<f64>,
    /// Usual limit of that ratio, 0.85.
    pub limit: f64,
    /// Whether the ratio is below the limit.
    pub within_limit: Option<bool>,
    /// Whether the saw can run at that speed.
    pub verdict: StabilityState,
    /// Index into `instabilities` of the band that makes it unstable.
    pub inside_instability: Option<usize>,
    /// The critical speed that it is at, nearer than 5 %: there a constant side force bends the wave that stands
    /// still ten times as far as at rest, or more. Null where none is so near.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// The window without instability: the speeds around it at which no instability counts, within the sweep, and no
    /// nearer than 5 % to a critical speed; null where the saw is unstable or at a critical speed.
    pub safe_window_rpm: Option<[f64; 2]>,
    /// Re λ of the mode that grows fastest, or decays most slowly; null outside the sweep.
    pub growth_per_s: Option<f64>,
    /// Im λ/2π of the same mode.
    pub frequency_hz: Option<f64>,
}

/// How fine the computation was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AccuracyEntry {
    /// The name asked for.
    pub name: Accuracy,
    /// Largest number of nodal diameters.
    pub max_diameters: usize,
    /// Radial functions for each, those included that steps and bends of the thickness add.
    pub radial_functions: usize,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Relative error allowed of critical speeds, onsets and the lowest frequencies at rest.
    pub tolerance: f64,
    /// Whether the estimate is within the tolerance: the largest basis may fall short of it.
    pub reached: bool,
    /// Estimated relative error of the critical speeds within the range, from what a larger basis would change.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the lowest frequencies at rest, measured on a larger basis.
    #[serde(default)]
    pub estimated_resting_error: Option<f64>,
    /// Estimated relative error of the frequencies that are drawn, each relative to the frequency
    /// of its wave on the blade.
    #[serde(default)]
    pub estimated_drawn_error: Option<f64>,
}

/// Eigenproblems solved, largest first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkEntry {
    /// Of the full model: Krylov iterations with a factorization each, or dense ones.
    pub full_solves: usize,
    /// Those among them that used the block structure of the blade and the few columns of its
    /// guides, in a time linear in the number of functions; scenes with edge loads or dampers have
    /// no such structure.
    pub structured_solves: usize,
    /// Dense, of the projected matrices.
    pub reduced_solves: usize,
    /// Dense, of the Hamiltonian reduction between two speeds.
    pub local_solves: usize,
    /// Pairs of modes, of a damped blade single modes, refined by inverse iteration with a few factorizations each.
    pub refined_pairs: usize,
    /// Symmetric, of the full model under other temperatures: limits of heat.
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
    /// Change of each critical speed up to the end of the sweep, in percent; the
    /// double ones of a free blade stand twice.
    pub critical_speeds_percent: Vec<f64>,
    /// Change of the onset of each reported band, in percent; null where the sweep
    /// begins inside the band.
    pub onsets_percent: Vec<Option<f64>>,
    /// dλ/dp of each mode at the operating speed (at rest without one), times the
    /// change: growth in 1/s.
    pub growth_per_s: Vec<f64>,
    /// The same: frequency in Hz.
    pub frequency_hz: Vec<f64>,
}
