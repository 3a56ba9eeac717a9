//! Amplitude to which the flutter of each band rises.

use faer::c64;

use crate::spectrum::{SpectrumError, Work};
use crate::stability::{Analysis, Instability, InstabilityKind};
use crate::stretched::{FlutterRise, Saturation, StretchedError};

/// Amplitude to which the flutter of a band rises; `None` for divergence, and if the blade without damping does not
/// flutter; the reason if the amplitude could not be computed.
pub type Rise = Result<Option<Saturation>, StretchedError>;

/// Amplitude to which the flutter of each band rises at the speed of its largest growth.
///
/// # Errors
/// [`StretchedError`] if no amplitude of this blade can be computed, or the computation was cancelled.
pub fn saturations(analysis: &Analysis) -> Result<Vec<Rise>, StretchedError> {
    let bands = &analysis.chart.instabilities;
    let flutters = |band: &&Instability| band.kind == InstabilityKind::Flutter;
    let count = bands.iter().filter(flutters).count();
    if count == 0 {
        return Ok(bands.iter().map(|_| Ok(None)).collect());
    }
    let rise = FlutterRise::new(&analysis.model.plate)?;
    let work = Work::of("bands of flutter", count);
    let of_band = |band: &Instability| match band.kind {
        InstabilityKind::Divergence => Ok(Ok(None)),
        InstabilityKind::Flutter => {
            let lambda = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
            let found = rise.near(band.peak_rad_per_s, lambda);
            work.advance();
            match found {
                Err(StretchedError::Spectrum(SpectrumError::Cancelled)) => found.map(Ok),
                found => Ok(found),
            }
        }
    };
    bands.iter().map(of_band).collect()
}
