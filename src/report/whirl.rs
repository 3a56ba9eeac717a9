//! The modes of one speed.

use std::f64::consts::TAU;

use super::{WhirlEntry, WhirlMode};
use crate::scene::rpm;
use crate::spectrum::{DescribedMode, SpectrumError, in_words};
use crate::stability::Analysis;

impl WhirlEntry {
    /// Every mode of the chart at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn new(analysis: &Analysis, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let model = &analysis.model;
        let modes = model.describe(speed_rad_per_s, model.modes(speed_rad_per_s)?);
        Ok(WhirlEntry {
            rpm: rpm(speed_rad_per_s),
            verdict: analysis.verdict(speed_rad_per_s).state,
            modes: modes.iter().map(WhirlMode::from).collect(),
        })
    }
}

impl From<&DescribedMode> for WhirlMode {
    fn from(described: &DescribedMode) -> Self {
        let (mode, name) = (&described.mode, &described.name);
        WhirlMode {
            frequency_hz: mode.frequency_rad_per_s() / TAU,
            nodal_diameters: name.diameters,
            nodal_circles: name.circles,
            direction: name.direction,
            name: in_words(name.diameters, name.circles, name.direction),
            growth_per_s: mode.growth_per_s(),
            damping_ratio: mode.damping_ratio(),
            logarithmic_decrement: mode.logarithmic_decrement(),
            krein_sign: mode.krein_sign(),
        }
    }
}
