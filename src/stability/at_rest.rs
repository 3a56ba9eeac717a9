//! Modes of a saw at rest, whatever speeds its sweep has.

use crate::model::scene::SpeedRange;
use crate::modes::{
    DescribedMode, SPLITTING, SpectralModel, SpectrumError, Strategy, frequency_scale,
};

/// Modes at rest up to the height of a diagram that begins there.
pub struct ModesAtRest {
    /// Their model, where a sweep that begins at a speed does not contain them.
    own: Option<SpectralModel>,
    /// Oscillating modes, ascending.
    pub oscillating: Vec<DescribedMode>,
    /// Number of the others, which decay without oscillating.
    pub overdamped: usize,
}

impl ModesAtRest {
    /// The modes at rest of the saw of a model for a range of speeds. A range without rest has neither its modes nor its height, so that
    /// they are computed anew.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(model: &SpectralModel, range: SpeedRange) -> Result<Self, SpectrumError> {
        let own = if range.from_rad_per_s == 0.0 {
            None
        } else {
            let rest = SpeedRange::new(0.0, SPLITTING * frequency_scale(&model.plate));
            let (plate, critical) = (model.plate.clone(), model.critical.clone());
            let own = SpectralModel::with_critical(plate, critical, rest, Strategy::Reduced)?;
            Some(own)
        };
        let of_rest = own.as_ref().unwrap_or(model);
        let modes = of_rest.describe(0.0, of_rest.modes(0.0)?).into_iter();
        let (overdamped, oscillating): (Vec<_>, Vec<_>) =
            modes.partition(|mode| mode.mode.is_overdamped());
        Ok(ModesAtRest {
            own,
            oscillating,
            overdamped: overdamped.len(),
        })
    }

    /// The model that gives these modes: their own, or that of the sweep.
    pub fn model<'a>(&'a self, of_sweep: &'a SpectralModel) -> &'a SpectralModel {
        self.own.as_ref().unwrap_or(of_sweep)
    }
}
