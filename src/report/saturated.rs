//! Amplitude to which the flutter of each band rises, computed on request.

use super::{InstabilityEntry, Report};
use crate::deflect::saturations;
use crate::stability::Analysis;
use crate::stretched::{Saturation, StretchedError};

impl Report {
    /// Adds the amplitude to which the flutter of each band rises.
    ///
    /// # Errors
    /// [`StretchedError`] if the amplitude of a band cannot be computed.
    pub fn add_amplitudes(&mut self, analysis: &Analysis) -> Result<(), StretchedError> {
        add_amplitudes(&mut self.instabilities, &saturations(analysis)?);
        Ok(())
    }
}

/// Adds one amplitude to each band.
pub(super) fn add_amplitudes(bands: &mut [InstabilityEntry], found: &[Option<Saturation>]) {
    for (entry, found) in bands.iter_mut().zip(found) {
        entry.saturated_amplitude_m = found.map(|found| found.amplitude_m);
    }
}
