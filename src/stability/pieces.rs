//! Pieces of the range of speeds, on each of which every low eigenvalue follows from its two ends.
//!
//! A piece is kept where it says beforehand which eigenvalues one more eigenproblem finds, asked where two of them come
//! nearest; where it does not, the speed that was asked parts it. So what happens within less than any grid, a growth between
//! two decays or a coalescence, is found where the discriminant of a group has its minimum.

use std::sync::Arc;

use faer::c64;
use rayon::prelude::*;

use super::group::{Group, Sloped};
use super::partition::{Places, Sample, partition};
use crate::spectrum::SpectrumError;

/// A group between two samples.
#[derive(Debug, Clone)]
pub struct Grouped {
    pub group: Group,
    pub places: Places,
}

/// Between two neighbouring speeds that were asked.
#[derive(Debug, Clone)]
pub struct Piece {
    pub ends: [Arc<Sample>; 2],
    /// From the real axis up; none where no number of speeds settled the piece.
    pub groups: Vec<Grouped>,
}

/// Eigenvalues of one group at most; of more than two in narrow pieces only.
const LARGEST: usize = 4;
const USUAL: usize = 2;
/// Width of such pieces as a share of the speed.
const NARROW: f64 = 3e-4;
/// Share of the last speed below which a piece is not parted.
const LEAST_WIDTH: f64 = 1e-9;
/// Speeds of a piece that are asked are kept from its ends by this share of it.
const MARGIN: f64 = 0.05;
/// Steps in which a group is looked at for what it may hide.
const STEPS: usize = 16;
/// A discriminant that falls below this share of its values at the ends may hide a coalescence.
const DIP: f64 = 0.05;

/// How closely eigenvalues are followed, and from what.
pub struct Search<'a> {
    /// Frequency up to which they are followed, in rad/s.
    pub top_rad_per_s: f64,
    /// Relative error allowed of an eigenvalue.
    pub tolerance: f64,
    /// Relative error allowed of a growth.
    pub growth_tolerance: f64,
    /// Growth that is rounding, in 1/s.
    pub noise_per_s: f64,
    /// Eigenvalues at a speed; `None` once no more may be asked for.
    pub solve: &'a (dyn Fn(f64) -> Result<Option<Sample>, SpectrumError> + Sync),
}

