//! Amplitude to which the flutter of each band rises, computed on request.

use super::analysis::Report;
use super::speeds::InstabilityBand;
use crate::motion::stretched_blade::StretchedError;
use crate::motion::stretched_blade::{Rise, saturations};
use crate::stability::Analysis;

impl Report {
    /// Adds the amplitude to which the flutter of each band rises.
    ///
    /// # Errors
    /// [`StretchedError`] if no amplitude of this blade can be computed.
    pub fn add_amplitudes(&mut self, analysis: &Analysis) -> Result<(), StretchedError> {
        add_amplitudes(&mut self.instabilities, &saturations(analysis)?);
        Ok(())
    }
}

/// Adds one amplitude to each band, or the reason for which it was not computed.
pub(crate) fn add_amplitudes(bands: &mut [InstabilityBand], found: &[Rise]) {
    for (entry, found) in bands.iter_mut().zip(found) {
        match found {
            Ok(found) => entry.saturated_amplitude_m = found.map(|found| found.amplitude_m),
            Err(reason) => entry.amplitude_not_computed = Some(reason.to_string()),
        }
    }
}
