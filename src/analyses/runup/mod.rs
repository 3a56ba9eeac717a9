//! The saw during a run-up: its deflection over the speed, the growth in each band, and the response to a harmonic force.
//!
//! [`runup`](runup()) integrates the motion of the blade under the constant side force while its speed rises, see
//! [`transient`](crate::motion::transient), and reports it beside the bands over the same speeds, each with the growth that its
//! eigenvalue explains.

pub(crate) mod chart;
pub(crate) mod map_chart;
mod options;
mod outline;
mod report;

pub use options::Options;
pub(crate) use outline::outline;
pub use report::{ResponseMap, RunUpBand, RunUpReport, RunUpStretching};

use std::f64::consts::{LN_2, TAU};

use crate::analyses::campbell::InstabilityBand;
use crate::model::plate::Plate;
use crate::model::scene::{Point, RunUpFile, Scene, SceneError, SceneFile, SideForce, rpm};
use crate::modes::Mode;
use crate::modes::branches::Progress;
use crate::motion::transient::{
    StretchedRunUp, TransientError, band_exponents, linear_limit_m, response_map, run_up,
    stretched_run_up,
};
use crate::page::text::shown;
use crate::stability::Analysis;

/// Number of speeds and of frequencies of the response map.
const MAP_SIZE: (usize, usize) = (200, 150);
/// Number of modes at the first speed that the steps resolve and the map shows.
const SHOWN_MODES: usize = 6;
/// Exponent of a motion that doubles.
const DOUBLING: f64 = LN_2;

/// Computes the run-up of the scene.
///
/// # Errors
/// [`TransientError`].
pub fn runup(scene: &Scene, progress: Progress<'_>) -> Result<RunUpReport, TransientError> {
    let runup = scene.needed_runup().map_err(SceneError::from)?;
    let (probe, force) = (scene.probe(), scene.side_force());
    let speeds = runup.speeds();
    let analysis =
        Analysis::new(&scene.swept(speeds)?).map_err(|error| error.due_to("runup.to_rpm", 1.0))?;
    let (model, plate) = (&analysis.model, &analysis.model.plate);
    let modes = model.modes(speeds.from_rad_per_s)?;
    let shown = modes.iter().take(SHOWN_MODES);
    let highest = shown.map(Mode::frequency_rad_per_s).fold(0.0, f64::max);
    let (history, stretching) = if runup.stretching {
        let found = stretched_run_up(plate, (runup, &force), probe, highest, progress)?;
        let stretching = RunUpStretching::new(&found);
        (found.history, Some(stretching))
    } else {
        (
            run_up(plate, (runup, &force), probe, highest, progress)?,
            None,
        )
    };
    let rate = runup.acceleration_rad_per_s2();
    let exponents = band_exponents(model, &analysis.chart.instabilities, rate)?;
    let chart = analysis.report();
    let record_rpm = in_rpm(&history.speed_rad_per_s);
    let linear_until_rpm = history.linear_until_rad_per_s.map(rpm);
    let valid_until_rpm = stretching.as_ref().and_then(|found| found.valid_until_rpm);
    let ends_rpm = linear_until_rpm.or(valid_until_rpm);
    let bands: Vec<RunUpBand> = chart
        .instabilities
        .into_iter()
        .zip(exponents)
        .map(|(band, growth_exponent)| RunUpBand {
            time_s: (band.to_rpm - band.from_rpm) / rpm(rate),
            growth_exponent,
            seen_amplification: if ends_rpm.is_none_or(|end| band.to_rpm < end) {
                seen_amplification(&record_rpm, &history.deflection_m, &band)
            } else {
                None
            },
            band,
        })
        .collect();
    Ok(RunUpReport {
        sawflutter: chart.sawflutter,
        scene: scene.file().clone(),
        condition: chart.condition,
        unusual_numbers: chart.unusual_numbers,
        degrees_of_freedom: chart.accuracy.degrees_of_freedom,
        from_rpm: rpm(speeds.from_rad_per_s),
        to_rpm: rpm(speeds.to_rad_per_s),
        rate_rpm_per_s: rpm(rate),
        step_s: history.step_s,
        linear_limit_m: linear_limit_m(scene.blade()),
        linear_until_rpm,
        rpm: record_rpm,
        deflection_m: history.deflection_m,
        largest_deflection_m: history.largest.deflection_m,
        largest_deflection_rpm: rpm(history.largest.speed_rad_per_s),
        critical_speeds: chart.critical_speeds,
        first_doubling_rpm: first_doubling_rpm(&bands),
        bands,
        stretching,
        campbell: chart.campbell,
        response: ResponseMap::new(plate, runup, &force, probe, highest),
        warnings: chart
            .warnings
            .into_iter()
            .chain(assumed(scene.file()))
            .collect(),
    })
}

