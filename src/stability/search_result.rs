//! Bands of a search and their parts within the requested range. The search extends slightly beyond the
//! range, so that an event at an end of the range is not at an end of the search.

use super::band::Instability;
use crate::model::scene::SpeedRange;
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
        range: SpeedRange,
        part: impl Fn(SpeedRange) -> Result<Instability, SpectrumError>,
    ) -> Result<Self, SpectrumError> {
        let whole = part(SpeedRange::new(0.0, f64::INFINITY))?;
        let cut = whole.range().within(range);
        let within = if cut == whole.range() {
            Some(whole.clone())
        } else if cut.width() > 0.0 {
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
