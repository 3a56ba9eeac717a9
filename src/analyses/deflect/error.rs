//! Reasons for which the equilibria of a blade could not be computed.

use crate::model::scene::{RefusedValue, SceneError};
use crate::motion::stretched_blade::StretchedError;
use crate::stability::AnalysisError;

/// Reason for which the equilibria of a blade could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum DeflectError {
    /// The force or the speed is out of range.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// The scene refuses the requested range of speeds.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// No equilibrium was found, or equilibria are not isolated.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}
