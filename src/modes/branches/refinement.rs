//! Additional speeds of a chart where a branch bends or leaves the chart.

use rayon::prelude::*;

use super::links::{are_certain, links};
use super::points::ModesAt;
use super::{CampbellError, room_for_more};
use crate::modes::{Mode, ModeKind, SpectralModel};

/// Accuracy of the lines of a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closeness {
    /// Allowed distance of a line from its branch, as a share of the chart's height.
    pub chord: f64,
    /// Distance below the top of the chart at which a line may end, as a share of its height.
    pub end: f64,
    /// Number of times that a step may be halved.
    pub halvings: usize,
}

impl Closeness {
    /// Accuracy of a figure of some hundred pixels, which may show a third of the height: with 0.003 in place of 0.0015 the veerings
    /// of `scenes/gallery/weak-pad.json` had visible corners.
    pub const FIGURE: Closeness = Closeness {
        chord: 0.0015,
        end: 0.01,
        halvings: 6,
    };
    /// Accuracy of a preview: branches are followed but drawn with corners.
    pub const SKETCH: Closeness = Closeness {
        chord: 0.02,
        end: 0.1,
        halvings: 3,
    };
}

/// Steps below this share of the speed are not halved: next to a coalescence no step is small enough.
const LEAST_STEP: f64 = 1e-6;

/// Allowed distance of a growth rate, or its square, from the line between its neighbours, as a share of the larger
/// neighbour: five points on a parabola are enough.
const GROWTH_CHORD: f64 = 0.13;

/// Adds the modes `at` further speeds to samples at ascending speeds until the lines between them are accurate, the allowed
/// halvings are used up, or the allowed memory is full.
///
/// # Errors
/// [`CampbellError`] of a speed that fails.
pub fn refined(
    model: &SpectralModel,
    mut samples: Vec<ModesAt>,
    closeness: Closeness,
    at: impl Fn(&[f64]) -> Result<Vec<ModesAt>, CampbellError>,
) -> Result<Vec<ModesAt>, CampbellError> {
    let mut open: Vec<f64> = samples.iter().map(|s| s.speed_rad_per_s).collect();
    for _ in 0..closeness.halvings {
        let doubtful: Vec<(f64, f64)> = samples
            .par_windows(2)
            .filter(|pair| {
                open.binary_search_by(|s| s.total_cmp(&pair[0].speed_rad_per_s))
                    .is_ok()
            })
            .filter(|pair| is_doubtful(model, [&pair[0], &pair[1]], closeness))
            .map(|pair| (pair[0].speed_rad_per_s, pair[1].speed_rad_per_s))
            .collect();
        if doubtful.is_empty() || doubtful.len() > room_for_more(model, &samples) {
            break;
        }
        let middle: Vec<f64> = doubtful
            .iter()
            .map(|(from, to)| 0.5 * (from + to))
            .collect();
        samples.extend(at(&middle)?);
        samples.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        open = doubtful
            .iter()
            .zip(&middle)
            .flat_map(|((from, _), middle)| [*from, *middle])
            .collect();
    }
    Ok(samples)
}

/// Whether a line from one speed to the next would misrepresent the modes.
fn is_doubtful(
    model: &SpectralModel,
    [before, after]: [&ModesAt; 2],
    closeness: Closeness,
) -> bool {
    let height = model.complete_to_rad_per_s;
    let step = after.speed_rad_per_s - before.speed_rad_per_s;
    if step < LEAST_STEP * after.speed_rad_per_s {
        return false;
    }
    let links = links([&before.modes, &after.modes], step, height);
    let ends_inside = |modes: &[Mode], is_linked: &dyn Fn(usize) -> bool| {
        let mut left = modes.iter().enumerate().filter(|(k, _)| !is_linked(*k));
        left.any(|(_, mode)| mode.frequency_rad_per_s() < (1.0 - closeness.end) * height)
    };
    let doubtful = |(k, next): (usize, &Option<usize>)| {
        let Some(next) = *next else { return false };
        let ends = [&before.modes[k], &after.modes[next]];
        bend(ends, step) > closeness.chord * height || growth_bends(ends, step)
    };
    ends_inside(&before.modes, &|k| links[k].is_some())
        || ends_inside(&after.modes, &|k| links.contains(&Some(k)))
        || links.iter().enumerate().any(doubtful)
        || !are_certain([&before.modes, &after.modes], step, &links)
}

/// Distance, in rad/s, in the middle of a step between the cubic through two frequencies with their slopes
/// and the line; 0 if a mode is not a wave.
fn bend(ends: [&Mode; 2], step: f64) -> f64 {
    let is_wave = |mode: &Mode| mode.krein_sign() != 0 || mode.kind == ModeKind::Damped;
    if !ends.into_iter().all(is_wave) {
        return 0.0;
    }
    let slope = |mode: &Mode| match mode.kind {
        ModeKind::Damped => mode.slope.im,
        _ => f64::from(mode.action) * mode.slope.im,
    };
    0.125 * (slope(ends[0]) - slope(ends[1])).abs() * step
}

/// Whether the growth rates of a mode deviate too far from a line: without damping their squares, nearly a parabola over a band.
fn growth_bends(ends: [&Mode; 2], step: f64) -> bool {
    let sloped = |mode: &Mode| match mode.kind {
        ModeKind::Flutter | ModeKind::Divergent => {
            let growth = mode.lambda.re;
            Some([growth.powi(2), 2.0 * growth * mode.slope.re])
        }
        ModeKind::Damped => Some([mode.lambda.re, mode.slope.re]),
        _ => None,
    };
    let [Some([from, first]), Some([to, last])] = ends.map(sloped) else {
        return false;
    };
    0.125 * (first - last).abs() * step > GROWTH_CHORD * from.abs().max(to.abs())
}
