//! Reasons for which a command has no report, by what a face does with them.

use std::error::Error;

use crate::model::scene::{RefusedValue, SceneError};
use crate::modes::SpectrumError;
use crate::motion::stretched_blade::StretchedError;
use crate::stability::AnalysisError;

/// Reason for which a command has no report.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// An argument, which the key names, or a number of the scene, whose path it is.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// The scene with the numbers of these arguments was refused.
    #[error("{source}")]
    Set {
        /// Names of the arguments.
        names: Vec<&'static str>,
        /// The reason.
        source: SceneError,
    },
    /// The scene, or another one that the command makes of it, was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The command has no answer to what was given.
    #[error("{message}")]
    Unanswered {
        /// Key of the scene that is the reason, if there is one.
        key: Option<&'static str>,
        /// Description of the reason, with remedy.
        message: String,
    },
    /// The computation failed or was cancelled.
    #[error(transparent)]
    Failed(Box<dyn Error + Send + Sync>),
}

impl CommandError {
    /// The command has no answer; no single key of the scene is the reason.
    pub(crate) fn unanswered(error: impl Error) -> Self {
        CommandError::Unanswered {
            key: None,
            message: error.to_string(),
        }
    }

    /// The computation failed.
    pub(crate) fn failed(error: impl Error + Send + Sync + 'static) -> Self {
        CommandError::Failed(error.into())
    }
}

impl From<AnalysisError> for CommandError {
    fn from(error: AnalysisError) -> Self {
        CommandError::failed(error)
    }
}

impl From<SpectrumError> for CommandError {
    fn from(error: SpectrumError) -> Self {
        CommandError::failed(error)
    }
}

impl From<StretchedError> for CommandError {
    fn from(error: StretchedError) -> Self {
        CommandError::failed(error)
    }
}
