//! Bands of a search and their parts within the requested range, and the chart that they are drawn in. The search
//! extends slightly beyond the range, so that an event at an end of the range is not at an end of the search.

use super::band::Instability;
use super::certificate::Certificate;
use crate::model::scene::SpeedRange;
use crate::modes::branches::{Campbell, ModesAt};
use crate::modes::{SpectralModel, SpectrumError};

/// Every band that a search finds, by onset, and the checks of them.
#[derive(Debug, Clone, Default)]
pub struct FoundBands {
    /// Bands by onset.
    pub instabilities: Vec<Instability>,
    /// Results of the checks of the bands.
    pub certificate: Certificate,
}

/// Campbell diagram, bands of instability and certificate over a range of speeds.
#[derive(Debug, Clone)]
pub struct StabilityChart {
    /// Modes at the speeds of the chart, and branches.
    pub campbell: Campbell,
    /// Bands by onset.
    pub instabilities: Vec<Instability>,
    /// Results of the checks of the bands.
    pub certificate: Certificate,
}

impl StabilityChart {
    /// The chart of sampled modes and the bands of a search.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub(super) fn new(
        model: &SpectralModel,
        samples: Vec<ModesAt>,
        found: FoundBands,
    ) -> Result<Self, SpectrumError> {
        Ok(StabilityChart {
            campbell: Campbell::track(model, samples)?,
            instabilities: found.instabilities,
            certificate: found.certificate,
        })
    }
}

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
