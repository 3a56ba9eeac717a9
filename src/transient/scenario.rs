//! Complete computation of a run-up.

use crate::campbell::Progress;
use crate::scene::{RunUp, Scene, SceneError};
use crate::spectrum::Mode;
use crate::stability::Analysis;

use super::TransientError;
use super::band_growth::band_exponents;
use super::response::{ResponseMap, response_map};
use super::runup::{RunUpHistory, run_up};
use super::stretched_runup::{StretchedRunUp, stretched_run_up};

/// A run-up through a range of speeds.
#[derive(Debug)]
pub struct RunningUp {
    /// Scene of the saw.
    pub scene: Scene,
    /// Speeds, duration and force of the run-up.
    pub runup: RunUp,
    /// Modes and bands over the speeds of the run-up.
    pub analysis: Analysis,
    /// Deflection at the probe.
    pub(crate) history: RunUpHistory,
    /// Results with stretching; `None` unless the scene has `runup.stretching`.
    pub(crate) stretched: Option<StretchedRunUp>,
    /// Exponent ∫ Re λ dt of each band of the analysis, over the time in the band.
    pub growth_exponents: Vec<f64>,
    /// Receptance over speed and frequency.
    pub(crate) response: ResponseMap,
}

/// Number of speeds and of frequencies of the response map.
const MAP_SIZE: (usize, usize) = (200, 150);
/// Number of modes at the first speed that the steps resolve and the map shows.
const SHOWN_MODES: usize = 6;

impl RunningUp {
    /// Computes the run-up of the scene.
    ///
    /// # Errors
    /// [`TransientError`].
    pub fn new(scene: &Scene, progress: Progress<'_>) -> Result<Self, TransientError> {
        let runup = scene.needed_runup().map_err(SceneError::from)?;
        let swept = scene.swept(runup.speeds)?;
        let analysis = Analysis::new(&swept)?;
        let model = &analysis.model;
        let modes = model.modes(runup.speeds.from_rad_per_s)?;
        let highest = modes
            .iter()
            .map(Mode::frequency_rad_per_s)
            .take(SHOWN_MODES)
            .fold(0.0, f64::max);
        let plate = &model.plate;
        let (history, stretched) = match runup.stretching {
            false => (
                run_up(plate, runup, scene.probe(), highest, progress)?,
                None,
            ),
            true => {
                let found = stretched_run_up(plate, runup, scene.probe(), highest, progress)?;
                (found.history.clone(), Some(found))
            }
        };
        let rate = runup.acceleration_rad_per_s2();
        let growth_exponents = band_exponents(model, &analysis.chart.instabilities, rate)?;
        let (from, to) = (runup.speeds.from_rad_per_s, runup.speeds.to_rad_per_s);
        let share = |k: usize, of: usize| k as f64 / (of - 1) as f64;
        let speeds: Vec<f64> = (0..MAP_SIZE.0)
            .map(|k| from + (to - from) * share(k, MAP_SIZE.0))
            .collect();
        let frequencies: Vec<f64> = (0..MAP_SIZE.1)
            .map(|k| highest * share(k, MAP_SIZE.1))
            .collect();
        let response = response_map(plate, runup, scene.probe(), (&speeds, &frequencies));
        Ok(RunningUp {
            scene: scene.clone(),
            runup: *runup,
            history,
            stretched,
            growth_exponents,
            response,
            analysis,
        })
    }
}
