//! The report: the results for a saw, complete enough to draw every figure from it alone.
//!
//! Reports are made from an [`Analysis`](crate::stability::Analysis), a fit or a placement, and are written as JSON with
//! speeds in rpm, frequencies in Hz and growth rates in 1/s. The contents of a report are computed before it is made;
//! only [`Whirl`], [`EventShape`] and [`Sensitivity`] are computed on request and added.

mod amplitudes;
mod analysis;
pub(crate) mod band_item;
mod branches;
mod certificate;
mod chart;
mod colours;
mod construction;
mod csv;
pub(crate) mod diagram;
#[cfg(test)]
#[allow(dead_code, reason = "helpers of other properties")]
#[path = "../../../tests/common/draws.rs"]
mod draws;
mod event_shape;
mod excitation;
#[cfg(test)]
mod figure_tests;
mod figures;
mod in_cut;
pub(crate) mod in_cut_chart;
mod membrane;
pub(crate) mod membrane_chart;
pub(crate) mod mode_shapes;
mod modes;
mod outline;
mod pad_places;
mod remarks;
pub(crate) mod root_loci;
#[cfg(test)]
pub(crate) mod sample;
pub(crate) mod sensitivity_chart;
mod slot_remarks;
mod speeds;
mod split_pairs;
mod verdict;
mod vtu;

pub(crate) use self::amplitudes::add_amplitudes;
pub use self::analysis::{BasisAccuracy, Report, SolveCounts};
pub(crate) use self::branches::Numbered;
pub use self::certificate::BandCertificate;
pub(crate) use self::certificate::statement;
pub use self::chart::{BranchCurve, CampbellDiagram, RootLoci, RootPath};
pub use self::diagram::CampbellView;
pub use self::event_shape::{EventShape, ShapeOccasion};
pub use self::excitation::{ExcitationLines, LineCrossing, NamedLine};
pub use self::in_cut::{Idling, InCut};
pub use self::membrane::{
    BladeStress, CriticalCurve, MeasuredGap, RolledBand, StraightEdge, ToleratedHeat, ToleratedRise,
};
pub use self::modes::{
    ComplexNumbers, HarmonicShape, HarmonicShare, ModeHarmonic, ModeShape, RestMode, Whirl,
    WhirlMode,
};
#[cfg(feature = "page")]
pub(crate) use self::outline::usable;
pub(crate) use self::outline::{answer, caution, checks, outline};
pub(crate) use self::remarks::{lifting_off, side_force_in_words};
pub use self::speeds::{CriticalSpeed, InstabilityBand, OperatingPoint};
pub use self::split_pairs::{SplitPairs, UpperCriticalSpeed};
pub use self::verdict::Verdict;
pub use self::vtu::{VTK_NAMES, VtkFile};
pub use crate::stability::{ContradictedBands, MiscountedModes, Sensitivity};

pub use crate::modes::Direction;
pub use crate::stability::{InstabilityKind, StabilityState};
