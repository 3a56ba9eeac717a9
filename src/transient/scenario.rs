//! Complete computations of a cut and of a run-up.

use crate::campbell::{Progress, even_speeds};
use crate::plate::Plate;
use crate::scene::{Accuracy, Cut, CutRun, RunUpFile, Scene, SceneError, SpeedRange};
use crate::spectrum::{Mode, Work};
use crate::stability::{Analysis, ChosenBasis};

use super::band_growth::band_exponents;
use super::cut::cut_history;
use super::on_spline::on_spline;
use super::response::{ResponseMap, response_map};
use super::runup::{RunUpHistory, run_up};
use super::saw_in_cut::SawInCut;
use super::stretched_runup::{StretchedRunUp, stretched_run_up};
use super::teeth::tooth_passing;
use super::verdict_map::verdict_map;
use super::{CutHistory, OnSpline, ToothPassing, TransientError, VerdictMap};

/// A cut at some speeds.
#[derive(Debug)]
pub struct Cutting {
    /// Scene of the saw.
    pub scene: Scene,
    /// The saw without the forces of the cut, on a basis that satisfies the tolerance of the scene.
    pub plate: Plate,
    /// Teeth and times of the cut.
    pub cut: Cut,
    /// Results, one entry for each speed.
    pub(crate) runs: Vec<CuttingRun>,
}

/// One speed of a cut.
#[derive(Debug, Clone)]
pub(crate) struct CuttingRun {
    /// Eigenvalues and time history.
    pub history: CutHistory,
    /// Effect of the passing teeth.
    pub passing: ToothPassing,
    /// Growth over guide angle and load.
    pub map: VerdictMap,
    /// Reaction of the spline teeth; `None` unless the scene has the block `spline`.
    pub spline: Option<OnSpline>,
}

/// Smallest number of tooth positions within a pitch. With 42 teeth the growth rate changes by 0.03 % from 8 to
/// 16 positions.
const STAGES: usize = 8;
/// Largest angle between tooth positions. With 4 teeth the growth rate changes by up to 0.5 % from 32 positions
/// on.
const STAGE_DEG: f64 = 1.1;
/// Largest angle by which the map moves the guides to either side.
const MAP_TURN_DEG: f64 = 30.0;
/// Highest load level of the map.
const MAP_LOAD: f64 = 1.5;

/// Steps of the map in degrees and in load level. With 400 eigenproblems per speed the map is most of the
/// work of a cut; a draft has 91.
fn map_steps(accuracy: Accuracy) -> (f64, f64) {
    match accuracy {
        Accuracy::Draft => (5.0, 0.25),
        Accuracy::Design | Accuracy::Reference => (2.5, 0.1),
    }
}

/// Number of parts of the computation at one speed: the saw under the forces, time history, teeth and map.
const PARTS: usize = 4;

impl Cutting {
    /// Computes the scene's cut at the speeds and under the forces of `runs`, see [`Cut::runs_at`].
    ///
    /// # Errors
    /// [`TransientError`].
    pub fn new(
        scene: &Scene,
        runs: &[CutRun],
        progress: Progress<'_>,
    ) -> Result<Self, TransientError> {
        let cut = scene.needed_cut().map_err(SceneError::from)?;
        let plate = chosen_plate(scene, runs)?;
        let (turn_deg, level) = map_steps(scene.accuracy());
        let turns: Vec<f64> = match scene.guides().is_empty() {
            // Without guides the map has no guide angle to vary.
            true => vec![0.0],
            false => even(-MAP_TURN_DEG, MAP_TURN_DEG, turn_deg)
                .into_iter()
                .map(f64::to_radians)
                .collect(),
        };
        let levels = even(0.0, MAP_LOAD, level);
        let stage_count = (cut.teeth.pitch_rad.to_degrees() / STAGE_DEG).ceil() as usize;
        let stages = STAGES.max(stage_count);
        let points = turns.len() * levels.len();
        let parts = Work::of("parts of the cut", PARTS * runs.len());
        let runs = runs
            .iter()
            .enumerate()
            .map(|(index, run)| {
                let of = |done: usize, _| progress(index * points + done, runs.len() * points);
                let saw = SawInCut::new(&plate, cut, run)?;
                parts.advance();
                let history = cut_history(&saw, scene.probe())?;
                parts.advance();
                let passing = tooth_passing(&saw, scene.probe(), stages)?;
                parts.advance();
                let spline = on_spline(scene, &plate, cut, run)?;
                let map = verdict_map(&saw, (&turns, &levels), &of)?;
                parts.advance();
                Ok(CuttingRun {
                    history,
                    passing,
                    map,
                    spline,
                })
            })
            .collect::<Result<Vec<_>, TransientError>>()?;
        Ok(Cutting {
            scene: scene.clone(),
            plate,
            cut: cut.clone(),
            runs,
        })
    }
}

/// The plate on a basis that satisfies the scene's tolerance up to the fastest cut.
fn chosen_plate(scene: &Scene, runs: &[CutRun]) -> Result<Plate, TransientError> {
    let fastest = runs
        .iter()
        .map(|run| run.speed_rad_per_s)
        .fold(0.0, f64::max);
    let to_rad_per_s = scene.sweep().map_or(0.0, |sweep| sweep.to_rad_per_s);
    let swept = scene.idling()?.swept(SpeedRange {
        from_rad_per_s: 0.0,
        to_rad_per_s: to_rad_per_s.max(fastest),
    })?;
    Ok(ChosenBasis::new(&swept, scene.tolerance())?.saw.plate)
}

/// A run-up through a range of speeds.
#[derive(Debug)]
pub struct RunningUp {
    /// Scene of the saw.
    pub scene: Scene,
    /// Speeds, duration and force of the run-up.
    pub runup: RunUpFile,
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
        let swept = scene.swept(runup.speeds())?;
        let analysis = Analysis::new(&swept)?;
        let model = &analysis.model;
        let modes = model.modes(runup.speeds().from_rad_per_s)?;
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
        let (from, to) = (runup.speeds().from_rad_per_s, runup.speeds().to_rad_per_s);
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

/// Evenly spaced values over a range with its ends, a step apart.
fn even(from: f64, to: f64, step: f64) -> Vec<f64> {
    even_speeds((from, to), 1 + ((to - from) / step).round() as usize)
}
