//! The stability chart of a saw: samples, branches and bands of a range of speeds.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::damped;
use super::finder::{CRITICAL_GAP, CRITICAL_GROUP, Event, Finder};
use super::refine;
use super::station::{Sign, Station};
use crate::campbell::{self, Campbell, Progress, SpeedSample};
use crate::spectrum::{SpectralModel, SpectrumError, in_words};

/// Kind of an instability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InstabilityKind {
    /// Exponential growth without oscillation.
    Divergence,
    /// Growing oscillation.
    Flutter,
}

/// A band of unstable speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Instability {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// Onset, in rad/s.
    pub from: f64,
    /// End, or the end of the range.
    pub to: f64,
    /// False when the range begins or ends inside the band.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak: f64,
    /// Largest growth rate.
    pub peak_growth_per_s: f64,
    /// Frequency at the peak, in rad/s.
    pub frequency: f64,
    /// The modes that meet.
    pub modes: Vec<String>,
}

/// Proof that the chart missed nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Certificate {
    /// Number of speeds at which the Krein index was compared.
    pub speeds_checked: usize,
    /// Speeds at which it did not match, not even on the whole basis, in rad/s.
    pub violations: Vec<f64>,
}

/// Everything about the stability of a saw over a range of speeds.
#[derive(Debug, Clone)]
pub struct StabilityChart {
    /// Modes and branches.
    pub campbell: Campbell,
    /// Bands by onset.
    pub instabilities: Vec<Instability>,
    /// Krein index against spectrum.
    pub certificate: Certificate,
}

/// Charts a range of speeds, sampled at `count` even speeds and where it matters.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn chart(
    model: &SpectralModel,
    range: (f64, f64),
    count: usize,
    progress: Progress<'_>,
) -> Result<StabilityChart, SpectrumError> {
    if !model.is_conservative() {
        return damped::chart(model, range, count, progress);
    }
    let speeds = with_critical_speeds(model, range, campbell::even_speeds(range, count));
    let mut samples = campbell::sample(model, &speeds, progress)?;
    let (instabilities, certificate) = bands(model, &speeds)?;
    let between = inside(&instabilities, &samples);
    samples.extend(campbell::sample(model, &between, &|_, _| ())?);
    Ok(StabilityChart {
        campbell: Campbell::track(samples),
        instabilities,
        certificate,
    })
}

/// Every band of an undamped blade in a range of speeds, searched from `count` even
/// speeds and both sides of every critical one, and the proof that none is missing.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn undamped_bands(
    model: &SpectralModel,
    range: (f64, f64),
    count: usize,
) -> Result<(Vec<Instability>, Certificate), SpectrumError> {
    bands(
        model,
        &with_critical_speeds(model, range, campbell::even_speeds(range, count)),
    )
}

/// Every band between the first and the last of the speeds.
pub(super) fn bands(
    model: &SpectralModel,
    speeds: &[f64],
) -> Result<(Vec<Instability>, Certificate), SpectrumError> {
    let finder = Finder::new(model);
    let stations = finder.stations(speeds)?;
    let mut instabilities = Vec::new();
    // Nothing couples the waves of a free blade, so they cross and never merge.
    if !model.plate.is_axisymmetric() {
        let events = finder.events(&stations)?;
        instabilities.extend(divergence(model, &finder, &stations, &events)?);
        instabilities.extend(close_pairs(model, &finder, speeds)?);
        instabilities.extend(flutter(model, &finder, &stations, events)?);
        instabilities.sort_by(|x, y| x.from.total_cmp(&y.from));
    }
    Ok((instabilities, finder.certificate()))
}

