//! Bands of a damped blade: stretches of speeds in which an eigenvalue has Re λ > 0.
//!
//! Damping leaves no Krein signs to count. Instead every eigenvalue that may grow is followed
//! over speed as λ(Ω), with as many speeds in between as it takes to match it without doubt
//! ([`link`]) and to draw its growth ([`trace`]). A band begins and ends where Re λ = 0, where a
//! complex pair becomes two real eigenvalues or back, and where growth is least between two
//! humps ([`hump`]). The bands of the undamped twin lend speeds to begin with, and the names of
//! the modes that meet.

mod counts;
mod hump;
mod link;
mod spectrum;
mod trace;

use rayon::prelude::*;

use super::band::{CurvePoint, Instability};
use super::basis::PAST_THE_RANGE;
use super::certificate::Certificate;
use super::error::AnalysisError;
use super::undamped::{SEARCH_SPEEDS, undamped_bands, with_critical_speeds};
use crate::campbell::{self, Progress, SpeedSample};
use crate::spectrum::{Assembled, SpectralModel, SpectrumError, Strategy, clear_range};
use crate::tuned::Tuned;
use counts::Counts;
pub(super) use counts::counted_in_window;
use spectrum::{Solver, Spectrum};

/// Points of a band's curve that a straight line misses by more than this share of its peak
/// are drawn, on a scale of square roots, which shows slow growth beside fast.
const DRAWN: Tuned = Tuned::new("stability/damped::DRAWN", 0.02);

/// Modes at `count` even speeds and where bands need more, the bands, and what was checked of them.
pub(super) fn charted(
    model: &SpectralModel,
    range: (f64, f64),
    count: usize,
    progress: Progress<'_>,
) -> Result<(Vec<SpeedSample>, Vec<Instability>, Certificate), AnalysisError> {
    let twin = twin_bands(model, range)?;
    let drawn = clear_range(&model.critical, range);
    let mut speeds = with_critical_speeds(model, drawn, campbell::even_speeds(drawn, count));
    let mut samples = campbell::sample(model, &speeds, progress)?;
    // Eigenvalues are simple but for single speeds, also where one of them passes through zero.
    speeds.extend([range.0, range.1]);
    speeds.extend(
        twin.iter()
            .flat_map(|band| [band.from_rad_per_s, band.peak_rad_per_s, band.to_rad_per_s]),
    );
    speeds.extend(middles(model, range));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let (instabilities, certificate) = bands(model, &speeds)?;
    let mut drawn: Vec<f64> = instabilities.iter().flat_map(drawn_speeds).collect();
    drawn.sort_by(f64::total_cmp);
    drawn.dedup();
    drawn.retain(|s| samples.iter().all(|sample| sample.speed_rad_per_s != *s));
    samples.extend(campbell::sample(model, &drawn, &|_, _| ())?);
    Ok((samples, instabilities, certificate))
}

/// The bands of the blade without damping.
fn twin_bands(model: &SpectralModel, range: (f64, f64)) -> Result<Vec<Instability>, SpectrumError> {
    let plate = model.plate.conservative();
    if plate.is_axisymmetric() {
        return Ok(Vec::new());
    }
    let twin = Assembled::from(plate);
    let critical = twin.critical_speeds(Some(&|_| PAST_THE_RANGE * range.1))?;
    let twin = SpectralModel::with_critical(twin, critical, range, Strategy::Bands)?;
    let (bands, _) = undamped_bands(&twin, range, SEARCH_SPEEDS.count())?;
    Ok(bands)
}

/// Half way between neighbouring critical speeds, where a wave may lean over.
fn middles(model: &SpectralModel, range: (f64, f64)) -> Vec<f64> {
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let middles = critical.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    middles.filter(|s| (range.0..range.1).contains(s)).collect()
}

