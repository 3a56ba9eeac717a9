//! Diagram of a saw, read off the search for its bands.
//!
//! Modes are computed with their shapes near every second of the even speeds, beside critical speeds and at the peaks of bands, unless
//! the search has seen them. All others are read off its pieces ([`Between`]), at as many speeds as lines need.

use super::between::Between;
use super::certificate::contradictions;
use super::critical_sides::with_critical_speeds;
use super::error::AnalysisError;
use super::options::AnalysisOptions;
use super::sample::Sample;
use super::search_result::{FoundBands, StabilityChart};
use crate::model::evenly_spaced;
use crate::model::scene::SpeedRange;
use crate::modes::branches::{self, ModesAt};
use crate::modes::{SpectralModel, smallest};

/// Speeds of a diagram before those at its bands.
pub struct DrawnSpeeds {
    /// Speeds at which, or near which, modes have shapes, with both sides of critical speeds.
    pub shaped: Vec<f64>,
    /// All even speeds, and both sides of critical speeds.
    pub all: Vec<f64>,
}

impl DrawnSpeeds {
    /// Speeds of a diagram with `count` even ones.
    pub fn new(model: &SpectralModel, range: SpeedRange, count: usize) -> Self {
        let with_sides = |count: usize| {
            let even = evenly_spaced(range.ends(), count);
            with_critical_speeds(&model.plate, &model.critical, range, even)
        };
        DrawnSpeeds {
            shaped: with_sides(count.div_ceil(2)),
            all: with_sides(count),
        }
    }

    /// Those of seen modes that are nearest to a speed at which modes have shapes.
    pub fn thinned(&self, seen: Vec<ModesAt>) -> Vec<ModesAt> {
        let mut is_nearest = vec![false; seen.len()];
        for speed in &self.shaped {
            let off = |at: &usize| (seen[*at].speed_rad_per_s - speed).abs();
            if let Some(nearest) = smallest(0..seen.len(), off) {
                is_nearest[nearest] = true;
            }
        }
        let kept = seen.into_iter().zip(is_nearest);
        kept.filter_map(|(sample, is_nearest)| is_nearest.then_some(sample))
            .collect()
    }
}

/// The diagram of found bands: modes that the search has seen, and those at `speeds`, the peaks of bands and `beside` their edges.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails.
pub fn drawn(
    between: &Between<'_>,
    speeds: &DrawnSpeeds,
    seen: Vec<ModesAt>,
    beside: &[f64],
    mut found: FoundBands,
    options: AnalysisOptions<'_>,
) -> Result<StabilityChart, AnalysisError> {
    let model = between.model;
    let peaks = found.instabilities.iter().map(|band| band.peak_rad_per_s);
    let mut open: Vec<f64> = unseen(&speeds.shaped, &seen).chain(peaks).collect();
    open.retain(|speed| seen.iter().all(|sample| sample.speed_rad_per_s != *speed));
    let computed = branches::sample(model, &open, options.progress)?;
    if model.is_conservative() {
        let numbers = |at: &ModesAt| Sample::of_modes(at.speed_rad_per_s, at.modes.iter());
        let numbers: Vec<Sample> = computed.iter().map(numbers).collect();
        let wrong = contradictions(&found.instabilities, &numbers, DRAWN_FLOOR);
        found.certificate.mismatches.extend(wrong);
    }
    let interpolated = [speeds.all.as_slice(), beside].concat();
    let mut samples = [seen, computed, between.at_all(&interpolated)?].concat();
    samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    samples.dedup_by(|next, last| {
        let is_same = next.speed_rad_per_s <= last.speed_rad_per_s * (1.0 + SAME);
        if is_same && !last.is_solved() {
            std::mem::swap(next, last);
        }
        is_same
    });
    let at = |speeds: &[f64]| between.at_all(speeds);
    let samples = branches::refined(model, samples, options.detail.closeness(), at)?;
    Ok(StabilityChart::new(model, samples, found)?)
}

/// Share of |ω| + Ω below which growth of a drawn mode is not compared with the bands: frequencies are
/// accurate to 1e-5 of the chart's height, and growth next to a coalescence to the square root of 1e-5.
const DRAWN_FLOOR: f64 = 1e-3;

/// Relative distance of two speeds that are one.
const SAME: f64 = 1e-12;

/// The speeds to which no sample is nearer than half the distance to their neighbours; the first and the last one need a sample of
/// their own.
fn unseen(speeds: &[f64], seen: &[ModesAt]) -> impl Iterator<Item = f64> {
    let is_seen = |k: usize| {
        let speed = speeds[k];
        let to_neighbour = match k.checked_sub(1).zip(speeds.get(k + 1)) {
            Some((before, after)) => (speed - speeds[before]).min(after - speed),
            None => 0.0,
        };
        let off = seen.iter().map(|at| (at.speed_rad_per_s - speed).abs());
        smallest(off, |off| *off).is_some_and(|off| off <= 0.5 * to_neighbour)
    };
    (0..speeds.len())
        .filter(move |k| !is_seen(*k))
        .map(|k| speeds[k])
}
