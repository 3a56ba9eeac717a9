//! The wish that a computation may end before it is done.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::SpectrumError;

/// A flag shared by a computation and whoever may lose interest in it. The computation looks
/// at it between two eigenproblems and then ends with [`SpectrumError::Stopped`].
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks the computation to end.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked to.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// # Errors
    /// [`SpectrumError::Stopped`] once the computation was asked to end.
    pub fn check(&self) -> Result<(), SpectrumError> {
        match self.is_asked() {
            true => Err(SpectrumError::Stopped),
            false => Ok(()),
        }
    }
}
