//! Critical speeds, instability bands, flutter speed, and the verdict.

mod analysis;
mod band;
mod bands;
mod basis;
mod certificate;
mod damped;
mod divergence;
mod estimate;
mod evaluator;
mod flutter;
mod heat;
mod interpolation;
mod loci;
mod matching;
mod maximum;
mod onsets;
mod pair_continuation;
mod search;
mod sensitivity;
mod signature;
mod tradeoff;
mod verdict;

pub use analysis::{Analysis, Detail, OPERATING_LIMIT};
pub use band::{CurvePoint, Instability, InstabilityKind};
pub use bands::{StabilityChart, chart, undamped_bands};
pub use basis::ChosenBasis;
pub(crate) use basis::resolved_plate;
pub use certificate::{Certificate, Mismatch};
pub use estimate::{BandError, Estimates};
pub use heat::{HeatCurve, HeatLimit, HeatLimits};
pub use loci::RootLoci;
pub use onsets::{Onsets, search_bands};
pub use sensitivity::{Sensitivity, SensitivityError, sensitivities};
pub use tradeoff::{Method, Setting, recommended, tradeoff};
pub use verdict::{StabilityState, Verdict, flutter_onsets, safe_window, verdict};
