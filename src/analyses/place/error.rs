//! Errors of a placement.

use crate::analyses::gap::GapError;
use crate::model::scene::SceneError;
use crate::modes::SpectrumError;
use crate::stability::AnalysisError;

/// Reason for which a placement failed.
#[derive(Debug, thiserror::Error)]
pub enum PlaceError {
    /// No free number has an effect.
    #[error(
        "no free number changes a critical speed or a band; free another one, like guides[0].radius_m"
    )]
    NothingFree,
    /// The scene itself, or every saw tried, cannot be analysed.
    #[error("none of the {tried} saws tried can be analysed; narrow the bounds")]
    NoSaw {
        /// Number of saws tried.
        tried: usize,
    },
    /// The log of the saws cannot be used.
    #[error("cannot use the log of the saws: {0}")]
    Log(#[from] std::io::Error),
    /// A scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The deflection of a saw with guides with a gap was not found.
    #[error(transparent)]
    Gap(#[from] GapError),
}
