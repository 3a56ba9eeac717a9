//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use rayon::prelude::*;

use super::model::{Assigned, frequencies_hz, frequency_hz};
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
        let mut residuals = Vec::new();
        for row in &measured.rows {
            let before = Assigned::new(&self.before, row)?;
            let fitted = Assigned::new(&self.fitted, row)?;
            for (k, (column, measured_hz)) in row.pairs.iter().enumerate() {
                let hz = |assigned: &Assigned| assigned.mode(k).map_or(0.0, frequency_hz);
                residuals.push(Residual {
                    rpm: row.rpm,
                    place: 1 + fitted.place(k).unwrap_or(*column),
                    diameters: fitted.diameters(k),
                    measured_hz: *measured_hz,
                    before_hz: hz(&before),
                    fitted_hz: hz(&fitted),
                    fitted: row.rpm <= to_rpm,
                });
            }
        }
        Ok(residuals)
    }
}