/// Remark on a side force that the scene does not have.
fn assumed(scene: &SceneFile) -> Option<String> {
    let typed = scene.side_force.and_then(|force| force.force_n);
    let assumed_n = typed.is_none().then(|| scene.side_force_n())?;
    Some(format!(
        "the scene has no side force; a constant one of {} N {} was assumed, set side_force.force_n",
        shown(assumed_n),
        scene.side_force_place_in_words()
    ))
}

impl ResponseMap {
    /// The response over the speeds of a run-up, up to a frequency.
    fn new(
        plate: &Plate,
        runup: &RunUpFile,
        force: &SideForce,
        probe: Point,
        highest_rad_per_s: f64,
    ) -> Self {
        let (from, to) = (runup.speeds().from_rad_per_s, runup.speeds().to_rad_per_s);
        let speeds = even(from, to, MAP_SIZE.0);
        let frequencies = even(0.0, highest_rad_per_s, MAP_SIZE.1);
        ResponseMap {
            receptance_m_per_n: response_map(plate, (runup, force), probe, (&speeds, &frequencies)),
            rpm: in_rpm(&speeds),
            frequency_hz: in_hz(&frequencies),
        }
    }
}

impl RunUpStretching {
    fn new(found: &StretchedRunUp) -> Self {
        let spectrum = &found.spectrum;
        RunUpStretching {
            shapes: found.shapes,
            largest_slope: found.largest_slope,
            valid_until_rpm: found.valid_until_rad_per_s.map(rpm),
            rpm: in_rpm(&spectrum.speed_rad_per_s),
            frequency_hz: in_hz(&spectrum.frequency_rad_per_s),
            amplitude_m: spectrum.amplitude_m.clone(),
        }
    }
}

/// Evenly spaced values over a range with its ends.
fn even(from: f64, to: f64, count: usize) -> Vec<f64> {
    let shares = (0..count).map(|k| k as f64 / (count - 1) as f64);
    shares.map(|share| from + (to - from) * share).collect()
}

fn in_rpm(rad_per_s: &[f64]) -> Vec<f64> {
    rad_per_s.iter().map(|speed| rpm(*speed)).collect()
}

fn in_hz(rad_per_s: &[f64]) -> Vec<f64> {
    rad_per_s.iter().map(|frequency| frequency / TAU).collect()
}

fn first_doubling_rpm(bands: &[RunUpBand]) -> Option<f64> {
    let doubling = bands.iter().filter(|band| band.growth_exponent > DOUBLING);
    let onsets = doubling.map(|band| band.band.from_rpm);
    onsets.min_by(f64::total_cmp)
}

/// Ratio of the largest deflection in the band to that in an interval of equal length before it.
fn seen_amplification(rpm: &[f64], deflection_m: &[f64], band: &InstabilityBand) -> Option<f64> {
    let largest = |from: f64, to: f64| {
        let record = rpm.iter().zip(deflection_m);
        let within = record.filter(|(speed, _)| (from..=to).contains(*speed));
        within.map(|(_, w)| w.abs()).reduce(f64::max)
    };
    let width = band.to_rpm - band.from_rpm;
    let before = largest(band.from_rpm - width, band.from_rpm)?;
    let inside = largest(band.from_rpm, band.to_rpm)?;
    (before > 0.0).then(|| inside / before)
}
