//! Why nothing could be fitted.

use crate::scene::SceneError;
use crate::spectrum::SpectrumError;
use crate::stability::AnalysisError;

/// Why nothing could be fitted.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A line of the table that is not a row of numbers.
    #[error("line {line} of the measured frequencies: {problem}")]
    Table {
        /// Line, from 1.
        line: u64,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A table of nothing but speeds.
    #[error("there is no frequency in {source_name}; give a table with some")]
    Empty {
        /// Name of the table.
        source_name: String,
    },
    /// More unknowns than the data can determine.
    #[error(
        "{measured} measured frequencies do not determine {free} numbers; measure more, or free fewer numbers"
    )]
    TooFew {
        /// Measured frequencies.
        measured: usize,
        /// Numbers that are free and move them.
        free: usize,
    },
    /// Nothing to fit with.
    #[error(
        "no number is free that moves a measured frequency; free another one, like guides[0].radius_m"
    )]
    NothingFree,
    /// Every start was refused.
    #[error("none of {starts} starts between the bounds is a saw; narrow the bounds")]
    NoStart {
        /// How many were tried.
        starts: usize,
    },
    /// A scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
}
