//! Bands of an undamped blade over a range of speeds, and the speeds of its chart.
//!
//! Modes have Krein signs, and λ² is followed over the speed. Its quadruples are bands of flutter, its real numbers above zero bands of
//! divergence. Both are intervals of the pieces of a search ([`stretches`]) with two ends ([`growing`]) and a largest growth
//! ([`growing_stretch`]). The bands are checked and proven by counts ([`certification`], [`proof`]).

mod certification;
mod checked_modes;
mod growing;
mod growing_stretch;
mod interpolated;
mod loci;
mod proof;
mod stretches;

pub(crate) use self::certification::Depth;
pub(super) use self::certification::{GROWTH_FLOOR, contradictions, drawn_share};
pub(super) use self::loci::RootLoci;

use self::certification::{Searched, bands};
use self::checked_modes::{CRITICAL_GAP, CRITICAL_GROUP};
use crate::model::evenly_spaced;
use crate::model::plate::Plate;
use crate::model::scene::SpeedRange;
use crate::modes::branches::{self, ModesAt};
use crate::modes::{NamedCriticalSpeed, SpectralModel, SpectrumError, clear_range, searched_range};
use crate::stability::band::Instability;
use crate::stability::detail::Detail;
use crate::stability::error::AnalysisError;
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::options::AnalysisOptions;
use crate::stability::sample::Sample;
use crate::stability::search_result::{FoundBands, StabilityChart};

/// Number of even speeds at the start of the search for bands; the bands do not depend on it.
pub(super) const SEARCH_SPEEDS: usize = 9;

/// Computes the bands with their checks, and the modes of a chart: at the speeds of the search, beside them at those of `count` even
/// ones, and wherever curves need more.
pub(super) fn charted(
    model: &SpectralModel,
    range: SpeedRange,
    count: usize,
    depth: Depth,
    options: AnalysisOptions<'_>,
) -> Result<StabilityChart, AnalysisError> {
    let AnalysisOptions {
        detail, progress, ..
    } = options;
    let drawn = clear_range(&model.critical, range);
    let even = evenly_spaced(drawn.ends(), count);
    let speeds = match detail {
        Detail::Full => with_critical_speeds(&model.plate, &model.critical, drawn, even),
        // A sketch of a guided blade needs no speeds beside critical ones, because its branches are followed
        // through λ = 0.
        Detail::Sketch if !model.plate.is_axisymmetric() => away_from_critical(model, even),
        Detail::Sketch => with_critical_speeds(&model.plate, &model.critical, drawn, even),
    };
    // A free blade has no bands to search for; only the Krein index is checked.
    let search = if model.plate.is_axisymmetric() {
        from_lowest_critical(model, speeds.clone())
    } else {
        search_speeds(model, range, SEARCH_SPEEDS)
    };
    branches::check_room(model, &speeds)?;
    let Searched { mut found, solved } = bands(model, range, &search, depth)?;
    options.report(&model.critical, range, Some(&found.instabilities));
    let mut samples = searched_samples(model, solved, drawn);
    let unsearched = speeds_beside(&samples, speeds);
    samples.extend(branches::sample(model, &unsearched, progress)?);
    let added = speeds_of_bands(&found.instabilities, &samples, range);
    samples.extend(branches::sample(model, &added, &|_, _| ())?);
    samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    let solved = |speeds: &[f64]| branches::sample(model, speeds, &|_, _| ());
    let samples = branches::refined(model, samples, detail.closeness(), solved)?;
    let drawn: Vec<Sample> = samples.iter().map(numbers).collect();
    let wrong = contradictions(&found.instabilities, &drawn, DRAWN_FLOOR);
    found.certificate.mismatches.extend(wrong);
    Ok(StabilityChart::new(model, samples, found)?)
}

/// Samples at the speeds of a search within a range.
fn searched_samples(
    model: &SpectralModel,
    solved: Vec<ModesAt>,
    drawn: SpeedRange,
) -> Vec<ModesAt> {
    let inside = solved
        .into_iter()
        .filter(|at| drawn.contains(at.speed_rad_per_s));
    let shown = inside.map(|at| ModesAt {
        modes: model.shown(at.modes),
        ..at
    });
    shown.collect()
}

/// The speeds outside the range of samples: a search has enough speeds where bands may be.
fn speeds_beside(samples: &[ModesAt], mut speeds: Vec<f64>) -> Vec<f64> {
    let searched = samples.iter().map(|sample| sample.speed_rad_per_s);
    let first = searched.clone().fold(f64::INFINITY, f64::min);
    let last = searched.fold(0.0, f64::max);
    speeds.retain(|speed| *speed < first || *speed > last);
    speeds
}

fn numbers(sample: &ModesAt) -> Sample {
    Sample::of_modes(sample.speed_rad_per_s, sample.modes.iter())
}

/// Finds every band of an undamped blade in a range of speeds, with the results of its checks. The search
/// begins with `count` even speeds and both sides of every critical speed. A band is cut at the ends of the
/// range.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn undamped_bands(
    model: &SpectralModel,
    range: SpeedRange,
    count: usize,
) -> Result<FoundBands, SpectrumError> {
    let speeds = search_speeds(model, range, count);
    Ok(bands(model, range, &speeds, Depth::Counts)?.found)
}

/// Start speeds of the search for bands: `count` even ones and both sides of every critical speed. The first
/// and the last are slightly outside the range, away from every critical speed.
pub(super) fn search_speeds(model: &SpectralModel, range: SpeedRange, count: usize) -> Vec<f64> {
    let searched = searched_range(&model.critical, range);
    let even = evenly_spaced(searched.ends(), count);
    from_lowest_critical(
        model,
        with_critical_speeds(&model.plate, &model.critical, searched, even),
    )
}

