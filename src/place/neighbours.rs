//! Saws a little off the best one: is it a hill or the edge of a cliff?

use rayon::prelude::*;

use crate::scene::Freed;
use crate::stability::{Instability, InstabilityKind};

use super::Progress;
use super::outcome::Outcome;
use super::search::Search;

/// A saw whose numbers are off by what a workshop cannot rule out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Neighbour {
    /// Values of the freed numbers.
    pub values: Vec<f64>,
    /// What it is worth; `None` where there is no such saw.
    pub outcome: Option<Outcome>,
}

/// What happens around the best saw.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Neighbours {
    /// How far each number is moved, in its unit.
    pub offsets: Vec<f64>,
    /// For each number the saws with less and with more of it; `None` past a bound.
    pub along: Vec<[Option<Neighbour>; 2]>,
    /// The worst of these and of the corners between them.
    pub worst: Option<Neighbour>,
    /// Least value of the goal among them, over that of the best saw.
    pub worst_share: f64,
    /// Bands of the best saw that stay a little below the threshold and begin before the
    /// flutter speed: were they to count, it would fall to their onset.
    pub almost: Vec<Instability>,
}

/// A best saw that loses more than this share of its worth next door is a fragile one.
const FRAGILE: f64 = 0.05;
/// A band with this share of the growth that counts is near to counting.
const NEAR: f64 = 0.5;
/// More numbers than these have too many corners.
const MAX_CORNERS: usize = 4;

impl Neighbours {
    pub(super) fn new(
        search: &Search<'_>,
        at: &[f64],
        best: &Outcome,
        progress: Progress<'_>,
    ) -> Self {
        let freed = search.freed;
        let values: Vec<f64> = freed.iter().zip(at).map(|(f, s)| f.value(*s)).collect();
        let offsets: Vec<f64> = freed
            .iter()
            .zip(&values)
            .map(|(f, v)| offset(f, *v))
            .collect();
        let mut steps: Vec<Vec<f64>> = Vec::new();
        for k in 0..freed.len() {
            for sign in [-1.0, 1.0] {
                let mut step = vec![0.0; freed.len()];
                step[k] = sign;
                steps.push(step);
            }
        }
        if (2..=MAX_CORNERS).contains(&freed.len()) {
            steps.extend((0..1_usize << freed.len()).map(|corner| {
                let sign = |k: usize| if corner >> k & 1 == 0 { -1.0 } else { 1.0 };
                (0..freed.len()).map(sign).collect()
            }));
        }
        progress("neighbours", 0, steps.len());
        let neighbours: Vec<Option<Neighbour>> = steps
            .par_iter()
            .map(|step| neighbour(search, &values, &offsets, step))
            .collect();
        progress("neighbours", steps.len(), steps.len());
        let along = (0..freed.len())
            .map(|k| [neighbours[2 * k].clone(), neighbours[2 * k + 1].clone()])
            .collect();
        let worth = |n: &Neighbour| n.outcome.as_ref().map_or(0.0, |o| o.value_rad_per_s);
        let worst = neighbours
            .into_iter()
            .flatten()
            .min_by(|x, y| worth(x).total_cmp(&worth(y)));
        let worst_share = match (&worst, best.value_rad_per_s) {
            (Some(worst), value) if value > 0.0 => worth(worst) / value,
            _ => 1.0,
        };
        Neighbours {
            offsets,
            along,
            worst,
            worst_share,
            almost: almost(best, search.scene.flutter_threshold_per_s),
        }
    }

    /// Whether a little more or less of a number costs much.
    pub fn are_fragile(&self) -> bool {
        self.worst_share < 1.0 - FRAGILE
    }
}

/// What a workshop cannot rule out: two millimetres, a degree, a tenth of a stiffness, one per
/// cent of other numbers.
fn offset(freed: &Freed, value: f64) -> f64 {
    match freed
        .parameter
        .path()
        .rsplit('.')
        .next()
        .unwrap_or_default()
    {
        "radius_m" => 0.002,
        "angle_deg" => 1.0,
        "stiffness_n_per_m" | "damping_n_s_per_m" => 0.1 * value,
        _ => 0.01 * value.abs(),
    }
}

/// `None` past a bound: there no such saw is asked for.
fn neighbour(
    search: &Search<'_>,
    values: &[f64],
    offsets: &[f64],
    step: &[f64],
) -> Option<Neighbour> {
    let moved: Vec<f64> = (0..values.len())
        .map(|k| values[k] + step[k] * offsets[k])
        .collect();
    let pairs = || search.freed.iter().zip(&moved);
    if !pairs().all(|(f, v)| (f.from..=f.to).contains(v)) {
        return None;
    }
    let shares: Vec<f64> = pairs().map(|(f, v)| f.share(*v)).collect();
    Some(Neighbour {
        outcome: search.outcome(&shares),
        values: moved,
    })
}

fn almost(best: &Outcome, threshold_per_s: f64) -> Vec<Instability> {
    let before = best.flutter_rad_per_s.unwrap_or(f64::INFINITY);
    let near = |b: &&Instability| {
        b.kind == InstabilityKind::Flutter
            && b.from_rad_per_s < before
            && b.peak_growth_per_s >= NEAR * threshold_per_s
    };
    best.bands.iter().filter(near).cloned().collect()
}
