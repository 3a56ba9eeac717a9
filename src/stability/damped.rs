//! Bands of a damped blade: stretches of a branch with Re λ > 0.
//!
//! Damping leaves no Krein signs to count, so the chart of the undamped twin lends
//! its events as speeds to look at, and each branch is followed with the slope of
//! its growth rate: where two slopes promise a maximum above zero between two
//! speeds, that speed is looked at too.

use faer::c64;
use rayon::prelude::*;

use super::bands::{
    self, Certificate, Instability, InstabilityKind, StabilityChart, with_critical_speeds,
};
use super::peak::maximise;
use super::station::hermite;
use crate::campbell::{self, Branch, Campbell, Progress};
use crate::spectrum::{DescribedMode, Mode, SpectralModel, SpectrumError, Strategy, in_words};

/// Rounds of looking between speeds.
const ROUNDS: usize = 4;
/// Relative accuracy in speed of onsets.
const SPEED_TOLERANCE: f64 = 1e-12;

/// Charts a damped blade.
pub(super) fn chart(
    model: &SpectralModel,
    range: (f64, f64),
    count: usize,
    progress: Progress<'_>,
) -> Result<StabilityChart, SpectrumError> {
    let plate = model.plate.undamped();
    let critical = SpectralModel::critical_speeds(&plate)?;
    let stop = &model.counters.stop;
    let twin = SpectralModel::stoppable(plate, critical, range, Strategy::Reduced, stop)?;
    let mut speeds = with_critical_speeds(&twin, range, campbell::even_speeds(range, count));
    let (undamped, _) = bands::bands(&twin, &speeds)?;
    speeds.extend(
        undamped
            .iter()
            .flat_map(|band| [band.from, band.peak, band.to]),
    );
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let mut samples = campbell::sample(model, &speeds, progress)?;
    for _ in 0..ROUNDS {
        let campbell = Campbell::track(samples.clone(), model.complete_to_rad_per_s);
        let mut doubtful: Vec<f64> = campbell
            .branches
            .par_iter()
            .flat_map_iter(|branch| doubtful_speeds(model, &campbell, branch))
            .collect();
        doubtful.sort_by(f64::total_cmp);
        doubtful.dedup();
        doubtful.retain(|s| samples.iter().all(|sample| sample.speed_rad_per_s != *s));
        if doubtful.is_empty() {
            break;
        }
        samples.extend(campbell::sample(model, &doubtful, &|_, _| ())?);
    }
    let campbell = Campbell::track(samples, model.complete_to_rad_per_s);
    let found: Result<Vec<Vec<Instability>>, SpectrumError> = campbell
        .branches
        .par_iter()
        .map(|branch| unstable_stretches(model, &campbell, branch))
        .collect();
    let mut instabilities: Vec<Instability> = found?.into_iter().flatten().collect();
    instabilities.sort_by(|x, y| x.from.total_cmp(&y.from));
    Ok(StabilityChart {
        campbell,
        instabilities,
        certificate: Certificate::default(),
    })
}

/// A point of a branch.
struct Point<'a> {
    speed: f64,
    described: &'a DescribedMode,
}

impl Point<'_> {
    fn growth(&self) -> f64 {
        self.described.mode.lambda.re
    }
}

fn points<'a>(campbell: &'a Campbell, branch: &Branch) -> Vec<Point<'a>> {
    branch
        .points
        .iter()
        .map(|&(sample, mode)| Point {
            speed: campbell.samples[sample].speed_rad_per_s,
            described: &campbell.samples[sample].modes[mode],
        })
        .collect()
}

/// Speeds between two stable points at which the cubic through growth rates and
/// their slopes comes above zero.
fn doubtful_speeds(model: &SpectralModel, campbell: &Campbell, branch: &Branch) -> Vec<f64> {
    let points = points(campbell, branch);
    let slope = |p: &Point<'_>| model.eigenvalue_slope(p.speed, &p.described.mode).re;
    points
        .windows(2)
        .filter(|pair| pair[0].growth() <= 0.0 && pair[1].growth() <= 0.0)
        .filter_map(|pair| {
            let width = pair[1].speed - pair[0].speed;
            let (rise, fall) = (slope(&pair[0]) * width, slope(&pair[1]) * width);
            if rise <= 0.0 || fall >= 0.0 || width < 1e-9 * pair[1].speed {
                return None;
            }
            let cubic = |t: f64| hermite(t, pair[0].growth(), rise, pair[1].growth(), fall);
            let top = (1..32)
                .map(|k| f64::from(k) / 32.0)
                .max_by(|x, y| cubic(*x).total_cmp(&cubic(*y)))?;
            (cubic(top) > 0.0).then_some(pair[0].speed + top * width)
        })
        .collect()
}

