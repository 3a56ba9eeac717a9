//! Bands of a search, and what of them lies within the range asked for: the search goes a little beyond it, so that
//! no event at an end of the range is an end of the search.

use super::band::Instability;
use crate::spectrum::SpectrumError;

/// A band over all speeds of the search.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub whole: Instability,
    /// Its part within the range asked for, if there is one.
    pub within: Option<Instability>,
}

impl Found {
    /// From what gives the part of a band between two speeds, with the largest growth there.
    ///
    /// # Errors
    /// Those of `part`.
    pub fn new(
        range: (f64, f64),
        part: impl Fn((f64, f64)) -> Result<Instability, SpectrumError>,
    ) -> Result<Self, SpectrumError> {
        let whole = part((0.0, f64::INFINITY))?;
        let ends = (whole.from_rad_per_s, whole.to_rad_per_s);
        let cut = (ends.0.max(range.0), ends.1.min(range.1));
        let within = if cut == ends {
            Some(whole.clone())
        } else if cut.0 < cut.1 {
            Some(Instability {
                closed: false,
                ..part(cut)?
            })
        } else {
            None
        };
        Ok(Found { whole, within })
    }
}
