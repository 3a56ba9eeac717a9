//! Reasons for which a report fails.

use crate::analyses::check::CheckError;
use crate::analyses::gap::GapError;
use crate::analyses::response::ResponseError;
use crate::analyses::size::SizeError;
use crate::model::scene::SceneError;
use crate::modes::SpectrumError;
use crate::stability::{AnalysisError, SensitivityError};

/// Reason for which the report of a saw could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// The scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The computation was cancelled.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The effects of the numbers of the scene could not be computed.
    #[error(transparent)]
    Sensitivity(#[from] SensitivityError),
    /// The steady response could not be computed.
    #[error(transparent)]
    Response(#[from] ResponseError),
    /// The saw with another clamp could not be checked.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// The thickness that keeps the limits could not be found.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The guides with a gap could not be evaluated.
    #[error(transparent)]
    Gap(#[from] GapError),
}
