//! Bands of a search and their parts within the requested range. The search extends slightly beyond the
//! range, so that an event at an end of the range is not at an end of the search.

use super::band::Instability;
use crate::modes::SpectrumError;

/// A band of a search.
#[derive(Debug, Clone)]
pub(super) struct Found {
    /// The band over all speeds of the search.
    pub whole: Instability,
    /// Part of the band within the requested range, if any.
    pub within: Option<Instability>,
}

impl Found {
    /// A band from a function that gives its part between two speeds, with the largest growth in that part.
    ///
    /// # Errors
    /// The errors of `part`.
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
