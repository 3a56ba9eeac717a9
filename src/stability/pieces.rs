//! Pieces of the range of speeds, each with interpolated low eigenvalues.
//!
//! A piece is kept if it predicts the eigenvalues of one more eigenproblem, at the speed at which two of them
//! are nearest to each other; otherwise it is divided at that speed. An event narrower than any grid, such as
//! a short growth or a coalescence, is therefore found at the minimum of the discriminant of its group.

use std::sync::Arc;

use faer::c64;
use rayon::prelude::*;

use super::group::{Group, Sloped};
use super::partition::{Places, partition};
use super::sample::{Plane, Sample};
use crate::modes::{SpectrumError, Work, smallest};

/// A group between two samples.
#[derive(Debug, Clone)]
pub struct Grouped {
    /// Its eigenvalues over the piece.
    pub group: Group,
    /// Indices of its numbers in the two samples.
    pub places: Places,
    /// Krein sign of all waves of the group; `None` for other groups, whose numbers may coalesce.
    pub sign: Option<i8>,
}

/// Piece between two neighbouring computed speeds.
#[derive(Debug, Clone)]
pub struct Piece {
    /// Samples at both speeds.
    pub ends: [Arc<Sample>; 2],
    /// Groups from the real axis upwards; empty if the piece was not settled, because it is too narrow or the
    /// allowed number of speeds is used up.
    pub groups: Vec<Grouped>,
}

impl Piece {
    /// Whether a speed is within the piece.
    pub fn contains(&self, speed_rad_per_s: f64) -> bool {
        let [from, to] = self.ends.each_ref().map(|end| end.speed_rad_per_s);
        (from..=to).contains(&speed_rad_per_s)
    }

    /// The settled one of ascending pieces that contains a speed.
    pub fn settled(pieces: &[Piece], speed_rad_per_s: f64) -> Option<&Piece> {
        let ends_below = |piece: &Piece| piece.ends[1].speed_rad_per_s < speed_rad_per_s;
        let piece = pieces.get(pieces.partition_point(ends_below))?;
        (!piece.groups.is_empty() && piece.contains(speed_rad_per_s)).then_some(piece)
    }
}

/// Largest number of eigenvalues of a group in a wide piece.
const USUAL: usize = 2;
/// Largest number of eigenvalues of a group in a narrow piece, and of waves of one Krein sign.
const LARGEST: usize = 4;
/// Width of a narrow piece, as a share of the speed.
const NARROW: f64 = 3e-4;
/// Pieces narrower than this share of the last speed are not divided.
const LEAST_WIDTH: f64 = 1e-9;
/// Smallest distance of an added speed from the ends of its piece, as a share of the width.
const MARGIN: f64 = 0.05;
/// Number of steps in which a group is searched for hidden coalescences.
const STEPS: usize = 16;
/// A discriminant that falls below this share of its end values may hide a coalescence.
const DIP: f64 = 0.05;

/// Accuracy and data of a search.
pub struct Search<'a> {
    /// Kind of the numbers to follow.
    pub plane: Plane,
    /// Frequency up to which to follow, in rad/s.
    pub top_rad_per_s: f64,
    /// Relative error allowed for the numbers.
    pub tolerance: f64,
    /// Relative error allowed for waves of one Krein sign, which cannot coalesce with each other.
    pub definite_tolerance: f64,
    /// Relative error allowed for a growth rate.
    pub growth_tolerance: f64,
    /// Growth that is rounding, in 1/s.
    pub noise_per_s: f64,
    /// Computes a sample at or next to a speed; `None` once the allowed number is used up.
    pub solve: &'a (dyn Fn(f64) -> Result<Option<Sample>, SpectrumError> + Sync),
}

