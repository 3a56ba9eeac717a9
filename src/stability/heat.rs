//! Temperature limits of a blade.
//!
//! Let K_T be the geometric stiffness per kelvin of the scene's temperature profile. The lowest critical
//! speed has fallen to the operating speed Ω at the smallest rise that makes K₀ + Ω²(K_σ − N) + rise K_T
//! singular, and the blade buckles at rest at the smallest rise that makes K₀ + rise K_T singular. Both are
//! generalized symmetric eigenproblems in the rise. The two limits suffice for all speeds between, because
//! the squared speeds and rises with positive definite K form a convex set.

use std::sync::atomic::Ordering;

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::model::plate::{MembraneStress, membrane_stiffness};
use crate::model::scene::{Scene, Temperature};
use crate::model::system::spread;
use crate::modes::{
    AddedStress, EventName, NamedCriticalSpeed, SingularStress, SpectralModel, SpectrumError,
    critical_speeds, first_singular, named,
};

/// Temperature rise at which the blade buckles, or its first critical speed falls to the operating speed.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatLimit {
    /// Peak of the temperature profile, in K.
    pub rise_k: f64,
    /// Waves of the shape that buckles or stands still.
    pub name: EventName,
}

/// Critical speed of one wave as a function of temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatCurve {
    /// Waves that stand still at the largest rise of the curve.
    pub name: EventName,
    /// Peaks of the temperature profile, in K.
    pub rise_k: Vec<f64>,
    /// Critical speed at each peak.
    pub speed_rad_per_s: Vec<f64>,
}

/// Temperature rises that the blade tolerates, for the profile of the scene scaled to other peaks.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatLimits {
    /// Limit at which the first critical speed falls to the operating speed, if the scene gives one and the
    /// blade does not buckle first.
    pub operating: Option<HeatLimit>,
    /// Whether the operating speed is above a critical speed of the cold blade.
    pub past_critical: bool,
    /// Limit at which the blade buckles at rest, if any.
    pub buckling: Option<HeatLimit>,
    /// Whether the blade buckles before a critical speed falls to the operating speed.
    pub buckles_first: bool,
    /// Limit above which a blade that is buckled when cold is flat, as with much roll tension.
    pub flat_from: Option<HeatLimit>,
    /// First critical speeds as functions of the peak of the profile.
    pub curves: Vec<HeatCurve>,
}

/// Number of peaks on a curve; a few are enough, because squared critical speeds are nearly linear in the peak.
const RISES: usize = 17;
/// Largest number of curves.
const CURVES: usize = 5;
/// Factor by which the curves extend past the operating limit.
const BEYOND: f64 = 1.25;
/// Share of the buckling limit at which the curves end; at the limit the lowest speed is zero.
const BEFORE_BUCKLING: f64 = 1.0 - 1e-6;

impl HeatLimits {
    /// The limits of a scene and its model; `None` for a scene without temperature.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(scene: &Scene, model: &SpectralModel) -> Result<Option<Self>, SpectrumError> {
        let membrane = scene.membrane();
        let Some(temperature) = membrane.and_then(|m| m.temperature.as_ref()) else {
            return Ok(None);
        };
        let heating = Heating::new(model, temperature);
        let (now_k, hotter) = (heating.now_k, heating.direction);
        let buckling = heating.limit(0.0, now_k, hotter)?;
        let colder = heating.limit(0.0, now_k, -hotter)?;
        let flat_from = colder.filter(|limit| limit.rise_k * hotter > 0.0);
        let (operating, past_critical) = match scene.operating_rad_per_s() {
            Some(speed) => heating.operating(speed)?,
            None => (None, false),
        };
        let before = |buckling: &HeatLimit| {
            let later = |limit: &HeatLimit| buckling.rise_k.abs() < limit.rise_k.abs();
            scene.operating_rad_per_s().is_some()
                && !past_critical
                && operating.as_ref().is_none_or(later)
        };
        let buckles_first = buckling.as_ref().is_some_and(before);
        // Rotation can keep a blade flat that would buckle at rest, so a limit at the operating speed may exist
        // beyond the buckling limit. It is not given if the blade buckles first.
        let operating = operating.filter(|_| !buckles_first);
        let curves = heating.curves(operating.as_ref(), buckling.as_ref())?;
        Ok(Some(HeatLimits {
            operating,
            past_critical,
            buckling,
            buckles_first,
            flat_from,
            curves,
        }))
    }
}

/// A model with variable temperature.
struct Heating<'a> {
    model: &'a SpectralModel,
    /// K_T per kelvin of the peak, for n = 0 … n_max.
    per_kelvin: Vec<DMatrix<f64>>,
    /// Peak of the scene's profile, in K.
    now_k: f64,
    /// Sign of the peak of the scene's profile.
    direction: f64,
}