impl Search<'_> {
    /// Pieces that cover all between the first and the last of ascending speeds. The same on any number of threads.
    ///
    /// # Errors
    /// Those of the eigenproblems.
    pub fn pieces(&self, speeds: &[f64]) -> Result<Vec<Piece>, SpectrumError> {
        let least = LEAST_WIDTH * speeds.last().copied().unwrap_or(0.0);
        let samples: Vec<Option<Sample>> = speeds
            .par_iter()
            .map(|&speed| (self.solve)(speed))
            .collect::<Result<_, _>>()?;
        let samples: Vec<Arc<Sample>> = samples.into_iter().flatten().map(Arc::new).collect();
        let pieces: Vec<Vec<Piece>> = samples
            .par_windows(2)
            .map(|ends| self.between([&ends[0], &ends[1]], least))
            .collect::<Result<_, _>>()?;
        Ok(pieces.into_iter().flatten().collect())
    }

    fn between(
        &self,
        ends: [&Arc<Sample>; 2],
        least_rad_per_s: f64,
    ) -> Result<Vec<Piece>, SpectrumError> {
        let [a, b] = ends.map(|end| end.speed_rad_per_s);
        let unsettled = || {
            Ok(vec![Piece {
                ends: ends.map(Arc::clone),
                groups: Vec::new(),
            }])
        };
        if b - a < least_rad_per_s {
            return unsettled();
        }
        let parts = partition(ends.map(Arc::as_ref), self.top_rad_per_s);
        let is_wide = b - a > NARROW * b;
        let may_be = if is_wide { USUAL } else { LARGEST };
        let is_fit = |parts: &Vec<Places>| parts.iter().all(|[x, _]| x.len() <= may_be);
        let groups = parts.filter(is_fit).map(|parts| grouped(ends, &parts));
        let place = groups
            .as_ref()
            .and_then(|groups| self.place_to_ask(groups, (a, b)));
        let asked = place.unwrap_or(0.5 * (a + b));
        let asked = asked.clamp(a + MARGIN * (b - a), b - MARGIN * (b - a));
        let Some(found) = (self.solve)(asked)? else {
            return unsettled();
        };
        let found = Arc::new(found);
        let told: Option<Vec<Vec<usize>>> = groups.as_ref().and_then(|groups| {
            let all = groups.iter().map(|g| self.told(g, ends, &found));
            all.collect()
        });
        let halves = [[ends[0], &found], [&found, ends[1]]];
        // The halves keep the groups that were held against what was found.
        if let (Some(groups), Some(told)) = (groups, told)
            && are_distinct(told.iter().flatten())
        {
            let within = |end: usize| {
                let parts = groups.iter().zip(&told).map(|(grouped, middle)| {
                    let mut places = [middle.clone(), middle.clone()];
                    places[end].clone_from(&grouped.places[end]);
                    places
                });
                Piece {
                    ends: halves[end].map(Arc::clone),
                    groups: grouped(halves[end], &parts.collect::<Vec<_>>()),
                }
            };
            return Ok(vec![within(0), within(1)]);
        }
        let mut pieces = self.between(halves[0], least_rad_per_s)?;
        pieces.extend(self.between(halves[1], least_rad_per_s)?);
        Ok(pieces)
    }

    /// Where two eigenvalues of a group come nearest between the ends, else where one that decays at both ends may
    /// grow.
    fn place_to_ask(&self, groups: &[Grouped], (a, b): (f64, f64)) -> Option<f64> {
        let speed = |k: usize| a + (b - a) * k as f64 / STEPS as f64;
        let inner = |values: &[f64]| {
            let least = (0..values.len()).min_by(|&i, &k| values[i].total_cmp(&values[k]))?;
            let shift = parabola(values.get(least.checked_sub(1)?..=least + 1)?);
            Some((least, speed(least) + shift * (b - a) / STEPS as f64))
        };
        let dip = groups.iter().filter(|g| g.group.size() > 1).find_map(|g| {
            let sizes: Vec<f64> = (0..=STEPS)
                .map(|k| g.group.discriminant(speed(k)).norm())
                .collect();
            let (least, place) = inner(&sizes)?;
            (sizes[least] < DIP * sizes[0].max(sizes[STEPS])).then_some(place)
        });
        dip.or_else(|| {
            groups.iter().find_map(|g| {
                let decay: Vec<f64> = (0..=STEPS)
                    .map(|k| {
                        -g.group
                            .at(speed(k))
                            .iter()
                            .fold(f64::MIN, |top, z| top.max(z.re))
                    })
                    .collect();
                let (least, place) = inner(&decay)?;
                (decay[least] < 0.0 && decay[0] > 0.0 && decay[STEPS] > 0.0).then_some(place)
            })
        })
    }

    /// Places of the eigenvalues found that a group told; `None` where it told others.
    fn told(
        &self,
        grouped: &Grouped,
        ends: [&Arc<Sample>; 2],
        sample: &Sample,
    ) -> Option<Vec<usize>> {
        let told = grouped.group.at(sample.speed_rad_per_s);
        let nearest = |z: &c64| {
            let away = |&place: &usize| (sample.eigenvalues[place].0 - z).norm();
            let all = 0..sample.eigenvalues.len();
            all.min_by(|x, y| away(x).total_cmp(&away(y)))
        };
        let places: Vec<usize> = told.iter().map(nearest).collect::<Option<_>>()?;
        let found: Vec<c64> = places
            .iter()
            .map(|&place| sample.eigenvalues[place].0)
            .collect();
        let pairs = || told.iter().zip(&found);
        let off = pairs().map(|(x, z)| (x - z).norm()).fold(0.0, f64::max);
        let size = told.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if off.is_nan() || off > self.tolerance * size.max(1e-3 * self.top_rad_per_s) {
            return None;
        }
        let at_ends = [0, 1].into_iter().flat_map(|end| {
            let places = grouped.places[end].iter();
            places.map(move |&place| ends[end].eigenvalues[place].0.re)
        });
        let growth = at_ends.chain(found.iter().chain(&told).map(|z| z.re));
        let fastest = growth.fold(0.0, f64::max);
        let least = self.growth_tolerance * fastest + self.noise_per_s;
        // How fast something decays is of no account.
        let is_growth_told = |(x, z): (&c64, &c64)| {
            let decay = -x.re.max(z.re);
            (x.re - z.re).abs() <= least.max(0.3 * decay)
        };
        if !pairs().all(is_growth_told) {
            return None;
        }
        let apart = (0..told.len()).flat_map(|i| (0..i).map(move |k| (i, k)));
        let gap = apart
            .map(|(i, k)| (told[i] - told[k]).norm())
            .fold(f64::INFINITY, f64::min);
        let decay = -told.iter().fold(f64::MIN, |top, z| top.max(z.re));
        let is_pair_told = told.len() == 1 || off <= least.max(0.05 * gap).max(0.3 * decay);
        is_pair_told.then_some(places)
    }
}

fn are_distinct<'a>(places: impl Iterator<Item = &'a usize>) -> bool {
    let mut places: Vec<usize> = places.copied().collect();
    let count = places.len();
    places.sort_unstable();
    places.dedup();
    places.len() == count
}

fn grouped(ends: [&Arc<Sample>; 2], parts: &[Places]) -> Vec<Grouped> {
    let speeds = ends.map(|end| end.speed_rad_per_s);
    let of = |places: &Places| {
        let at = |end: usize| -> Vec<Sloped> {
            let places = places[end].iter();
            places.map(|&place| ends[end].eigenvalues[place]).collect()
        };
        Grouped {
            group: Group::new((speeds[0], speeds[1]), [&at(0), &at(1)]),
            places: places.clone(),
        }
    };
    parts.iter().map(of).collect()
}

/// Vertex of the parabola through three values at −1, 0 and 1.
fn parabola(values: &[f64]) -> f64 {
    let [x, y, z] = values else { return 0.0 };
    let curvature = x - 2.0 * y + z;
    match curvature > 0.0 {
        true => (0.5 * (x - z) / curvature).clamp(-1.0, 1.0),
        false => 0.0,
    }
}
