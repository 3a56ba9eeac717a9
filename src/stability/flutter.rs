//! Flutter: a + and a − mode that have merged.

use rayon::prelude::*;

use super::bands::{Instability, InstabilityKind};
use super::finder::{Edge, Event, Finder};
use super::peak::maximise;
use super::pursuit::Pursuit;
use super::station::Station;
use crate::spectrum::{Mode, SpectralModel, SpectrumError, in_words};

/// Bands in which a + and a − mode have merged.
pub(super) fn flutter(
    model: &SpectralModel,
    finder: &Finder<'_>,
    stations: &[Station],
    events: Vec<Vec<Event>>,
) -> Result<Vec<Instability>, SpectrumError> {
    let Some((first, last)) = stations.first().zip(stations.last()) else {
        return Ok(Vec::new());
    };
    // Pairs merged at the current speed, by frequency, with where they began.
    let begun = End::of_range(first.speed_rad_per_s);
    let mut open: Vec<End> = first.merged().map(|_| begun).collect();
    let mut ranges: Vec<(End, End)> = Vec::new();
    for events in events {
        for event in events {
            match event {
                Event::Begin(edge) => {
                    open.insert(edge.index.min(open.len()), End::of_pair(edge));
                }
                Event::End(edge) if edge.index < open.len() => {
                    ranges.push((open.remove(edge.index), End::of_pair(edge)));
                }
                Event::End(_) => {}
                Event::Band(from, to) => ranges.push((End::merging(from), End::merging(to))),
            }
        }
    }
    let end = End::of_range(last.speed_rad_per_s);
    ranges.extend(open.iter().map(|begin| (*begin, end)));
    ranges
        .into_par_iter()
        .map(|ends| band(model, finder, ends))
        .collect()
}

/// Where a band begins or ends.
#[derive(Debug, Clone, Copy)]
struct End {
    speed: f64,
    /// The range does not end inside the band.
    closed: bool,
    /// Two waves merge: growth begins at zero. Where two real λ meet it does not.
    at_zero: bool,
}

impl End {
    fn merging(speed: f64) -> Self {
        End {
            speed,
            closed: true,
            at_zero: true,
        }
    }

    fn of_pair(edge: Edge) -> Self {
        End {
            at_zero: !edge.real,
            ..End::merging(edge.speed_rad_per_s)
        }
    }

    fn of_range(speed: f64) -> Self {
        End {
            speed,
            closed: false,
            at_zero: false,
        }
    }
}

fn band(
    model: &SpectralModel,
    finder: &Finder<'_>,
    (begin, end): (End, End),
) -> Result<Instability, SpectrumError> {
    let (from, to) = (begin.speed, end.speed);
    let zero_at_ends = [begin.at_zero, end.at_zero];
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
    let pursued = fastest_of_pair(finder, (from, to), zero_at_ends, &expected)?;
    let (peak, peak_growth_per_s, frequency) = match pursued {
        Some(found) => found,
        None => fastest_of_words(finder, (from, to), zero_at_ends, &expected)?,
    };
    Ok(Instability {
        kind: InstabilityKind::Flutter,
        from,
        to,
        closed: begin.closed && end.closed,
        peak,
        peak_growth_per_s,
        frequency,
        modes: meeting_modes(model, from, frequencies[0])?,
        curve: Vec::new(),
    })
}

/// Speed, growth rate and frequency of the fastest growth within a band: of its pair, pursued
/// from the middle. `None` where the pair is lost.
fn fastest_of_pair(
    finder: &Finder<'_>,
    (from, to): (f64, f64),
    zero_at_ends: [bool; 2],
    expected: &dyn Fn(f64) -> f64,
) -> Result<Option<(f64, f64, f64)>, SpectrumError> {
    let middle = 0.5 * (from + to);
    let Some(begun) = Pursuit::begin(finder, middle, expected(middle))? else {
        return Ok(None);
    };
    let mut known = vec![begun];
    let mut lost = false;
    let (peak, square) = maximise((from, to), zero_at_ends, |speed| {
        let Some(pair) = nearest(&known, speed).and_then(|pair| pair.to(speed)) else {
            lost = true;
            return Ok(0.0);
        };
        let square = -pair.discriminant();
        known.push(pair);
        Ok(square)
    })?;
    let Some(pair) = nearest(&known, peak).filter(|_| !lost && square > 0.0) else {
        return Ok(None);
    };
    let seen = finder.station(peak)?.merged().any(|t| pair.is_token(t));
    Ok(seen.then(|| (peak, square.sqrt(), pair.mean_frequency())))
}

fn nearest<'a, 'b>(known: &'a [Pursuit<'b>], speed: f64) -> Option<&'a Pursuit<'b>> {
    let distance = |pair: &Pursuit<'_>| (pair.speed_rad_per_s - speed).abs();
    known
        .iter()
        .min_by(|x, y| distance(x).total_cmp(&distance(y)))
}

/// The same read off the words of speeds.
fn fastest_of_words(
    finder: &Finder<'_>,
    range: (f64, f64),
    zero_at_ends: [bool; 2],
    expected: &dyn Fn(f64) -> f64,
) -> Result<(f64, f64, f64), SpectrumError> {
    let merged = |speed: f64| -> Result<(f64, f64), SpectrumError> {
        let near = |f: f64| (f - expected(speed)).abs();
        let station = finder.station(speed)?;
        let nearest = station
            .merged()
            .min_by(|x, y| near(x.frequency).total_cmp(&near(y.frequency)));
        Ok(nearest.map_or((0.0, 0.0), |t| (t.growth, t.frequency)))
    };
    let (peak, _) = maximise(range, zero_at_ends, |speed| Ok(merged(speed)?.0.powi(2)))?;
    let (growth_per_s, frequency) = merged(peak)?;
    let sharp = Pursuit::begin(finder, peak, frequency)?;
    let sharp = sharp.map(|pair| (-pair.discriminant()).max(0.0).sqrt());
    Ok((peak, sharp.unwrap_or(growth_per_s), frequency))
}

/// Names of the + and the − mode next to a frequency just below an onset.
pub(super) fn meeting_modes(
    model: &SpectralModel,
    onset: f64,
    frequency: f64,
) -> Result<Vec<String>, SpectrumError> {
    let before = onset * (1.0 - 1e-5);
    let mut modes = model.drawn_modes(before)?;
    modes.retain(|m| m.krein_sign() != 0);
    let distance = |m: &Mode| (m.frequency_rad_per_s() - frequency).abs();
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