impl<'a> Heating<'a> {
    fn new(model: &'a SpectralModel, temperature: &Temperature) -> Self {
        let plate = &model.plate;
        let stress = MembraneStress::of_heat(&plate.blade, temperature, 1.0);
        let now_k = temperature.peak_rise_k;
        Heating {
            model,
            per_kelvin: membrane_stiffness(&plate.basis, &stress, 0..=plate.max_diameters()),
            now_k,
            direction: if now_k < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// Counts an eigenproblem.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    fn count(&self) -> Result<(), SpectrumError> {
        let counters = &self.model.counters;
        counters.heat_solves.fetch_add(1, Ordering::Relaxed);
        counters.cancellation.check()
    }

    /// First limit at a speed, for rising or falling temperature from a peak at which K is positive definite.
    fn limit(
        &self,
        speed_rad_per_s: f64,
        from_k: f64,
        direction: f64,
    ) -> Result<Option<HeatLimit>, SpectrumError> {
        let added = AddedStress {
            stiffness: &self.per_kelvin,
            // The stiffness of the model already includes the rise with the peak `now_k`.
            from: from_k - self.now_k,
            direction,
        };
        self.count()?;
        let (plate, components) = (&self.model.plate, &self.model.components);
        let found = first_singular(plate, components, speed_rad_per_s, &added)?;
        let limit = |found: SingularStress| HeatLimit {
            rise_k: from_k + direction * found.multiple,
            name: found.name,
        };
        Ok(found.map(limit))
    }

    /// Limit at the operating speed, and whether this speed is above a critical speed even of the cold blade.
    /// The search starts from the scene's temperature, or from the cold blade if the scene exceeds the limit.
    fn operating(&self, speed: f64) -> Result<(Option<HeatLimit>, bool), SpectrumError> {
        for from_k in [self.now_k, 0.0] {
            match self.limit(speed, from_k, self.direction) {
                Err(SpectrumError::UnstableAtRest { .. }) => (),
                found => return Ok((found?, false)),
            }
        }
        Ok((None, true))
    }

    /// Peaks of the curves, in K, from zero to beyond the limits, denser towards the end, where speeds fall
    /// faster.
    fn rises(&self, operating: Option<&HeatLimit>, buckling: Option<&HeatLimit>) -> Vec<f64> {
        let size = |limit: Option<&HeatLimit>| limit.map(|limit| limit.rise_k.abs());
        let shown = size(operating)
            .map_or(0.0, |rise| BEYOND * rise)
            .max(BEYOND * self.now_k.abs());
        let end = match size(buckling).map(|rise| BEFORE_BUCKLING * rise) {
            Some(buckling) if shown == 0.0 || buckling < BEYOND * shown => buckling,
            _ => shown,
        };
        let share = |k: usize| 1.0 - (1.0 - k as f64 / (RISES - 1) as f64).powi(2);
        let rises = (0..RISES).map(|k| self.direction * end * share(k));
        if end > 0.0 {
            rises.collect()
        } else {
            Vec::new()
        }
    }

    fn curves(
        &self,
        operating: Option<&HeatLimit>,
        buckling: Option<&HeatLimit>,
    ) -> Result<Vec<HeatCurve>, SpectrumError> {
        let rises = self.rises(operating, buckling);
        let speeds: Result<Vec<Vec<NamedCriticalSpeed>>, SpectrumError> = rises
            .par_iter()
            .map(|rise_k| self.first_critical(*rise_k))
            .collect();
        // A wave of a free blade is identified by its number of diameters, a wave of a guided blade by its
        // place among the critical speeds.
        let free = self.model.plate.is_axisymmetric();
        let mut curves: Vec<HeatCurve> = Vec::new();
        for (rise_k, found) in rises.iter().zip(speeds?) {
            for (place, wave) in found.into_iter().enumerate() {
                let diameters = wave.name.diameters();
                let is_same = |curve: &HeatCurve| curve.name.diameters() == diameters;
                let known = if free {
                    curves.iter().position(is_same)
                } else {
                    (place < curves.len()).then_some(place)
                };
                let index = known.unwrap_or_else(|| {
                    curves.push(HeatCurve {
                        name: wave.name.clone(),
                        rise_k: Vec::new(),
                        speed_rad_per_s: Vec::new(),
                    });
                    curves.len() - 1
                });
                // In a guided blade the wave at a place may change with the peak, so that the curve is named
                // by the wave at the last peak.
                curves[index].name = wave.name;
                curves[index].rise_k.push(*rise_k);
                curves[index].speed_rad_per_s.push(wave.speed_rad_per_s);
            }
        }
        Ok(curves)
    }

    /// First critical speeds at a peak, for a free blade one for each number of diameters; none if the blade
    /// has buckled.
    fn first_critical(&self, rise_k: f64) -> Result<Vec<NamedCriticalSpeed>, SpectrumError> {
        self.count()?;
        let plate = &self.model.plate;
        let blocks: Vec<&DMatrix<f64>> = self.per_kelvin.iter().collect();
        let mut lowest = Vec::new();
        let free = plate.is_axisymmetric();
        for (index, component) in self.model.components.iter().enumerate() {
            let range = if free {
                index..=index
            } else {
                0..=plate.max_diameters()
            };
            let mut system = component.full.clone();
            system.stiffness += faer::Scale(rise_k - self.now_k) * spread(plate, range, &blocks);
            let found = match critical_speeds(&system) {
                Ok(found) => found,
                Err(SpectrumError::UnstableAtRest { .. }) => return Ok(Vec::new()),
                Err(error) => return Err(error),
            };
            let kept = if free { 1 } else { CURVES };
            lowest.push(found.into_iter().take(kept).collect());
        }
        let mut found = named(plate, &self.model.components, lowest);
        found.truncate(CURVES);
        Ok(found)
    }
}
