//! Bands of a damped blade: intervals of speed in which an eigenvalue has Re λ > 0.
//!
//! A damped blade has no Krein signs to count. Instead, every low eigenvalue is followed over speed as λ(Ω)
//! ([`curve`]), by the reduced model of its waves ([`spectrum`]), on pieces each of which predicted the
//! eigenvalues of a further speed. A band begins and ends
//! where Re λ = 0, where a complex pair turns into two real eigenvalues or back, and at the smallest growth
//! between two humps ([`hump`]).

mod counts;
mod curve;
mod hump;
mod sliver;
mod spectrum;

use rayon::prelude::*;

use super::band::{CurvePoint, Instability};
use super::between::Between;
use super::certificate::Certificate;
use super::detail::Detail;
use super::diagram::{DrawnSpeeds, drawn};
use super::error::AnalysisError;
use super::group::Sloped;
use super::options::AnalysisOptions;
use super::pieces::{Piece, Search};
use super::sample::Plane;
use super::search_result::{FoundBands, StabilityChart};
use crate::model::evenly_spaced;
use crate::model::scene::SpeedRange;
use crate::model::tuning::Tuned;
use crate::modes::branches::{self, ModesAt};
use crate::modes::{Mode, SpectralModel, SpectrumError, clear_range};
use counts::Counts;
pub(super) use counts::counted_in_window;
use sliver::{rounded_to_real, without_slivers};
use spectrum::{Component, Solver, Spectrum, finite, noise};

/// Allowed distance of straight lines from a drawn curve of growth, as a share of its peak, both on a
/// square-root scale, which shows slow growth beside fast growth.
const DRAWN: Tuned = Tuned::new("stability/damped::DRAWN", 0.02);

/// Subdivisions of a cubic between two points of a curve for the comparison with straight lines.
const PARTS: u32 = 4;

/// Finds the bands with their checks, and draws them with the modes between, which are returned, too.
pub(super) fn charted<'a>(
    model: &'a SpectralModel,
    range: SpeedRange,
    count: usize,
    options: AnalysisOptions<'_>,
) -> Result<(StabilityChart, Between<'a>), AnalysisError> {
    let speeds = DrawnSpeeds::new(model, clear_range(&model.critical, range), count);
    branches::check_room(model, &speeds.all)?;
    let (found, between, seen) = searched_bands(model, range, options.detail)?;
    let is_held = !model.has_free_motions();
    options.report(&model.critical, range, Some(&found.instabilities), is_held);
    let share = Closeness::of(options.detail).drawn;
    let bands = found.instabilities.iter();
    let beside: Vec<f64> = bands.flat_map(|band| drawn_speeds(band, share)).collect();
    let seen = speeds.thinned(seen);
    let chart = drawn(&between, &speeds, seen, &beside, found, options)?;
    Ok((chart, between))
}

/// Number of even speeds at the start of the search.
const SEARCH_SPEEDS: usize = 9;
/// Relative error allowed for an eigenvalue between two speeds of the search, and for a growth rate.
const SEARCH_TOLERANCE: f64 = 1e-3;
/// [`SEARCH_TOLERANCE`] in a preview: it halves the time and changes the bands of the saws of the gallery by
/// less than 0.1 rpm.
const SKETCH_TOLERANCE: f64 = 1e-2;
/// Factor for the distance of straight lines from a drawn curve in a preview.
const SKETCH_LINES: f64 = 3.0;

/// Accuracy of search and drawing.
#[derive(Clone, Copy)]
struct Closeness {
    /// Relative error allowed between two speeds of the search.
    tolerance: f64,
    /// Distance allowed of straight lines between drawn speeds, see [`DRAWN`].
    drawn: f64,
    /// Whether the bands are compared with counts on the full model.
    is_counted: bool,
}

impl Closeness {
    fn of(detail: Detail) -> Self {
        match detail {
            Detail::Full => Closeness {
                tolerance: SEARCH_TOLERANCE,
                drawn: DRAWN.get(),
                is_counted: true,
            },
            Detail::Sketch => Closeness {
                tolerance: SKETCH_TOLERANCE,
                drawn: SKETCH_LINES * DRAWN.get(),
                is_counted: false,
            },
        }
    }
}