/// Every band between the first and the last of the speeds, by onset.
fn bands(
    model: &SpectralModel,
    speeds: &[f64],
) -> Result<(Vec<Instability>, Certificate), SpectrumError> {
    let solver = Solver::new(model);
    let given: Result<Vec<Spectrum>, SpectrumError> =
        speeds.par_iter().map(|&speed| solver.at(speed)).collect();
    let spectra = trace::refined(&solver, given?)?;
    let paths = trace::paths(&solver, &spectra);
    let found: Result<Vec<Vec<Instability>>, SpectrumError> = paths
        .par_iter()
        .map(|path| hump::bands(&solver, &spectra, path))
        .collect();
    let mut instabilities: Vec<Instability> = found?.into_iter().flatten().collect();
    instabilities.sort_by(|x, y| x.from_rad_per_s.total_cmp(&y.from_rad_per_s));
    let range = (speeds.first().copied(), speeds.last().copied());
    let counts = match range {
        (Some(from), Some(to)) => Counts::new(model, &solver, &instabilities, (from, to))?,
        _ => Counts::default(),
    };
    let mut violations = mismatches(&solver, &spectra, &instabilities);
    violations.extend(mismatches(&solver, &counts.spectra, &instabilities));
    let certificate = Certificate {
        speeds_checked: spectra.len() + counts.spectra.len(),
        violations_rad_per_s: violations,
        full_basis_counts: counts.made,
        uncertain_counts: counts.spectra.len() - counts.made,
        miscounts: counts.miscounts,
        gave_up: solver.is_exhausted(),
        ..Certificate::default()
    };
    Ok((instabilities, certificate))
}

/// The speed, if there are more or fewer growing modes than bands.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn contradicted(
    model: &SpectralModel,
    bands: &[Instability],
    speed_rad_per_s: f64,
) -> Result<Vec<f64>, SpectrumError> {
    let solver = Solver::new(model);
    let spectrum = solver.at(speed_rad_per_s)?;
    Ok(mismatches(&solver, &[spectrum], bands))
}

/// Speeds at which there are more or fewer growing modes than bands.
fn mismatches(solver: &Solver<'_>, spectra: &[Spectrum], bands: &[Instability]) -> Vec<f64> {
    const EDGE: f64 = 1e-9;
    let at_edge = |speed: f64, edge: f64| (speed - edge).abs() <= EDGE * speed;
    let differs = |spectrum: &&Spectrum| {
        let speed = spectrum.speed;
        let mut ends = bands
            .iter()
            .flat_map(|band| [band.from_rad_per_s, band.to_rad_per_s]);
        let covering = bands
            .iter()
            .filter(|b| b.from_rad_per_s < speed && speed < b.to_rad_per_s);
        // Within rounding of zero a mode may be on either side.
        let growing = |least: f64| {
            let values = spectrum.values.iter().map(|v| v.lambda);
            let sound = values.filter(|l| l.im <= solver.highest());
            sound.filter(|l| l.re > least).count()
        };
        let (least, most) = (
            growing(10.0 * solver.noise()),
            growing(-10.0 * solver.noise()),
        );
        !ends.any(|edge| at_edge(speed, edge)) && !(least..=most).contains(&covering.count())
    };
    let differing = spectra.iter().filter(differs);
    differing.map(|spectrum| spectrum.speed).collect()
}

/// Speeds of a band at which its growth is drawn: its ends, its peak, and as many in between as
/// straight lines take to follow the curve.
fn drawn_speeds(band: &Instability) -> Vec<f64> {
    let curve = &band.curve;
    let tolerance = DRAWN.get() * band.peak_growth_per_s.sqrt();
    let is_straight = |from: usize, to: usize| {
        let [a, b] = [curve[from], curve[to]];
        let width = b.speed_rad_per_s - a.speed_rad_per_s;
        curve[from + 1..to].iter().all(|p| {
            let share = (p.speed_rad_per_s - a.speed_rad_per_s) / width;
            let straight = a.lambda.re + share * (b.lambda.re - a.lambda.re);
            (p.lambda.re.max(0.0).sqrt() - straight.max(0.0).sqrt()).abs() <= tolerance
        })
    };
    let is_peak = |p: &CurvePoint| p.speed_rad_per_s == band.peak_rad_per_s;
    let mut drawn = vec![0];
    for k in 1..curve.len() {
        let from = drawn[drawn.len() - 1];
        if k + 1 == curve.len() || is_peak(&curve[k]) || !is_straight(from, k + 1) {
            drawn.push(k);
        }
    }
    drawn
        .into_iter()
        .map(|k| curve[k].speed_rad_per_s)
        .collect()
}
