//! Choice and preparation of the reduced models of a saw.

use std::sync::OnceLock;

use super::{SPLITTING, SpectralModel};
use crate::model::scene::SpeedRange;
use crate::modes::chart_height::Strategy;
use crate::modes::component::{Component, Solution};
use crate::modes::critical_speed::searched_range;
use crate::modes::error::SpectrumError;
use crate::modes::full_model::FullModel;
use crate::modes::heights::{Guided, Heights};
use crate::modes::scale::frequency_scale;
use crate::modes::structured_stiffness::LARGE;
use crate::modes::waves::{self, WaveModel};
use crate::modes::work::WorkCounters;

/// Relative distance of the model from the first critical speed if only bands are searched for; it is larger than the distance that
/// the search keeps from critical speeds.
const BELOW_CRITICAL: f64 = 1e-3;
/// Error of a frequency by waves, relative to the highest, beyond which the range of speeds is too long for their series. The last
/// coefficient overestimates it: against wood it is 6e-8, where the error is below 1e-9.
const TAIL: f64 = 1e-6;
/// Share of a speed by which the range of a model for it alone extends to both sides.
const AROUND: f64 = 0.01;

impl SpectralModel {
    /// Selects the symmetric eigenproblem in the body frame for every component.
    pub(super) fn use_free_waves(&mut self) {
        for component in &mut self.components {
            component.solution = Solution::FreeWaves;
        }
    }

    /// Range of speeds of the model for a range that is asked for. Without damping and without a diagram no speed below the first critical
    /// one is needed, because no wave is reflected there.
    pub(super) fn modelled_range(&self, range: SpeedRange, strategy: Strategy) -> SpeedRange {
        let searched = searched_range(&self.critical, range);
        let lowest = self.critical.first().map(|c| c.speed_rad_per_s);
        let first = lowest.filter(|lowest| {
            let is_passed = lowest * (1.0 + BELOW_CRITICAL) < range.to_rad_per_s;
            strategy == Strategy::Bands && self.is_conservative() && is_passed
        });
        let from = first.map_or(0.0, |lowest| lowest * (1.0 - BELOW_CRITICAL));
        SpeedRange::new(searched.from_rad_per_s.max(from), searched.to_rad_per_s)
    }

    /// Selects the reduced model by waves for every component of a damped or guided blade.
    pub(super) fn use_waves(&mut self, range: SpeedRange, cut: f64) -> Result<(), SpectrumError> {
        let window = self.complete_to_rad_per_s;
        for component in &mut self.components {
            let modes = waves::modes(
                &self.plate,
                component.first,
                &component.full,
                range,
                window,
                cut,
            )?;
            if modes.tail > TAIL {
                self.unsettled_rad_per_s = self.unsettled_rad_per_s.max(modes.tail * window);
            }
            component.solution = Solution::Waves(Box::new(modes));
        }
        Ok(())
    }

    /// The model of the same saw with more waves.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub(crate) fn with_more_waves(&self) -> Result<Self, SpectrumError> {
        let mut model = SpectralModel {
            components: Component::of(&self.plate),
            plate: self.plate.clone(),
            critical: self.critical.clone(),
            counters: WorkCounters {
                cancellation: self.counters.cancellation.clone(),
                ..WorkCounters::default()
            },
            full: OnceLock::new(),
            ..*self
        };
        if let Some((_, known)) = self.wave_models().first() {
            model.use_waves(known.range_rad_per_s(), waves::WIDE_CUT)?;
        }
        Ok(model)
    }

    /// The model of the same saw for a speed that the reduced models of this one do not reach; `None` if they reach it.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub(crate) fn for_speed_beside(
        &self,
        speed_rad_per_s: f64,
    ) -> Result<Option<Self>, SpectrumError> {
        let reaches = |model: &WaveModel| model.range_rad_per_s().contains(speed_rad_per_s);
        if self.wave_models().iter().all(|(_, model)| reaches(model)) {
            return Ok(None);
        }
        let [from, to] = [1.0 - AROUND, 1.0 + AROUND].map(|share| share * speed_rad_per_s);
        let range = SpeedRange::new(from, to.max(SPLITTING * frequency_scale(&self.plate)));
        Self::new(self.plate.clone(), range, Strategy::Reduced).map(Some)
    }

    /// Reduced models by waves of the components of a blade, or of the parts into which they decouple further, with the index of
    /// the component.
    pub(crate) fn wave_models(&self) -> Vec<(usize, &WaveModel)> {
        let components = self.components.iter().enumerate();
        let by_waves = components.filter_map(|(index, component)| match &component.solution {
            Solution::Waves(modes) => Some(modes.models().map(move |model| (index, model))),
            Solution::Whole | Solution::FreeWaves => None,
        });
        by_waves.flatten().collect()
    }

    /// Finds up to which frequencies modes are needed.
    pub(super) fn find_heights(
        &mut self,
        range: SpeedRange,
        strategy: Strategy,
    ) -> Result<(), SpectrumError> {
        let range = searched_range(&self.critical, range);
        let is_large = self.plate.degrees_of_freedom() >= LARGE;
        let structure = is_large.then(|| self.full.get_or_init(|| FullModel::new(&self.plate)));
        for component in &self.components {
            let guided = Guided {
                system: &component.full,
                structure,
                scale: frequency_scale(&self.plate),
                critical: &self.critical,
                counters: &self.counters,
            };
            let heights = Heights::new(&guided, range, strategy)?;
            self.complete_to_rad_per_s = heights.window_rad_per_s;
            self.reflected_to_rad_per_s = heights.reflected_rad_per_s;
        }
        Ok(())
    }
}