fn unstable_stretches(
    model: &SpectralModel,
    campbell: &Campbell,
    branch: &Branch,
) -> Result<Vec<Instability>, SpectrumError> {
    let points = points(campbell, branch);
    // Rounding of λ is relative to the blade's frequencies, not to a vanishing λ.
    let noise = 1e-10 * model.complete_to_rad_per_s;
    let mut stretches = Vec::new();
    let mut start: Option<(usize, f64, bool)> = None;
    for index in 0..points.len() {
        let unstable = points[index].growth() > noise;
        match start {
            None if unstable => {
                let onset = match index.checked_sub(1) {
                    Some(before) => (crossing(model, &points[before], &points[index])?, true),
                    None => (points[index].speed, false),
                };
                start = Some((index, onset.0, onset.1));
            }
            Some((first, from, begins)) if !unstable => {
                let to = crossing(model, &points[index], &points[index - 1])?;
                stretches.push(stretch(model, &points[first..index], (from, to), begins)?);
                start = None;
            }
            _ => {}
        }
    }
    if let (Some((first, from, _)), Some(last)) = (start, points.last()) {
        stretches.push(stretch(model, &points[first..], (from, last.speed), false)?);
    }
    Ok(stretches)
}

/// Speed of Re λ = 0 between a stable and an unstable point: false position.
fn crossing(
    model: &SpectralModel,
    stable: &Point<'_>,
    unstable: &Point<'_>,
) -> Result<f64, SpectrumError> {
    let (mut low, mut high) = (
        (stable.speed, stable.described.mode.clone()),
        (unstable.speed, unstable.described.mode.clone()),
    );
    let (mut g_low, mut g_high) = (low.1.lambda.re, high.1.lambda.re);
    for step in 0..60 {
        if (high.0 - low.0).abs() <= SPEED_TOLERANCE * high.0.abs() || g_low >= 0.0 {
            break;
        }
        let share = if step % 4 == 3 {
            0.5
        } else {
            (g_low / (g_low - g_high)).clamp(1e-3, 0.999)
        };
        let speed = low.0 + share * (high.0 - low.0);
        let guess = low.1.lambda * (1.0 - share) + high.1.lambda * share;
        let Some(mode) = nearest(model, speed, guess, high.1.part)? else {
            break;
        };
        // Illinois: an end that stays counts half.
        if mode.lambda.re > 0.0 {
            g_high = mode.lambda.re;
            high = (speed, mode);
            g_low *= 0.5;
        } else {
            g_low = mode.lambda.re;
            low = (speed, mode);
            g_high *= 0.5;
        }
    }
    Ok(high.0)
}

/// The mode of a part with the eigenvalue next to a guess.
fn nearest(
    model: &SpectralModel,
    speed: f64,
    guess: c64,
    part: usize,
) -> Result<Option<Mode>, SpectrumError> {
    let distance = |m: &Mode| (m.lambda - guess).norm();
    let modes = model.all_modes(speed)?;
    let same_part = modes.into_iter().filter(|m| m.part == part);
    Ok(same_part.min_by(|x, y| distance(x).total_cmp(&distance(y))))
}

/// The band of one unstable stretch.
fn stretch(
    model: &SpectralModel,
    points: &[Point<'_>],
    (from, to): (f64, f64),
    closed: bool,
) -> Result<Instability, SpectrumError> {
    let interpolated = |speed: f64| -> (c64, usize) {
        let place = points
            .partition_point(|p| p.speed < speed)
            .min(points.len() - 1);
        let mode = &points[place].described.mode;
        (mode.lambda, mode.part)
    };
    let at = |speed: f64| -> Result<c64, SpectrumError> {
        let (guess, part) = interpolated(speed);
        Ok(nearest(model, speed, guess, part)?.map_or(guess, |m| m.lambda))
    };
    let (found, value) = maximise((from, to), [closed; 2], |speed| Ok(at(speed)?.re))?;
    let best = points
        .iter()
        .max_by(|x, y| x.growth().total_cmp(&y.growth()));
    let peak = best
        .filter(|p| p.growth() > value)
        .map_or(found, |p| p.speed);
    let lambda = at(peak)?;
    let first = &points[0].described.name;
    Ok(Instability {
        kind: if lambda.im == 0.0 {
            InstabilityKind::Divergence
        } else {
            InstabilityKind::Flutter
        },
        from,
        to,
        closed,
        peak,
        peak_growth_per_s: lambda.re,
        frequency: lambda.im,
        modes: vec![in_words(first.diameters, first.circles, first.direction)],
    })
}
