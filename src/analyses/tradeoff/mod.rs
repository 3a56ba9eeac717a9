//! Measured run time against true error, for several methods and sizes of the basis.

pub mod chart;
mod setting;

use std::time::Instant;

pub use setting::{Method, Setting};

use crate::model::plate::{Plate, Resolution};
use crate::model::scene::Scene;
use crate::modes::branches::Progress;
use crate::modes::{Assembled, NamedCriticalSpeed, SpectralModel, Strategy};
use crate::stability::{
    AnalysisError, ChosenBasis, Depth, InstabilityKind, LADDER, PAST_THE_RANGE, chart_to_depth,
    diameters_beyond, resolution,
};

/// Sizes of the basis that are measured: those of errors down to a few hundred-thousandths. Each larger one takes twice as long.
const SIZES: &[(usize, usize)] = LADDER.split_at(7).0;
/// Number of sizes for [`Method::Reduced`]: the proof takes a growing part of the time of a chart.
const PROVEN_SIZES: usize = 6;
/// Number of sizes for [`Method::Dense`], which takes a hundred times as long as [`Method::Reduced`].
const DENSE_SIZES: usize = 1;
/// Size of the reference for errors: two steps beyond the largest size, where the error is a tenth.
const TRUTH: (usize, usize) = LADDER[SIZES.len() + 1];
/// Number of even speeds of a chart.
const SPEEDS: usize = 51;
/// Other numbers of even speeds, measured at [`MIDDLE_SIZE`] alone.
const OTHER_SPEEDS: [usize; 2] = [25, 201];
const MIDDLE_SIZE: (usize, usize) = (14, 9);
/// Errors within this factor are equal, because the number of speeds changes the last digits.
const SAME_ERROR: f64 = 1.01;
/// Run times up to this, in seconds, are measured [`TIMES`] times, and the shortest counts.
const SHORT_S: f64 = 1.0;
const TIMES: usize = 3;

/// Critical speeds and flutter onsets of one method, in rad/s.
struct Events {
    critical: Vec<f64>,
    onsets: Vec<f64>,
}

/// Measures run time and true error of every method and basis size for a saw.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails.
pub fn tradeoff(scene: &Scene, progress: Progress<'_>) -> Result<Vec<Setting>, AnalysisError> {
    let chosen = ChosenBasis::new(scene, 1e-3)?;
    // Every size contains the waves that stand still within the range.
    let needed = diameters_beyond(chosen.saw.plate.resolution);
    let sized =
        |(diameters, functions): (usize, usize)| resolution((needed.max(diameters), functions));
    let mut runs: Vec<(Method, (usize, usize), usize)> = Vec::new();
    let mut add = |method: Method, sizes: &[(usize, usize)], speeds: usize| {
        runs.extend(sizes.iter().map(|size| (method, *size, speeds)));
    };
    add(Method::Reduced, &SIZES[..PROVEN_SIZES], SPEEDS);
    add(Method::Searched, SIZES, SPEEDS);
    for speeds in OTHER_SPEEDS {
        add(Method::Reduced, &[MIDDLE_SIZE], speeds);
    }
    add(Method::Dense, &SIZES[..DENSE_SIZES], SPEEDS);
    add(Method::CriticalSpeeds, SIZES, 0);
    let count = runs.len() + 1;
    let truth = events(scene, Method::Searched, sized(TRUTH), SPEEDS, &chosen)?;
    progress(1, count);
    let mut settings = Vec::new();
    for (done, (method, size, speeds)) in runs.into_iter().enumerate() {
        let resolution = sized(size);
        let timed = || -> Result<(Events, f64), AnalysisError> {
            let start = Instant::now();
            let found = events(scene, method, resolution, speeds, &chosen)?;
            Ok((found, start.elapsed().as_secs_f64()))
        };
        let (found, mut seconds) = timed()?;
        for _ in 1..TIMES {
            if seconds <= SHORT_S {
                seconds = timed()?.1.min(seconds);
            }
        }
        settings.push(Setting {
            method,
            max_diameters: resolution.max_diameters,
            radial_functions: resolution.radial_functions_on(scene.blade()),
            functions: resolution.degrees_of_freedom_on(scene.blade()),
            speeds,
            seconds,
            error: found.error(&truth),
            on_front: false,
        });
        progress(done + 2, count);
    }
    mark_front(&mut settings);
    Ok(settings)
}

