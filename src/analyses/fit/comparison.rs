//! Computed frequencies before and after a fit, at the measured speeds and over speed.

use rayon::prelude::*;

use super::model::{Assigned, frequencies_hz, frequency_hz};
use super::{Curves, Measurement, Residual};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Scene, SpeedRange, rad_per_s};
use crate::modes::{LowestModes, SpectralModel, SpectrumError, Strategy};

/// A saw before and after a fit.
pub struct Compared {
    before: Saw,
    fitted: Saw,
}

struct Saw {
    plate: Plate,
    lowest: LowestModes,
}

impl Saw {
    /// The `count` lowest frequencies in Hz at every speed: by waves, which prepare all speeds together, as far as they
    /// reach, and otherwise at each speed anew.
    fn curves(&self, rpm: &[f64], count: usize) -> Result<Vec<Vec<f64>>, SpectrumError> {
        let end_rpm = rpm.iter().copied().fold(0.0, f64::max);
        let range = SpeedRange::between_rpm(0.0, end_rpm);
        let model = SpectralModel::new(self.plate.clone(), range, Strategy::Reduced);
        let by_waves = model.ok().filter(|model| model.unsettled_rad_per_s == 0.0);
        let at = |rpm: &f64| {
            let mut modes = match &by_waves {
                Some(model) => model.modes(rad_per_s(*rpm))?,
                None => Vec::new(),
            };
            modes.retain(|mode| mode.lambda.im > 0.0 || mode.lambda.re > 0.0);
            if modes.len() < count {
                return frequencies_hz(&self.lowest, *rpm, count);
            }
            Ok(modes.iter().take(count).map(frequency_hz).collect())
        };
        rpm.par_iter().map(at).collect()
    }
}

impl Compared {
    pub fn new(before: &Scene, fitted: &Scene, resolution: Resolution) -> Self {
        let saw = |scene| {
            let plate = Plate::new(scene, resolution);
            let lowest = LowestModes::new(&plate);
            Saw { plate, lowest }
        };
        Compared {
            before: saw(before),
            fitted: saw(fitted),
        }
    }

    /// The `count` lowest frequencies at every speed.
    pub fn curves(&self, rpm: Vec<f64>, count: usize) -> Result<Curves, SpectrumError> {
        Ok(Curves {
            before_hz: self.before.curves(&rpm, count)?,
            fitted_hz: self.fitted.curves(&rpm, count)?,
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
            let before = Assigned::new(&self.before.lowest, row)?;
            let fitted = Assigned::new(&self.fitted.lowest, row)?;
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
