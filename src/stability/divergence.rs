//! Divergence: a real λ > 0, from one critical speed to the next.

use super::bands::{Instability, InstabilityKind};
use super::finder::{CRITICAL_GAP, CRITICAL_GROUP, Event, Finder};
use super::peak::maximise;
use super::station::{Sign, Station};
use crate::spectrum::{Direction, SpectralModel, SpectrumError, in_words};

/// Stretches of speed with a real λ > 0. They begin and end at critical speeds, or where
/// two real λ meet and go on as flutter.
pub(super) fn divergence(
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
            let begins = edge(model, stations, events, first.checked_sub(1), first);
            let ends = edge(model, stations, events, (!last).then_some(index + 1), index);
            let ((from, begins), (to, ends)) = (begins, ends);
            let zero_at_ends = [begins, ends].map(|edge| edge == Edge::Critical);
            let growth =
                |speed: f64| Ok(finder.station(speed)?.divergence().unwrap_or(0.0).powi(2));
            let (peak, square) = maximise((from, to), zero_at_ends, growth)?;
            bands.push(Instability {
                kind: InstabilityKind::Divergence,
                from,
                to,
                closed: begins != Edge::Range && ends != Edge::Range,
                peak,
                peak_growth_per_s: square.sqrt(),
                frequency: 0.0,
                modes: standing_waves(model, from, to),
                curve: Vec::new(),
            });
            start = None;
        }
    }
    Ok(bands)
}

/// Divergence between two critical speeds that the stations pass in one step. Where the
/// number of negative directions of K(Ω) is odd there is a real λ > 0.
pub(super) fn close_pairs(
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
            curve: Vec::new(),
        });
    }
    Ok(bands)
}

/// What a stretch of divergence begins or ends at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Edge {
    /// A critical speed: λ passes through zero.
    Critical,
    /// The meeting of two real λ, which go on as flutter: neither is zero.
    Meeting,
    /// The range ends inside.
    Range,
}

/// Where divergence begins or ends between a stable and an unstable station: at the
/// critical speed or the meeting of two real λ between them, or at the end of the range.
fn edge(
    model: &SpectralModel,
    stations: &[Station],
    events: &[Vec<Event>],
    stable: Option<usize>,
    unstable: usize,
) -> (f64, Edge) {
    let inner = stations[unstable].speed_rad_per_s;
    let Some(stable) = stable else {
        return (inner, Edge::Range);
    };
    let outer = stations[stable].speed_rad_per_s;
    let (low, high) = (inner.min(outer), inner.max(outer));
    let mut critical = model.critical.iter().map(|c| c.speed_rad_per_s);
    let mut meetings = events[stable.min(unstable)]
        .iter()
        .filter_map(|event| match event {
            Event::Begin(at) | Event::End(at) if at.real => Some(at.speed_rad_per_s),
            _ => None,
        });
    let meeting = if stable < unstable {
        meetings.next_back()
    } else {
        meetings.next()
    };
    let critical = critical.find(|c| (low..=high).contains(c));
    match (critical, meeting) {
        (Some(speed), _) => (speed, Edge::Critical),
        (None, Some(speed)) => (speed, Edge::Meeting),
        // The events between the two were too close to tell apart.
        (None, None) => (inner, Edge::Meeting),
    }
}

fn standing_waves(model: &SpectralModel, from: f64, to: f64) -> Vec<String> {
    let mut names: Vec<String> = model
        .critical
        .iter()
        .filter(|c| {
            (from * (1.0 - CRITICAL_GAP)..=to * (1.0 + CRITICAL_GAP)).contains(&c.speed_rad_per_s)
        })
        .map(|c| in_words(c.diameters, c.circles, Direction::Standing))
        .collect();
    names.truncate(2);
    names
}