impl Search<'_> {
    /// Pieces that cover the range from the first to the last of ascending speeds. The pieces do not depend
    /// on the number of threads.
    ///
    /// # Errors
    /// The errors of the eigenproblems.
    pub fn pieces(&self, speeds: &[f64]) -> Result<Vec<Piece>, SpectrumError> {
        let least = LEAST_WIDTH * speeds.last().copied().unwrap_or(0.0);
        let solved: Vec<Option<Sample>> = speeds
            .par_iter()
            .map(|&speed| (self.solve)(speed))
            .collect::<Result<_, _>>()?;
        let samples: Vec<Arc<Sample>> = solved.into_iter().flatten().map(Arc::new).collect();
        let work = &Work::of("pieces of the search", samples.len().saturating_sub(1));
        let pieces: Vec<Vec<Piece>> = samples
            .par_windows(2)
            .map(|ends| {
                let found = self.between([&ends[0], &ends[1]], None, least, work);
                work.advance();
                found
            })
            .collect::<Result<_, _>>()?;
        Ok(pieces.into_iter().flatten().collect())
    }

    /// Pieces between two samples; `kept` are groups that were compared with a further sample already.
    fn between(
        &self,
        ends: [&Arc<Sample>; 2],
        kept: Option<Vec<Grouped>>,
        least_rad_per_s: f64,
        work: &Work,
    ) -> Result<Vec<Piece>, SpectrumError> {
        let [a, b] = ends.map(|end| end.speed_rad_per_s);
        let alone = |groups: Vec<Grouped>| {
            vec![Piece {
                ends: ends.map(Arc::clone),
                groups,
            }]
        };
        if b - a < least_rad_per_s {
            return Ok(alone(kept.unwrap_or_default()));
        }
        let is_kept = kept.is_some();
        let groups = kept.or_else(|| self.groups(ends));
        let place = groups
            .as_ref()
            .and_then(|groups| self.doubtful_speed(groups, [a, b]));
        if let (true, None, Some(groups)) = (is_kept, place, &groups) {
            return Ok(alone(groups.clone()));
        }
        let speed = place
            .unwrap_or(0.5 * (a + b))
            .clamp(a + MARGIN * (b - a), b - MARGIN * (b - a));
        let Some(found) = (self.solve)(speed)? else {
            return Ok(alone(Vec::new()));
        };
        let found = Arc::new(found);
        work.extend(1);
        let halves = [[ends[0], &found], [&found, ends[1]]];
        let predicted: Option<Vec<Prediction>> = groups.as_ref().and_then(|groups| {
            let all = groups.iter().map(|g| self.predicted(g, ends, &found));
            all.collect()
        });
        let predicted = predicted.filter(|predicted| {
            are_distinct(predicted.iter().flat_map(|group| group.places.iter()))
        });
        let misfit = predicted
            .iter()
            .flatten()
            .map(|group| group.misfit)
            .fold(0.0, f64::max);
        let share = (speed - a) / (b - a);
        let mut pieces = Vec::new();
        for (end, half) in halves.into_iter().enumerate() {
            // A half of the piece keeps the groups if the error of their prediction is small enough over the
            // whole half.
            let is_close = left_by(misfit, share, [share, 1.0 - share][end]) <= 1.0;
            let kept = groups
                .as_ref()
                .zip(predicted.as_ref())
                .filter(|_| is_close)
                .map(|(groups, predicted)| {
                    let parts = groups.iter().zip(predicted).map(|(grouped, predicted)| {
                        let mut places = [predicted.places.clone(), predicted.places.clone()];
                        places[end].clone_from(&grouped.places[end]);
                        places
                    });
                    grouped_by(half, &parts.collect::<Vec<_>>())
                });
            pieces.extend(self.between(half, kept, least_rad_per_s, work)?);
        }
        work.advance();
        Ok(pieces)
    }

    /// Groups between two samples; `None` if one of them is too large.
    fn groups(&self, ends: [&Arc<Sample>; 2]) -> Option<Vec<Grouped>> {
        let [a, b] = ends.map(|end| end.speed_rad_per_s);
        let is_wide = b - a > NARROW * b;
        let is_fit = |places: &Places| {
            let is_definite = definite_sign(places, ends).is_some();
            let most = if is_wide && !is_definite {
                USUAL
            } else {
                LARGEST
            };
            places[0].len() <= most
        };
        let parts = partition(self.plane, ends.map(Arc::as_ref), self.top_rad_per_s)
            .filter(|parts| parts.iter().all(is_fit))?;
        Some(grouped_by(ends, &parts))
    }

    /// Speed at which two eigenvalues of a group are nearest to each other, or else at which one that decays
    /// at both ends may grow; `None` without such a speed.
    fn doubtful_speed(&self, groups: &[Grouped], [a, b]: [f64; 2]) -> Option<f64> {
        let speed = |k: usize| a + (b - a) * k as f64 / STEPS as f64;
        let inner = |values: &[f64]| {
            let least = smallest(0..values.len(), |&place| values[place])?;
            let shift = parabola(values.get(least.checked_sub(1)?..=least + 1)?);
            Some((least, speed(least) + shift * (b - a) / STEPS as f64))
        };
        let may_coalesce = |g: &&Grouped| g.group.size() > 1 && g.sign.is_none();
        let dips = groups.iter().filter(may_coalesce).filter_map(|g| {
            let sizes: Vec<f64> = (0..=STEPS)
                .map(|k| g.group.discriminant(speed(k)).norm())
                .collect();
            let (least, place) = inner(&sizes)?;
            let share = sizes[least] / sizes[0].max(sizes[STEPS]);
            (share < DIP).then_some((share, place))
        });
        let deepest = dips.min_by(|x, y| x.0.total_cmp(&y.0));
        deepest.map(|(_, place)| place).or_else(|| {
            let slowest = |g: &Grouped, speed: f64| {
                let growth = g
                    .group
                    .at(speed)
                    .into_iter()
                    .map(|z| self.plane.growth_per_s(z));
                -growth.fold(f64::MIN, f64::max)
            };
            groups.iter().find_map(|g| {
                let decay: Vec<f64> = (0..=STEPS).map(|k| slowest(g, speed(k))).collect();
                let (least, place) = inner(&decay)?;
                (decay[least] < -self.noise_per_s && decay[0] > 0.0 && decay[STEPS] > 0.0)
                    .then_some(place)
            })
        })
    }

    /// Prediction of a sample by a group; `None` if the sample contradicts it.
    fn predicted(
        &self,
        grouped: &Grouped,
        ends: [&Arc<Sample>; 2],
        sample: &Sample,
    ) -> Option<Prediction> {
        let predicted = grouped.group.at(sample.speed_rad_per_s);
        let nearest = |z: &c64| {
            let all = 0..sample.eigenvalues.len();
            smallest(all, |&place| (sample.eigenvalues[place].0 - z).norm())
        };
        let places: Vec<usize> = predicted.iter().map(nearest).collect::<Option<_>>()?;
        let found: Vec<c64> = places
            .iter()
            .map(|&place| sample.eigenvalues[place].0)
            .collect();
        let off = predicted
            .iter()
            .zip(&found)
            .map(|(x, z)| (x - z).norm())
            .fold(0.0, f64::max);
        let size = predicted
            .iter()
            .map(|z| z.norm())
            .fold(0.0, f64::max)
            .max(self.plane.sized(1e-3 * self.top_rad_per_s));
        let misfit = match grouped.sign {
            Some(sign) if places.iter().any(|&place| sample.signs[place] != sign) => return None,
            Some(_) => off / (self.definite_tolerance * size),
            None => {
                let at_ends = [0, 1].map(|end| {
                    let places = grouped.places[end].iter();
                    let numbers = places.map(|&place| ends[end].eigenvalues[place].0);
                    numbers.collect::<Vec<_>>()
                });
                let of_growth = self.misfit_of_growth(&at_ends, [&predicted, &found], off);
                (off / (self.tolerance * size)).max(of_growth)
            }
        };
        (misfit <= 1.0).then_some(Prediction { places, misfit })
    }

    /// Error of the growth predicted by a group, as a share of the allowed error, if its numbers are wrong by
    /// `off`.
    fn misfit_of_growth(
        &self,
        at_ends: &[Vec<c64>; 2],
        [predicted, found]: [&[c64]; 2],
        off: f64,
    ) -> f64 {
        let by_growth = |numbers: &[c64]| {
            let mut growth: Vec<f64> = numbers
                .iter()
                .map(|z| self.plane.growth_per_s(*z))
                .collect();
            growth.sort_by(|x, y| y.total_cmp(x));
            growth
        };
        let ends = at_ends.each_ref().map(|numbers| by_growth(numbers));
        let (growth_predicted, growth_found) = (by_growth(predicted), by_growth(found));
        let all = [&ends[0], &ends[1], &growth_predicted, &growth_found];
        // The allowed error is relative to each growth rate, so that slow growth is predicted with the same
        // relative accuracy as fast growth beside it.
        let allowed = |rank: usize| {
            let fastest = all.iter().map(|growth| growth[rank]).fold(0.0, f64::max);
            (self.growth_tolerance * fastest).max(self.noise_per_s)
        };
        let misfit = |rank: usize| {
            let (x, z) = (growth_predicted[rank], growth_found[rank]);
            // Fast decay may have an error of 30 %, because it does not affect stability.
            let allowed = allowed(rank).max(0.3 * -x.max(z));
            ((x - z).abs() - self.noise_per_s).max(0.0) / allowed
        };
        let of_each = (0..predicted.len()).map(misfit).fold(0.0, f64::max);
        if predicted.len() == 1 {
            return of_each;
        }
        let pairs = (0..predicted.len()).flat_map(|i| (0..i).map(move |k| (i, k)));
        let gap = pairs
            .map(|(i, k)| (predicted[i] - predicted[k]).norm())
            .fold(f64::INFINITY, f64::min);
        let least = match self.plane {
            Plane::Eigenvalues => allowed(0),
            Plane::Squares => {
                2.0 * allowed(0)
                    * predicted
                        .iter()
                        .map(|z| z.norm())
                        .fold(0.0, f64::max)
                        .sqrt()
            }
        };
        let allowed = least.max(0.05 * gap).max(0.3 * -growth_predicted[0]);
        of_each.max(off / allowed)
    }
}

