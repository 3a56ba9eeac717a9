//! Critical speeds, instability bands, flutter speed, and the verdict.

mod bands;
mod finder;
mod refine;
mod station;

pub use bands::{Certificate, Instability, InstabilityKind, StabilityChart, analyze};
