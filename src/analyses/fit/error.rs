//! Errors of a fit.

use crate::model::scene::SceneError;
use crate::modes::SpectrumError;
use crate::stability::AnalysisError;

/// Reason for which a fit failed.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A line of the table is not a row of numbers.
    #[error("line {line} of the measured frequencies: {problem}")]
    Table {
        /// Line, from 1.
        line: u64,
        /// Description of the error, with remedy.
        problem: String,
    },
    /// The table contains only speeds.
    #[error("there is no frequency in {source_name}; give a table with some")]
    Empty {
        /// Name of the table.
        source_name: String,
    },
    /// The data cannot determine so many unknowns.
    #[error(
        "{measured} measured frequencies do not determine {free} numbers; measure more, or free fewer numbers"
    )]
    TooFew {
        /// Number of measured frequencies.
        measured: usize,
        /// Number of free numbers that have an effect.
        free: usize,
    },
    /// No free number has an effect.
    #[error(
        "no free number changes a measured frequency; free another one, like guides[0].radius_m"
    )]
    NothingFree,
    /// Every start was refused.
    #[error("none of {starts} starts between the bounds is a valid saw; narrow the bounds")]
    NoStart {
        /// Number of starts.
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
