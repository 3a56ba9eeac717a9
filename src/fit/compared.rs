//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use super::{Fit, Measurement};
use crate::campbell::even_speeds;
use crate::spectrum::SpectrumError;

/// Lowest frequencies in ascending order at some speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct BeforeAndAfter {
    /// Speeds.
    pub rpm: Vec<f64>,
    /// Of the scene as it was, in Hz, a row for each speed.
    pub before_hz: Vec<Vec<f64>>,
    /// Of the fitted one, in Hz.
    pub fitted_hz: Vec<Vec<f64>>,
}

/// What a report of a fit shows beside the numbers found.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// At the measured speeds, those included that were left out of the fit.
    pub measured: BeforeAndAfter,
    /// From rest to a little past the last fitted speed.
    pub curves: BeforeAndAfter,
}

/// Speeds of the curves.
const CURVE_SPEEDS: usize = 121;
/// They reach a little past the last fitted speed.
const BEYOND: f64 = 1.12;
/// A fit at rest alone is drawn a little way, for there has to be an axis.
const LEAST_RPM: f64 = 100.0;

impl Compared {
    /// The frequencies of a fit.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(fit: &Fit) -> Result<Self, SpectrumError> {
        let fitted = fit.measurement.up_to(fit.to_rpm);
        let top = match fitted.top_rpm() {
            rpm if rpm > 0.0 => BEYOND * rpm,
            _ => LEAST_RPM,
        };
        let of = |rpm: Vec<f64>, measurement: &Measurement| -> Result<_, SpectrumError> {
            let depth = measurement.depth();
            Ok(BeforeAndAfter {
                before_hz: fit.frequencies_hz(&fit.before, &rpm, depth)?,
                fitted_hz: fit.frequencies_hz(&fit.scene, &rpm, depth)?,
                rpm,
            })
        };
        let rows = fit.measurement.rows.iter().map(|row| row.rpm);
        Ok(Compared {
            measured: of(rows.collect(), &fit.measurement)?,
            curves: of(even_speeds((0.0, top), CURVE_SPEEDS), &fitted)?,
        })
    }
}
