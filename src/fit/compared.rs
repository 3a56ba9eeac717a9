//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Measurement;
use super::model::frequencies_hz;
use crate::campbell::even_speeds;
use crate::plate::{Plate, Resolution};
use crate::scene::Scene;
use crate::spectrum::{LowestModes, SpectrumError};

/// Lowest frequencies, ascending, one row for each speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Curves {
    /// Speeds of the curves.
    pub rpm: Vec<f64>,
    /// Frequencies before the fit.
    pub before_hz: Vec<Vec<f64>>,
    /// Frequencies after the fit.
    pub fitted_hz: Vec<Vec<f64>>,
}

/// Frequencies that the report of a fit shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Compared {
    /// At the measured speeds, including those that were excluded from the fit.
    pub measured: Curves,
    /// From rest to slightly beyond the last fitted speed.
    pub curves: Curves,
}

/// Number of speeds of the curves.
const CURVE_SPEEDS: usize = 121;
/// End of the curves, relative to the last fitted speed.
const BEYOND: f64 = 1.12;

impl Compared {
    /// The frequencies of a scene before and after a fit to the rows up to a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        scenes: [&Scene; 2],
        measured: &Measurement,
        to_rpm: f64,
        resolution: Resolution,
    ) -> Result<Self, SpectrumError> {
        let used = measured.up_to(to_rpm);
        let top = BEYOND * used.end_of_range_rpm();
        let [before, fitted] = scenes.map(|scene| LowestModes::new(&Plate::new(scene, resolution)));
        let of = |rpm: Vec<f64>, measurement: &Measurement| -> Result<_, SpectrumError> {
            let at_all = |lowest: &LowestModes| -> Result<_, SpectrumError> {
                let each = rpm.par_iter();
                each.map(|rpm| frequencies_hz(lowest, *rpm, measurement.depth()))
                    .collect()
            };
            Ok(Curves {
                before_hz: at_all(&before)?,
                fitted_hz: at_all(&fitted)?,
                rpm,
            })
        };
        let rows = measured.rows.iter().map(|row| row.rpm);
        Ok(Compared {
            measured: of(rows.collect(), measured)?,
            curves: of(even_speeds((0.0, top), CURVE_SPEEDS), &used)?,
        })
    }
}
