//! The stability chart of a saw: samples, branches and bands of a range of speeds.

use faer::c64;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::analysis::Detail;
use super::damped;
use super::divergence::{close_pairs, divergence};
use super::finder::{CRITICAL_GAP, CRITICAL_GROUP, Finder};
use super::flutter::flutter;
use crate::campbell::{self, Campbell, Closeness, Progress, SpeedSample};
use crate::spectrum::{SpectralModel, SpectrumError};

/// Kind of an instability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
    /// The eigenvalue from the first to the last speed of a band of a damped blade, close
    /// enough for cubics between the points; empty for an undamped blade.
    pub curve: Vec<CurvePoint>,
}

/// An eigenvalue at one speed of a band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// λ, Im λ ≥ 0.
    pub lambda: c64,
    /// dλ/dΩ.
    pub slope: c64,
}

impl Instability {
    /// Whether it counts as an instability of the saw: flutter slower than the threshold drowns
    /// in damping that no scene names; a blade that leans over does not come back.
    pub fn counts(&self, threshold_per_s: f64) -> bool {
        self.kind == InstabilityKind::Divergence || self.peak_growth_per_s >= threshold_per_s
    }
}

/// Proof that the chart missed nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Certificate {
    /// Number of speeds at which the Krein index was compared.
    pub speeds_checked: usize,
    /// Speeds at which it did not match, not even on the whole basis, in rad/s.
    pub violations: Vec<f64>,
    /// Whether the search ran out of its allowance of speeds.
    pub gave_up: bool,
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

/// Even speeds from which the bands of a chart are searched: the same bands come out of any
/// number of them.
pub(super) const SEARCH_SPEEDS: usize = 25;
/// Speeds drawn within and beside a band, as shares of its width, besides that of its peak.
const WITHIN_BANDS: [f64; 6] = [-0.02, 0.02, 0.15, 0.85, 0.98, 1.02];

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
    drawn(model, range, count, Detail::Full, progress)
}

/// The same, drawn more or less closely.
pub(super) fn drawn(
    model: &SpectralModel,
    range: (f64, f64),
    count: usize,
    detail: Detail,
    progress: Progress<'_>,
) -> Result<StabilityChart, SpectrumError> {
    if !model.is_conservative() {
        return damped::chart(model, range, count, progress);
    }
    let speeds = with_critical_speeds(model, range, campbell::even_speeds(range, count));
    let mut samples = campbell::sample(model, &speeds, progress)?;
    // A free blade has no bands to search for, and is only held against the Krein index.
    let search = match model.plate.is_axisymmetric() {
        true => speeds,
        false => {
            let even = campbell::even_speeds(range, SEARCH_SPEEDS);
            with_critical_speeds(model, range, even)
        }
    };
    let (instabilities, certificate) = bands(model, &search)?;
    let (shares, closeness) = match detail {
        Detail::Full => (WITHIN_BANDS.as_slice(), Closeness::FIGURE),
        Detail::Sketch => ([].as_slice(), Closeness::SKETCH),
    };
    let between = inside(&instabilities, &samples, shares, range);
    samples.extend(campbell::sample(model, &between, &|_, _| ())?);
    samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    let samples = campbell::refined(model, samples, closeness)?;
    Ok(StabilityChart {
        campbell: Campbell::track(samples, model.complete_to_rad_per_s),
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
    let speeds = from_lowest_critical(model, speeds);
    let finder = Finder::new(model, speeds)?;
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

/// Ascending speeds without those at which nothing can be unstable: below its lowest critical
/// speed K(Ω) is positive definite, no wave is reflected, and the Krein index is zero.
fn from_lowest_critical<'a>(model: &SpectralModel, speeds: &'a [f64]) -> &'a [f64] {
    let lowest = model.critical.first();
    let lowest = lowest.map_or(f64::INFINITY, |c| c.speed_rad_per_s);
    let below = speeds.partition_point(|speed| *speed < lowest);
    &speeds[below.saturating_sub(1)..]
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
        let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
        let clear = |s: &f64| critical.iter().all(|c| (s / c - 1.0).abs() > 1e-5);
        speeds.retain(clear);
        let beside = critical
            .iter()
            .flat_map(|c| [c * (1.0 - 1e-4), c * (1.0 + 1e-4)]);
        speeds.extend(beside.filter(|s| (range.0..range.1).contains(s)));
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|x, y| (*x / *y - 1.0).abs() < 1e-9);
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

/// Speeds inside and beside the bands, so that the narrowest one is drawn.
fn inside(
    instabilities: &[Instability],
    samples: &[SpeedSample],
    shares: &[f64],
    range: (f64, f64),
) -> Vec<f64> {
    let mut speeds: Vec<f64> = instabilities
        .iter()
        .flat_map(|band| {
            let at = |share: f64| band.from + share * (band.to - band.from);
            let shares = shares.iter().copied();
            shares.map(at).chain([band.peak])
        })
        .collect();
    speeds.retain(|s| (range.0..=range.1).contains(s));
    speeds.retain(|s| samples.iter().all(|sample| sample.speed_rad_per_s != *s));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}
