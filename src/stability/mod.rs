//! Critical speeds, instability bands, flutter speed, and the verdict.
//!
//! The input is a [`Scene`](crate::model::scene::Scene), the result an [`Analysis`]: critical speeds, every band of
//! divergence and flutter with its edges (rad/s), its largest growth rate (1/s) and frequency (rad/s), the
//! branches of the Campbell diagram, estimated errors, and a [`Certificate`] with the proven range.
//! [`Onsets`] gives critical speeds and bands without a chart, for many saws; [`Analysis::verdict`] states
//! whether the saw is stable at a speed.

mod analysis;
mod at_rest;
mod band;
mod basis;
mod basis_limit;
mod between;
mod certificate;
mod chart;
mod critical_sides;
mod damped;
mod detail;
mod diagram;
mod error;
mod estimate;
mod excitation;
mod expected_work;
mod floquet;
mod group;
mod growing_modes;
mod growth_curve;
mod heat;
mod hidden_growth;
mod instability_kind;
mod interpolation;
mod ladder;
mod listed_band;
mod listed_pair;
#[cfg(test)]
mod material_damping_tests;
mod mode_counts;
mod onsets;
mod options;
mod partition;
mod pieces;
mod reach;
mod room;
mod root;
mod sample;
mod search_result;
mod sensitivity;
mod shortened;
mod split_pairs;
#[cfg(test)]
mod tuned_tests;
mod undamped;
mod undecided;
mod verdict;

pub use analysis::Analysis;
pub(crate) use band::CurvePoint;
pub use band::{BandEnd, Instability};
pub use basis::ChosenBasis;
pub(crate) use basis::{end_of_sweep, resolved};
pub use basis_limit::OutOfReach;
pub(crate) use certificate::has_failed;
pub use certificate::{Certificate, ContradictedBands};
#[doc(hidden)]
pub use chart::chart;
pub(crate) use chart::chart_to_depth;
pub use detail::Detail;
pub use error::AnalysisError;
pub use estimate::Estimates;
pub use excitation::Crossing;
#[doc(hidden)]
pub use excitation::crossings;
pub use expected_work::ExpectedWork;
pub use floquet::{FloquetGrowth, GuidedBlade, NearbyGrowth, NotComputed};
pub(crate) use growing_modes::GrowingModes;
pub use heat::{HeatCurve, HeatLimit, HeatLimits};
pub use instability_kind::InstabilityKind;
pub(crate) use ladder::{DENSE_LADDER, LADDER, ahead, diameters_beyond, resolution};
pub use listed_band::ListedBand;
pub use mode_counts::MiscountedModes;
pub use onsets::Onsets;
#[doc(hidden)]
pub use onsets::search_bands;
pub use options::{AnalysisOptions, Interim};
pub(crate) use reach::{
    CHARTED, PAST_THE_RANGE, check_speed, check_stretch, is_cut_short, usual_end,
};
pub(crate) use root::{Look, bracketed};
pub use search_result::{FoundBands, StabilityChart};
pub use sensitivity::{Sensitivity, SensitivityError};
pub use shortened::Shortened;
pub use split_pairs::SplitPairs;
pub(crate) use undamped::Depth;
#[doc(hidden)]
pub use undamped::undamped_bands;
pub use undecided::Edge;
pub(crate) use verdict::{CRITICAL_MARGIN, critical_at, flutter_onsets};
pub use verdict::{Evidence, StabilityState, Verdict};
