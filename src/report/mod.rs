//! The report: the results for a saw, complete enough to draw every figure from it alone.
//!
//! Reports are made from an [`Analysis`](crate::stability::Analysis), a fit or a placement, and are written as JSON with
//! speeds in rpm, frequencies in Hz and growth rates in 1/s. The contents of a report are computed before it is made;
//! only [`WhirlEntry`], [`EventShapeEntry`] and [`SensitivityEntry`] are computed on request and added.

mod accuracy;
mod analysis;
mod branches;
mod build;
mod certificate;
mod chart;
mod critical_speed;
mod csv;

mod event_shape;
mod excitation;

mod in_cut;
mod instability;
mod membrane;
mod mode;
mod operating;
mod remarks;
mod resting;
mod saturated;
mod sensitivity;
mod verdict;
mod vtu;
mod whirl;

pub use self::accuracy::{AccuracyEntry, WorkEntry};
pub use self::analysis::Report;
pub(crate) use self::branches::Numbered;
pub(crate) use self::certificate::statement;
pub use self::certificate::{CertificateEntry, MiscountEntry, MismatchEntry};
pub use self::chart::{BranchEntry, CampbellEntry, RootLociEntry, RootPathEntry};
pub use self::critical_speed::CriticalSpeedEntry;

pub use self::event_shape::{EventShapeEntry, ShapeOccasion};
pub use self::excitation::{CrossingEntry, ExcitationEntry, ExcitationLineEntry};

pub use self::in_cut::{IdlingEntry, InCutEntry};
pub use self::instability::InstabilityEntry;
pub use self::membrane::{
    HeatCurveEntry, HeatEntry, HeatLimitEntry, MeasuredGapEntry, MembraneEntry, RollBandEntry,
    StraightEdgeEntry,
};
pub use self::mode::{ComplexEntry, ModeEntry, WaveEntry};
pub use self::operating::OperatingEntry;
pub(crate) use self::remarks::{lifting_off, side_force_in_words};
pub use self::resting::{HarmonicEntry, RestMode, ShapeEntry};
pub(crate) use self::saturated::add_amplitudes;
pub use self::sensitivity::SensitivityEntry;
pub use self::verdict::Verdict;
pub use self::vtu::VTK_NAMES;
pub use self::whirl::{WhirlEntry, WhirlMode};
pub use crate::spectrum::Direction;
pub use crate::stability::{InstabilityKind, StabilityState};