fn mark_front(settings: &mut [Setting]) {
    for k in 0..settings.len() {
        let beaten = settings.iter().any(|other| {
            other.is_chart()
                && other.seconds < settings[k].seconds
                && other.error < SAME_ERROR * settings[k].error
        });
        settings[k].on_front = settings[k].is_chart() && !beaten;
    }
}

fn events(
    scene: &Scene,
    method: Method,
    resolution: Resolution,
    speeds: usize,
    chosen: &ChosenBasis,
) -> Result<Events, AnalysisError> {
    let range = chosen.range_rad_per_s;
    let plate = Plate::new(scene, resolution);
    let below = |critical: &[NamedCriticalSpeed]| -> Vec<f64> {
        let speeds = critical.iter().map(|c| c.speed_rad_per_s);
        speeds
            .take_while(|speed| *speed <= range.to_rad_per_s)
            .collect()
    };
    let strategy = match method {
        Method::CriticalSpeeds => {
            return Ok(Events {
                critical: below(
                    &Assembled::from(plate).critical_speeds(Some(&|_| range.to_rad_per_s))?,
                ),
                onsets: Vec::new(),
            });
        }
        Method::Reduced | Method::Searched => Strategy::Reduced,
        Method::Dense => Strategy::Dense,
    };
    let depth = match method {
        Method::Searched => Depth::Counts,
        _ => Depth::Proof,
    };
    let saw = Assembled::from(plate);
    let critical = saw.critical_speeds(Some(&|_| PAST_THE_RANGE * range.to_rad_per_s))?;
    let model = SpectralModel::with_critical(saw, critical, range, strategy)?;
    let bands = chart_to_depth(&model, range, speeds, depth, &|_, _| ())?.instabilities;
    let flutter = bands
        .iter()
        .filter(|band| band.kind == InstabilityKind::Flutter);
    Ok(Events {
        critical: below(&model.critical),
        onsets: flutter.map(|band| band.from_rad_per_s).collect(),
    })
}

impl Events {
    /// Largest relative distance of a reference event from the nearest event found.
    fn error(&self, truth: &Events) -> f64 {
        let worst = |found: &[f64], truth: &[f64]| {
            let nearest = |t: &f64| {
                let distances = found.iter().map(|f| (f / t - 1.0).abs());
                distances.fold(1.0, f64::min)
            };
            truth.iter().map(nearest).fold(0.0, f64::max)
        };
        let critical = worst(&self.critical, &truth.critical);
        if self.onsets.is_empty() {
            return critical;
        }
        critical.max(worst(&self.onsets, &truth.onsets))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting(method: Method, seconds: f64, error: f64) -> Setting {
        Setting {
            method,
            max_diameters: 8,
            radial_functions: 5,
            functions: 85,
            speeds: 51,
            seconds,
            error,
            on_front: false,
        }
    }

    #[test]
    fn the_front_has_the_charts_that_no_other_beats_in_time_and_error() {
        let mut settings = [
            setting(Method::Reduced, 1.0, 1e-2),
            setting(Method::Reduced, 2.0, 1e-3),
            setting(Method::Dense, 3.0, 2e-3),
            setting(Method::CriticalSpeeds, 0.1, 1e-5),
            setting(Method::Reduced, 2.5, 0.9999e-3),
        ];
        mark_front(&mut settings);
        let front = [true, true, false, false, false];
        assert_eq!(settings.map(|s| s.on_front), front);
    }
}
