//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use rayon::prelude::*;

use super::matching::matched;
use super::model::{frequencies_hz, tones};
use super::{Curves, Measurement, Residual};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, rad_per_s};
use crate::modes::{LowestModes, SpectrumError};

/// A computed frequency, with its rank at this speed from 1.
#[derive(Debug, Clone, Copy)]
struct Computed {
    place: usize,
    hz: f64,
}

/// A saw before and after a fit.
pub struct Compared {
    before: LowestModes,
    fitted: LowestModes,
}

impl Compared {
    pub fn new(before: &Scene, fitted: &Scene, resolution: Resolution) -> Self {
        let lowest = |scene| LowestModes::new(&Plate::new(scene, resolution));
        Compared {
            before: lowest(before),
            fitted: lowest(fitted),
        }
    }

    /// The `count` lowest frequencies at every speed.
    pub fn curves(&self, rpm: Vec<f64>, count: usize) -> Result<Curves, SpectrumError> {
        let at_all = |lowest: &LowestModes| -> Result<_, SpectrumError> {
            let each = rpm.par_iter();
            each.map(|rpm| frequencies_hz(lowest, *rpm, count))
                .collect()
        };
        Ok(Curves {
            before_hz: at_all(&self.before)?,
            fitted_hz: at_all(&self.fitted)?,
            rpm,
        })
    }

    /// Measured frequencies beside the computed ones, including those beyond the last fitted speed.
    pub fn residuals(
        &self,
        measured: &Measurement,
        to_rpm: f64,
    ) -> Result<Vec<Residual>, SpectrumError> {
        let mut residuals = Vec::new();
        for row in &measured.rows {
            let computed = |lowest: &LowestModes| -> Result<Vec<Option<Computed>>, SpectrumError> {
                let modes = lowest.at(rad_per_s(row.rpm), row.modes_needed())?;
                let tones = tones(lowest, &modes);
                let of_tone = |index: usize| Computed {
                    place: index + 1,
                    hz: tones[index].hz,
                };
                let found = matched(row, &tones).into_iter();
                Ok(found.map(|index| index.map(of_tone)).collect())
            };
            let pairs = computed(&self.before)?
                .into_iter()
                .zip(computed(&self.fitted)?);
            for ((before, after), (column, measured_hz)) in pairs.zip(&row.pairs) {
                let hz = |computed: Option<Computed>| computed.map_or(0.0, |computed| computed.hz);
                residuals.push(Residual {
                    rpm: row.rpm,
                    place: after.map_or(column + 1, |computed| computed.place),
                    measured_hz: *measured_hz,
                    before_hz: hz(before),
                    fitted_hz: hz(after),
                    fitted: row.rpm <= to_rpm,
                });
            }
        }
        Ok(residuals)
    }
}
