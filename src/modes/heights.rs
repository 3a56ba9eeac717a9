//! Frequencies up to which the modes of a guided blade are needed.

use std::sync::atomic::Ordering;

use faer::c64;

use super::arnoldi::{lowest_eigenpairs, nearly_lowest_eigenpairs};
use super::chart_height::{CHART_MODES, Strategy, chart_height};
use super::critical_speed::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::full_model::FullModel;
use super::mode::{classify, is_seen, krein_index};
use super::vectors::Eigenpair;
use super::work::WorkCounters;
use crate::model::scene::SpeedRange;
use crate::model::system::GyroscopicSystem;
use crate::model::tuning::Tuned;

/// Modes up to this multiple of the frequency of the highest reflected wave may coalesce with that wave.
pub(super) const REFLECTED_MARGIN: Tuned = Tuned::new("modes/heights::REFLECTED_MARGIN", 1.3);

/// A guided blade with the data for its lowest modes.
pub struct Guided<'a> {
    pub system: &'a GyroscopicSystem,
    /// Blocks and columns of the matrices, if a solve by them costs less than a dense one.
    pub structure: Option<&'a FullModel>,
    /// Frequency scale of the blade, in rad/s.
    pub scale: f64,
    /// Critical speeds, ascending, at least those of the range.
    pub critical: &'a [NamedCriticalSpeed],
    pub counters: &'a WorkCounters,
}

/// Frequencies up to which modes are needed.
#[derive(Debug, Clone, Copy)]
pub struct Heights {
    /// Height of the diagram, at least that of the search; without a diagram that of the search.
    pub window_rad_per_s: f64,
    /// Height of the search for bands, slightly above the highest reflected wave; 0 without reflected waves.
    pub reflected_rad_per_s: f64,
}

impl Heights {
    /// The heights over a range of speeds. Without a diagram and without damping, only waves that can coalesce are needed.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    pub fn new(
        guided: &Guided<'_>,
        range: SpeedRange,
        strategy: Strategy,
    ) -> Result<Self, SpectrumError> {
        let reflected = || guided.reflected_height(range.to_rad_per_s);
        let chart = || guided.chart_height(range.from_rad_per_s);
        if strategy == Strategy::Bands && guided.system.is_conservative() {
            let reflected_rad_per_s = reflected()?;
            let is_none = reflected_rad_per_s == 0.0;
            return Ok(Heights {
                window_rad_per_s: if is_none {
                    chart()?
                } else {
                    reflected_rad_per_s
                },
                reflected_rad_per_s,
            });
        }
        let (reflected, chart) = rayon::join(reflected, chart);
        let (reflected_rad_per_s, chart) = (reflected?, chart?);
        Ok(Heights {
            window_rad_per_s: chart.max(reflected_rad_per_s),
            reflected_rad_per_s,
        })
    }
}

impl Guided<'_> {
    fn lowest_of(
        &self,
        system: &GyroscopicSystem,
        speed: f64,
        count: usize,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.counters.full_solves.fetch_add(1, Ordering::Relaxed);
        let shift = 0.5 * self.scale;
        if let Some(basis) = self.structure
            && let Some(found) = nearly_lowest_eigenpairs(basis, system, speed, count, shift)?
        {
            let structured = &self.counters.structured_solves;
            structured.fetch_add(1, Ordering::Relaxed);
            return Ok(found);
        }
        lowest_eigenpairs(system, speed, count, shift)
    }

    /// Height of a diagram from the modes at a speed, in rad/s.
    fn chart_height(&self, speed: f64) -> Result<f64, SpectrumError> {
        let Guided { system, scale, .. } = *self;
        let is_conservative = system.is_conservative();
        let mut count = CHART_MODES + 2;
        loop {
            let pairs = self.lowest_of(system, speed, count)?;
            let lambdas: Vec<c64> = pairs.iter().map(|(lambda, _)| *lambda).collect();
            let seen = lambdas.iter().filter(|lambda| is_seen(**lambda)).count();
            if is_conservative || seen >= CHART_MODES || 2 * count >= system.order() {
                return Ok(chart_height(&lambdas, is_conservative).unwrap_or(scale));
            }
            // Modes that decay without oscillation are not drawn but are among the computed ones, so that
            // more modes must be computed.
            count *= 2;
        }
    }

    /// Frequency of the highest reflected wave at the top speed, with a margin for waves that may coalesce with
    /// it; 0 below the first critical speed. For a damped blade it is that without damping, because damping destabilizes
    /// reflected waves.
    fn reflected_height(&self, speed: f64) -> Result<f64, SpectrumError> {
        let Guided {
            system,
            scale,
            critical,
            ..
        } = *self;
        let index = critical.partition_point(|c| c.speed_rad_per_s < speed);
        if index == 0 {
            return Ok(0.0);
        }
        let twin = (!system.is_conservative()).then(|| system.conservative());
        let system = twin.as_ref().unwrap_or(system);
        let mut count = CHART_MODES + index;
        loop {
            let pairs = self.lowest_of(system, speed, count)?;
            let modes = classify(system, speed, 0, pairs);
            if krein_index(&modes) >= index || 2 * count >= system.order() {
                let highest = modes.iter().filter(|mode| mode.kind.krein_index() > 0);
                let top = highest.fold(0.0, |top, mode| mode.frequency_rad_per_s().max(top));
                return Ok(REFLECTED_MARGIN.get() * top.max(0.1 * scale));
            }
            count *= 2;
        }
    }
}
