//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use rayon::prelude::*;

use super::model::frequencies_hz;
use super::{Curves, Measurement, Residual};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::Scene;
use crate::modes::{LowestModes, SpectrumError};

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
        let speeds = measured.rows.iter().map(|row| row.rpm).collect();
        let computed = self.curves(speeds, measured.depth())?;
        let computed = computed.before_hz.iter().zip(&computed.fitted_hz);
        let mut residuals = Vec::new();
        for (row, (before, after)) in measured.rows.iter().zip(computed) {
            for (place, measured_hz) in &row.pairs {
                let at = |computed: &[f64]| computed.get(*place).copied().unwrap_or(0.0);
                residuals.push(Residual {
                    rpm: row.rpm,
                    place: place + 1,
                    measured_hz: *measured_hz,
                    before_hz: at(before),
                    fitted_hz: at(after),
                    fitted: row.rpm <= to_rpm,
                });
            }
        }
        Ok(residuals)
    }
}