/// Every band within a range of speeds, by onset, and their checks.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn bands(
    model: &SpectralModel,
    range: SpeedRange,
    detail: Detail,
) -> Result<FoundBands, SpectrumError> {
    Ok(searched_bands(model, range, detail)?.0)
}

/// The bands, and what a chart reads off their search: its pieces, and modes at its speeds.
fn searched_bands(
    model: &SpectralModel,
    range: SpeedRange,
    detail: Detail,
) -> Result<(FoundBands, Between<'_>, Vec<ModesAt>), SpectrumError> {
    let closeness = Closeness::of(detail);
    let solver = Solver::new(model);
    let speeds = evenly_spaced(range.ends(), SEARCH_SPEEDS);
    let searched: Vec<(Vec<Piece>, Vec<Instability>)> = (0..solver.components())
        .into_par_iter()
        .map(|index| searched(&solver.component(index), &speeds, closeness.tolerance))
        .collect::<Result<_, _>>()?;
    let mut instabilities = Vec::new();
    let mut spectra: Vec<Spectrum> = Vec::new();
    for (pieces, bands) in &searched {
        instabilities.extend(bands.iter().cloned());
        // With several components, the spectrum of one component is not that of the saw.
        if searched.len() == 1 {
            spectra = solver.spectra(pieces);
        }
    }
    if searched.len() > 1 {
        let all = speeds.par_iter().map(|&speed| solver.at(speed));
        spectra = all.collect::<Result<_, _>>()?;
    }
    instabilities.sort_by(|x, y| x.from_rad_per_s.total_cmp(&y.from_rad_per_s));
    let counts = if closeness.is_counted {
        Counts::new(model, &solver, &instabilities, range)?
    } else {
        Counts::default()
    };
    let mut violations = mismatches(model, &spectra, &instabilities);
    violations.extend(mismatches(model, &counts.spectra, &instabilities));
    let certificate = Certificate {
        speeds_checked: spectra.len() + counts.spectra.len(),
        violations_rad_per_s: violations,
        full_basis_counts: counts.made,
        uncertain_counts: counts.spectra.len() - counts.made,
        miscounts: counts.miscounts,
        gave_up: solver.is_exhausted(),
        ..Certificate::default()
    };
    let pieces = searched.into_iter().enumerate();
    let parts = pieces.map(|(index, (pieces, _))| (solver.component(index).index, pieces));
    let parts: Vec<(usize, Vec<Piece>)> = parts.collect();
    let interpolated = move |speed: f64| {
        let parts = parts.iter();
        let modes =
            parts.map(|(component, pieces)| modes_of_part(model, *component, pieces, speed));
        let modes: Vec<Vec<Mode>> = modes.collect::<Option<_>>()?;
        Some(modes.concat())
    };
    let between = Between {
        model,
        interpolated: Box::new(interpolated),
    };
    let found = FoundBands {
        instabilities,
        certificate,
    };
    Ok((found, between, solver.into_seen()))
}

/// Modes of a part of a component at a speed of its pieces; `None` if the search did not settle there.
fn modes_of_part(
    model: &SpectralModel,
    component: usize,
    pieces: &[Piece],
    speed: f64,
) -> Option<Vec<Mode>> {
    let groups = Piece::settled(pieces, speed)?.groups.iter();
    let numbers: Vec<Sloped> = groups
        .flat_map(|grouped| grouped.group.sloped_at(speed))
        .collect();
    let seen = curve::upper(&numbers, model.complete_to_rad_per_s).into_iter();
    let mode = |(lambda, slope)| Mode::interpolated(lambda, finite(slope), component);
    Some(seen.map(mode).collect())
}