/// Prediction that a sample confirmed.
struct Prediction {
    /// Indices of the predicted eigenvalues in the sample.
    places: Vec<usize>,
    /// Error, as a share of the allowed error.
    misfit: f64,
}

/// Error of a cubic over a part of a piece, as a share of the error allowed there, from the error `misfit` of
/// the cubic over the whole piece at a share of it. The error of Hermite's formula is in proportion to t²(1 −
/// t)² and to the fourth power of the width. A quarter of the allowed error of a sample is allowed here,
/// because the part is not sampled.
fn left_by(misfit: f64, share: f64, part: f64) -> f64 {
    let of_whole = misfit / (16.0 * (share * (1.0 - share)).powi(2));
    4.0 * of_whole * part.powi(4)
}

/// Krein sign of a group, if it consists of waves of one sign at both ends.
fn definite_sign(places: &Places, ends: [&Arc<Sample>; 2]) -> Option<i8> {
    let mut signs = [0, 1].into_iter().flat_map(|end| {
        let places = places[end].iter();
        places.map(move |&place| ends[end].signs.get(place).copied().unwrap_or(0))
    });
    let first = signs.next().filter(|sign| *sign != 0)?;
    signs.all(|sign| sign == first).then_some(first)
}

fn are_distinct<'a>(places: impl Iterator<Item = &'a usize>) -> bool {
    let mut places: Vec<usize> = places.copied().collect();
    let count = places.len();
    places.sort_unstable();
    places.dedup();
    places.len() == count
}

fn grouped_by(ends: [&Arc<Sample>; 2], parts: &[Places]) -> Vec<Grouped> {
    let speeds = ends.map(|end| end.speed_rad_per_s);
    let of = |places: &Places| {
        let at = |end: usize| -> Vec<Sloped> {
            let places = places[end].iter();
            places.map(|&place| ends[end].eigenvalues[place]).collect()
        };
        Grouped {
            group: Group::new(speeds, [&at(0), &at(1)]),
            places: places.clone(),
            sign: definite_sign(places, ends),
        }
    };
    parts.iter().map(of).collect()
}

/// Position of the minimum of the parabola through three values at −1, 0 and 1; 0 without a minimum.
fn parabola(values: &[f64]) -> f64 {
    let [x, y, z] = values else { return 0.0 };
    let curvature = x - 2.0 * y + z;
    if curvature > 0.0 {
        (0.5 * (x - z) / curvature).clamp(-1.0, 1.0)
    } else {
        0.0
    }
}
