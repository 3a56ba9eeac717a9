//! Reasons for which the guides of a saw could not be evaluated.

use crate::model::scene::{RefusedValue, SceneError};
use crate::modes::SpectrumError;
use crate::motion::stretched_blade::StretchedError;
use crate::stability::AnalysisError;

/// Reason for which the guides of a saw could not be evaluated.
#[derive(Debug, thiserror::Error)]
pub enum GapError {
    /// An option was refused, or the scene has no one-sided guide.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// A scene with another gap or stiffness was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// No equilibrium was found.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}
