//! Number of waves of a reduced model before it is made, by the waves of the free blade.

use faer::c64;

use super::chart_height::chart_height;
use super::error::SpectrumError;
use super::heights::REFLECTED_MARGIN;
use super::standing_waves::{frequencies_in_space, highest_reflected, waves_below};
use super::waves::CUT;
use crate::model::plate::Plate;
use crate::model::scene::SpeedRange;

/// Number of waves that the reduced model of a guided saw keeps over a range of speeds for a diagram, by the waves of its free blade,
/// whose frequencies guides change by little.
///
/// # Errors
/// [`SpectrumError::Decomposition`].
pub fn kept_waves(plate: &Plate, range: SpeedRange) -> Result<usize, SpectrumError> {
    let [from, to] = range.ends();
    let low = frequencies_in_space(plate, from)?;
    let low: Vec<c64> = low.into_iter().map(|w| c64::new(0.0, w)).collect();
    let drawn = chart_height(&low, true).unwrap_or(0.0);
    let window = drawn.max(REFLECTED_MARGIN.get() * highest_reflected(plate, to)?);
    waves_below(plate, &[from, 0.5 * (from + to), to], CUT * window)
}
