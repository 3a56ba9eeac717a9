//! Critical speeds, instability bands, flutter speed, and the verdict.

mod analysis;
mod bands;
mod basis;
mod damped;
mod divergence;
mod finder;
mod flutter;
mod heat;
mod loci;
mod onsets;
mod peak;
mod pursuit;
mod refine;
mod sensitivity;
mod station;
mod tradeoff;
mod verdict;

pub use analysis::{Analysis, Detail, OPERATING_LIMIT};
pub use bands::{
    Certificate, CurvePoint, Instability, InstabilityKind, StabilityChart, chart, undamped_bands,
};
pub use basis::ChosenBasis;
pub(crate) use basis::resolved_plate;
pub use heat::{HeatCurve, HeatLimit, HeatLimits};
pub use loci::RootLoci;
pub use onsets::{Onsets, search_bands};
pub use sensitivity::{Sensitivity, SensitivityError, sensitivities};
pub use tradeoff::{Method, Setting, recommended, tradeoff};
pub use verdict::{StabilityState, Verdict, flutter_onsets, safe_window, verdict};