/// Pieces of one component of the saw, and its bands.
fn searched(
    component: &Component<'_>,
    speeds: &[f64],
    tolerance: f64,
) -> Result<(Vec<Piece>, Vec<Instability>), SpectrumError> {
    let solver = component.solver;
    let solve = |speed: f64| component.sample(speed);
    let search = Search {
        plane: Plane::Eigenvalues,
        top_rad_per_s: solver.highest(),
        tolerance,
        definite_tolerance: tolerance,
        growth_tolerance: tolerance,
        noise_per_s: solver.noise(),
        solve: &solve,
    };
    let pieces = search.pieces(speeds)?;
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Ok((pieces, Vec::new()));
    };
    let range = SpeedRange::new(first, last);
    let curves = curve::curves(&pieces, solver.highest(), solver.noise());
    let found: Result<Vec<Vec<Instability>>, SpectrumError> = curves
        .par_iter()
        .map(|curve| hump::bands(component, curve, range, tolerance))
        .collect();
    let found: Vec<Instability> = found?.into_iter().flatten().collect();
    Ok((pieces, without_slivers(found, solver.highest())))
}

/// The speed, if the number of growing modes differs from the number of bands there; otherwise empty.
pub(super) fn contradicted(
    model: &SpectralModel,
    bands: &[Instability],
    speed: f64,
    modes: &[Mode],
) -> Vec<f64> {
    let values = modes.iter().map(|mode| mode.lambda).collect();
    mismatches(model, &[Spectrum { speed, values }], bands)
}

/// Speeds at which the number of growing modes differs from the number of bands.
fn mismatches(model: &SpectralModel, spectra: &[Spectrum], bands: &[Instability]) -> Vec<f64> {
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
        // A growth rate within rounding errors of zero may have either sign, so that two counts limit the
        // number of growing modes.
        let growing = |least: f64| {
            let values = spectrum.values.iter();
            let sound = values.filter(|l| l.im <= model.complete_to_rad_per_s);
            sound.filter(|l| l.re > least).count()
        };
        let (least, most) = (growing(10.0 * noise(model)), growing(-10.0 * noise(model)));
        let doubled = rounded_to_real(&spectrum.values, model.complete_to_rad_per_s);
        let least = least.saturating_sub(doubled);
        !ends.any(|edge| at_edge(speed, edge)) && !(least..=most).contains(&covering.count())
    };
    let differing = spectra.iter().filter(differs);
    differing.map(|spectrum| spectrum.speed).collect()
}

/// Speeds at which the growth in a band is drawn: ends, peak, and as many between as straight lines need to
/// follow the curve. An end where λ is real is left out: it is next to a coalescence with another real λ, at which neither can be
/// told from the other.
fn drawn_speeds(band: &Instability, share: f64) -> Vec<f64> {
    let tolerance = share * band.peak_growth_per_s.sqrt();
    let mut points: Vec<(f64, f64)> = Vec::new();
    for pair in band.curve.windows(2) {
        let [from, to] = [0, 1].map(|k| pair[k].speed_rad_per_s);
        points.push((from, pair[0].number.re));
        let inner = (1..PARTS).map(|k| from + (to - from) * f64::from(k) / f64::from(PARTS));
        points.extend(inner.filter_map(|speed| Some((speed, band.growth_at(speed)?))));
    }
    points.extend(band.curve.last().map(|p| (p.speed_rad_per_s, p.number.re)));
    let is_straight = |from: usize, to: usize| {
        let ([a, rise_from], [b, rise_to]) = (points[from].into(), points[to].into());
        points[from + 1..to].iter().all(|(speed, growth)| {
            let share: f64 = (speed - a) / (b - a);
            let straight = rise_from + share * (rise_to - rise_from);
            (growth.max(0.0).sqrt() - straight.max(0.0).sqrt()).abs() <= tolerance
        })
    };
    let mut drawn = vec![0];
    for k in 1..points.len() {
        let from = drawn[drawn.len() - 1];
        let is_peak = points[k].0 == band.peak_rad_per_s;
        if k + 1 == points.len() || is_peak || !is_straight(from, k + 1) {
            drawn.push(k);
        }
    }
    let is_real = |point: Option<&CurvePoint>| point.is_some_and(|point| point.number.im == 0.0);
    let [from, to] = [band.curve.first(), band.curve.last()].map(is_real);
    drawn.retain(|&k| !(from && k == 0 || to && k + 1 == points.len()));
    drawn.into_iter().map(|k| points[k].0).collect()
}