/// Share of |ω| + Ω below which growth of a drawn mode is not compared with the bands: frequencies are
/// accurate to 1e-5 of the chart's height, and growth next to a coalescence to the square root of 1e-5.
const DRAWN_FLOOR: f64 = 1e-3;

/// Ascending speeds from the last one below the first critical speed on. Below it nothing can be unstable:
/// K(Ω) is positive definite, no wave is reflected, and the Krein index is zero.
fn from_lowest_critical(model: &SpectralModel, mut speeds: Vec<f64>) -> Vec<f64> {
    let lowest = model
        .critical
        .first()
        .map_or(f64::INFINITY, |c| c.speed_rad_per_s);
    let below = speeds.partition_point(|speed| *speed < lowest);
    speeds.drain(..below.saturating_sub(1));
    speeds
}

/// Two critical speeds within this relative distance are a double one, of a wave that can have any angular
/// position, as on a free blade.
const DOUBLE: f64 = 1e-9;
/// Relative distance of the search from a double critical speed. Both λ pass through zero in proportion to Ω
/// − Ω_c, not to its square root, and exceed rounding only at a larger distance.
const DOUBLE_GAP: f64 = 1e-4;

/// Relative distance of the search from a critical speed.
fn critical_gap(critical: &[f64], index: usize) -> f64 {
    let is_double = |other: Option<&f64>| {
        other.is_some_and(|other| (other / critical[index] - 1.0).abs() < DOUBLE)
    };
    let below = index.checked_sub(1).and_then(|below| critical.get(below));
    if is_double(below) || is_double(critical.get(index + 1)) {
        DOUBLE_GAP
    } else {
        CRITICAL_GAP.get()
    }
}

/// Relative distance from a critical speed at which an eigenvalue differs clearly from zero.
const CLEAR: f64 = 1e-5;

/// Adds both sides of each group of critical speeds in the range.
pub(super) fn with_critical_speeds(
    plate: &Plate,
    critical: &[NamedCriticalSpeed],
    range: SpeedRange,
    mut speeds: Vec<f64>,
) -> Vec<f64> {
    let critical: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
    if plate.is_axisymmetric() {
        // A wave of the free blade passes through zero without diverging. Next to this zero its Krein sign is
        // determined by rounding errors, so that no speed may be there.
        let clear = |s: &f64| {
            critical
                .iter()
                .all(|c| (s / c - 1.0).abs() > 0.1 * DOUBLE_GAP)
        };
        speeds.retain(clear);
        let beside = critical
            .iter()
            .flat_map(|c| [c * (1.0 - DOUBLE_GAP), c * (1.0 + DOUBLE_GAP)]);
        speeds.extend(beside.filter(|s| (range.from_rad_per_s..range.to_rad_per_s).contains(s)));
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|x, y| (*x / *y - 1.0).abs() < 1e-9);
        return speeds;
    }
    let mut sides: Vec<f64> = Vec::new();
    let mut previous: Option<f64> = None;
    for (index, &speed) in critical.iter().enumerate() {
        let gap = critical_gap(&critical, index);
        let (below, above) = (speed * (1.0 - gap), speed * (1.0 + gap));
        if below <= range.from_rad_per_s || above >= range.to_rad_per_s {
            continue;
        }
        match previous {
            Some(last) if speed <= last * (1.0 + CRITICAL_GROUP) => {
                sides.pop();
            }
            _ => sides.push(below),
        }
        sides.push(above);
        previous = Some(speed);
    }
    speeds.retain(|speed| {
        let mut gaps = (0..critical.len()).map(|k| critical_gap(&critical, k) + CRITICAL_GROUP);
        critical
            .iter()
            .all(|c| gaps.next().is_some_and(|gap| (speed / c - 1.0).abs() > gap))
    });
    speeds.extend(sides);
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// The speeds at which no eigenvalue is next to zero.
fn away_from_critical(model: &SpectralModel, mut speeds: Vec<f64>) -> Vec<f64> {
    let is_clear = |speed: &f64| {
        let mut critical = model.critical.iter();
        critical.all(|c| (speed / c.speed_rad_per_s - 1.0).abs() > CLEAR)
    };
    speeds.retain(is_clear);
    speeds
}

/// Share of the width of a band within which a chart has a speed on each side of its edges.
const BESIDE_EDGE: f64 = 0.06;

/// Speeds at which the largest growth and both edges of bands are drawn, except those near which there are samples.
fn speeds_of_bands(
    instabilities: &[Instability],
    samples: &[ModesAt],
    range: SpeedRange,
) -> Vec<f64> {
    let is_sampled = |within: SpeedRange| {
        let mut speeds = samples.iter().map(|sample| sample.speed_rad_per_s);
        speeds.any(|speed| within.contains(speed))
    };
    let mut speeds = Vec::new();
    for band in instabilities {
        let peak = band.peak_rad_per_s;
        speeds.extend((!is_sampled(SpeedRange::new(peak, peak))).then_some(peak));
        // Speeds on both sides of every critical speed are samples.
        if band.kind == InstabilityKind::Divergence {
            continue;
        }
        let beside = BESIDE_EDGE * band.range().width();
        for edge in band.range().ends() {
            let sides = [
                SpeedRange::new(edge - beside, edge),
                SpeedRange::new(edge, edge + beside),
            ];
            let open = sides.into_iter().filter(|side| !is_sampled(*side));
            speeds.extend(open.map(|side| 0.5 * (side.from_rad_per_s + side.to_rad_per_s)));
        }
    }
    speeds.retain(|speed| range.contains(*speed));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}
