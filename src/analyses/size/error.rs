//! Reasons for which a number was not sized.

use crate::analyses::check::CheckError;
use crate::model::scene::RefusedValue;
use crate::modes::SpectrumError;

/// Reason for which a number was not sized.
#[derive(Debug, thiserror::Error)]
pub enum SizeError {
    /// The scene has no operating speed.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// The saw of the answer could not be checked.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// The computation was cancelled.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}