/// The speeds, and both sides of each group of critical speeds in the range, and the
/// middle between groups.
pub(super) fn with_critical_speeds(
    model: &SpectralModel,
    range: (f64, f64),
    mut speeds: Vec<f64>,
) -> Vec<f64> {
    if model.plate.is_axisymmetric() {
        // A wave of the free blade runs through zero without diverging; a speed so
        // close to that zero that its sign is rounding says nothing.
        let clear = |s: &f64| {
            model
                .critical
                .iter()
                .all(|c| (s / c.speed_rad_per_s - 1.0).abs() > 1e-5)
        };
        speeds.retain(clear);
        return speeds;
    }
    let mut sides: Vec<f64> = Vec::new();
    let mut previous: Option<f64> = None;
    for critical in &model.critical {
        let speed = critical.speed_rad_per_s;
        let (below, above) = (speed * (1.0 - CRITICAL_GAP), speed * (1.0 + CRITICAL_GAP));
        if below <= range.0 || above >= range.1 {
            continue;
        }
        match previous {
            Some(last) if speed <= last * (1.0 + CRITICAL_GROUP) => {
                sides.pop();
            }
            Some(last) => sides.extend([0.5 * (last + below), below]),
            None => sides.push(below),
        }
        sides.push(above);
        previous = Some(speed);
    }
    let near = CRITICAL_GAP + CRITICAL_GROUP;
    speeds.retain(|s| {
        model
            .critical
            .iter()
            .all(|c| (s / c.speed_rad_per_s - 1.0).abs() > near)
    });
    speeds.extend(sides);
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// Speeds inside and at the edges of the bands, so that the narrowest one is drawn.
pub(super) fn inside(instabilities: &[Instability], samples: &[SpeedSample]) -> Vec<f64> {
    let mut speeds: Vec<f64> = instabilities
        .iter()
        .flat_map(|band| {
            let at = |share: f64| band.from + share * (band.to - band.from);
            [0.01, 0.1, 0.3, 0.7, 0.9, 0.99]
                .map(at)
                .into_iter()
                .chain([band.peak])
        })
        .collect();
    speeds.retain(|s| samples.iter().all(|sample| sample.speed_rad_per_s != *s));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// Stretches of speed with a real λ > 0. They begin and end at critical speeds, or where
/// two real λ meet and go on as flutter.
fn divergence(
    model: &SpectralModel,
    finder: &Finder<'_>,
    stations: &[Station],
    events: &[Vec<Event>],
) -> Result<Vec<Instability>, SpectrumError> {
    let mut bands = Vec::new();
    let unstable = |s: &Station| s.count(Sign::Real) > 0;
    let mut start = None;
    for (index, station) in stations.iter().enumerate() {
        if unstable(station) && start.is_none() {
            start = Some(index);
        }
        let last = index + 1 == stations.len();
        if let Some(first) = start
            && (last || !unstable(&stations[index + 1]))
            && unstable(station)
        {
            let (from, begins) = edge(model, stations, events, first.checked_sub(1), first);
            let (to, ends) = edge(model, stations, events, (!last).then_some(index + 1), index);
            let growth =
                |speed: f64| Ok(finder.station(speed)?.divergence().unwrap_or(0.0).powi(2));
            let (peak, square) = refine::maximise((from, to), begins && ends, growth)?;
            bands.push(Instability {
                kind: InstabilityKind::Divergence,
                from,
                to,
                closed: begins && ends,
                peak,
                peak_growth_per_s: square.sqrt(),
                frequency: 0.0,
                modes: standing_waves(model, from, to),
            });
            start = None;
        }
    }
    Ok(bands)
}

/// Divergence between two critical speeds that the stations pass in one step. Where the
/// number of negative directions of K(Ω) is odd there is a real λ > 0.
fn close_pairs(
    model: &SpectralModel,
    finder: &Finder<'_>,
    speeds: &[f64],
) -> Result<Vec<Instability>, SpectrumError> {
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Ok(Vec::new());
    };
    let close = |pair: &[f64]| (1e-12..=CRITICAL_GROUP).contains(&(pair[1] / pair[0] - 1.0));
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let mut bands = Vec::new();
    for (below, pair) in critical.windows(2).enumerate() {
        if below % 2 == 1 || pair[0] < first || pair[1] > last || !close(pair) {
            continue;
        }
        let peak = 0.5 * (pair[0] + pair[1]);
        bands.push(Instability {
            kind: InstabilityKind::Divergence,
            from: pair[0],
            to: pair[1],
            closed: true,
            peak,
            peak_growth_per_s: finder.divergence(peak)?,
            frequency: 0.0,
            modes: standing_waves(model, pair[0], pair[1]),
        });
    }
    Ok(bands)
}

/// Where divergence begins or ends between a stable and an unstable station: at the
/// critical speed or the meeting of two real λ between them, or at the end of the range.
fn edge(
    model: &SpectralModel,
    stations: &[Station],
    events: &[Vec<Event>],
    stable: Option<usize>,
    unstable: usize,
) -> (f64, bool) {
    let inner = stations[unstable].speed_rad_per_s;
    let Some(stable) = stable else {
        return (inner, false);
    };
    let outer = stations[stable].speed_rad_per_s;
    let (low, high) = (inner.min(outer), inner.max(outer));
    let mut critical = model.critical.iter().map(|c| c.speed_rad_per_s);
    let mut meetings = events[stable.min(unstable)]
        .iter()
        .filter_map(|event| match event {
            Event::Begin(edge) | Event::End(edge) if edge.real => Some(edge.speed_rad_per_s),
            _ => None,
        });
    let meeting = if stable < unstable {
        meetings.next_back()
    } else {
        meetings.next()
    };
    let critical = critical.find(|c| (low..=high).contains(c));
    (critical.or(meeting).unwrap_or(inner), true)
}

fn standing_waves(model: &SpectralModel, from: f64, to: f64) -> Vec<String> {
    let mut names: Vec<String> = model
        .critical
        .iter()
        .filter(|c| {
            (from * (1.0 - CRITICAL_GAP)..=to * (1.0 + CRITICAL_GAP)).contains(&c.speed_rad_per_s)
        })
        .map(|c| in_words(c.diameters, c.circles, crate::spectrum::Direction::Standing))
        .collect();
    names.truncate(2);
    names
}

/// Bands in which a + and a − mode have merged.
fn flutter(
    model: &SpectralModel,
    finder: &Finder<'_>,
    stations: &[Station],
    events: Vec<Vec<Event>>,
) -> Result<Vec<Instability>, SpectrumError> {
    let Some((first, last)) = stations.first().zip(stations.last()) else {
        return Ok(Vec::new());
    };
    // Pairs merged at the current speed, by frequency, with where they began.
    let begun = first.speed_rad_per_s;
    let mut open: Vec<(f64, bool)> = first.merged().map(|_| (begun, false)).collect();
    let mut ranges: Vec<(f64, f64, bool)> = Vec::new();
    for events in events {
        for event in events {
            match event {
                Event::Begin(edge) => {
                    open.insert(edge.index.min(open.len()), (edge.speed_rad_per_s, true));
                }
                Event::End(edge) if edge.index < open.len() => {
                    let (from, begins) = open.remove(edge.index);
                    ranges.push((from, edge.speed_rad_per_s, begins));
                }
                Event::End(_) => {}
                Event::Band(from, to) => ranges.push((from, to, true)),
            }
        }
    }
    ranges.extend(
        open.iter()
            .map(|(from, _)| (*from, last.speed_rad_per_s, false)),
    );
    ranges
        .into_par_iter()
        .map(|(from, to, closed)| band(model, finder, from, to, closed))
        .collect()
}

fn band(
    model: &SpectralModel,
    finder: &Finder<'_>,
    from: f64,
    to: f64,
    closed: bool,
) -> Result<Instability, SpectrumError> {
    let finder = finder.narrowed(from, to)?;
    let ends = [from + 0.01 * (to - from), to - 0.01 * (to - from)];
    let mut frequencies = [0.0; 2];
    for (speed, frequency) in ends.into_iter().zip(&mut frequencies) {
        let station = finder.station(speed)?;
        // Of several merged pairs the one that has only just merged is the one at its edge.
        let slowest = station
            .merged()
            .min_by(|x, y| x.growth.total_cmp(&y.growth));
        *frequency = slowest.map_or(0.0, |t| t.frequency);
    }
    let expected = |speed: f64| {
        let share = (speed - from) / (to - from);
        frequencies[0] + share * (frequencies[1] - frequencies[0])
    };
    let pair = |speed: f64| -> Result<(f64, f64), SpectrumError> {
        let near = |f: f64| (f - expected(speed)).abs();
        let station = finder.station(speed)?;
        let nearest = station
            .merged()
            .min_by(|x, y| near(x.frequency).total_cmp(&near(y.frequency)));
        Ok(nearest.map_or((0.0, 0.0), |t| (t.growth, t.frequency)))
    };
    let (peak, _) = refine::maximise((from, to), closed, |speed| Ok(pair(speed)?.0.powi(2)))?;
    let (peak_growth_per_s, frequency) = pair(peak)?;
    Ok(Instability {
        kind: InstabilityKind::Flutter,
        from,
        to,
        closed,
        peak,
        peak_growth_per_s,
        frequency,
        modes: meeting_modes(model, from, frequencies[0])?,
    })
}

/// Names of the + and the − mode next to a frequency just below an onset.
pub(super) fn meeting_modes(
    model: &SpectralModel,
    onset: f64,
    frequency: f64,
) -> Result<Vec<String>, SpectrumError> {
    let before = onset * (1.0 - 1e-5);
    let mut modes = model.modes(before)?;
    modes.retain(|m| m.krein_sign() != 0);
    let distance = |m: &crate::spectrum::Mode| (m.frequency_rad_per_s() - frequency).abs();
    modes.sort_by(|x, y| distance(x).total_cmp(&distance(y)));
    let mut pair = Vec::new();
    for sign in [1, -1] {
        pair.extend(modes.iter().find(|m| m.krein_sign() == sign).cloned());
    }
    let described = model.describe(before, pair);
    Ok(described
        .iter()
        .map(|m| in_words(m.name.diameters, m.name.circles, m.name.direction))
        .collect())
}
