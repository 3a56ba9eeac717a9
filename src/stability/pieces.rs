//! Pieces of the range of speeds, on each of which every low eigenvalue follows from its two ends.
//!
//! A piece is kept where it says beforehand which eigenvalues one more eigenproblem finds, asked where two of them come
//! nearest; where it does not, the speed that was asked parts it. So what happens within less than any grid, a growth between
//! two decays or a coalescence, is found where the discriminant of a group has its minimum.

use std::sync::Arc;

use faer::c64;
use rayon::prelude::*;

use super::group::{Group, Sloped};
use crate::spectrum::SpectrumError;

/// The low eigenvalues of a damped saw at a speed, with their conjugates.
#[derive(Debug, Clone)]
pub struct Sample {
    pub speed_rad_per_s: f64,
    /// By frequency; conjugates lie symmetrically about the middle.
    pub eigenvalues: Vec<Sloped>,
}

impl Sample {
    /// From eigenvalues of Im λ ≥ 0.
    pub fn new(speed_rad_per_s: f64, upper: impl Iterator<Item = Sloped>) -> Self {
        let mut eigenvalues: Vec<Sloped> = upper
            .flat_map(|(z, slope)| {
                let conjugate = (z.im > 0.0).then(|| (z.conj(), slope.conj()));
                [Some((z, slope)), conjugate].into_iter().flatten()
            })
            .collect();
        let order = |x: &Sloped, y: &Sloped| {
            let side = |z: c64| if z.im < 0.0 { -z.re } else { z.re };
            let by_frequency = x.0.im.total_cmp(&y.0.im);
            by_frequency.then(side(x.0).total_cmp(&side(y.0)))
        };
        eigenvalues.sort_by(order);
        Sample {
            speed_rad_per_s,
            eigenvalues,
        }
    }

    fn middle(&self) -> usize {
        self.eigenvalues.len() / 2
    }
}

/// Places of the eigenvalues of a group in the samples at both ends.
pub type Places = [Vec<usize>; 2];

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
/// Frequencies or growths nearer than this share of the highest frequency are not told apart.
const LEAST_STEP: f64 = 1e-9;
/// Two eigenvalues may meet where their difference, continued by its slope, falls below this share of itself.
const MEETING: f64 = 0.3;

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
        let parts = self.parts(ends);
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

    /// Groups from the real axis up: between them neighbours stay apart, by values and slopes from both ends. `None`
    /// where nothing closes above the highest frequency.
    fn parts(&self, ends: [&Arc<Sample>; 2]) -> Option<Vec<Places>> {
        let [a, b] = ends.map(|end| end.speed_rad_per_s);
        let middles = ends.map(|end| end.middle());
        let count = middles
            .iter()
            .zip(ends)
            .map(|(middle, end)| end.eigenvalues.len() - middle)
            .min()?;
        let by_frequency = ends.map(|end| (0..end.eigenvalues.len()).collect::<Vec<_>>());
        let sides = [0, 1].map(|end| Side {
            z: &ends[end].eigenvalues,
            width: [b - a, a - b][end],
            least: LEAST_STEP * self.top_rad_per_s,
        });
        let is_cut = [0, 1].map(|end| sides[end].cuts(&by_frequency[end], |z| z.im));
        let mut cuts: Vec<usize> = Vec::new();
        let mut is_closed = false;
        for j in (0..count).filter(|&j| is_cut[0][middles[0] + j] && is_cut[1][middles[1] + j]) {
            cuts.push(j);
            let above =
                |end: usize| ends[end].eigenvalues[middles[end] + j].0.im > self.top_rad_per_s;
            if above(0) && above(1) {
                is_closed = true;
                break;
            }
        }
        let lowest = cuts.first().copied().filter(|_| is_closed)?;
        let mut parts = self.about_the_axis(&sides, middles.map(|m| (m - lowest, m + lowest)));
        parts.extend(
            cuts.windows(2)
                .map(|pair| middles.map(|middle| (middle + pair[0]..middle + pair[1]).collect())),
        );
        Some(parts)
    }

    /// The same of what is next to the real axis, by growth. What decays faster than the highest frequency is left out.
    fn about_the_axis(&self, sides: &[Side<'_>; 2], ranges: [(usize, usize); 2]) -> Vec<Places> {
        let by_growth = [0, 1].map(|end| {
            let mut places: Vec<usize> = (ranges[end].0..ranges[end].1).collect();
            let growth = |place: usize| sides[end].z[place].0.re;
            places.sort_by(|&x, &y| growth(x).total_cmp(&growth(y)));
            places
        });
        let count = by_growth[0].len();
        let is_cut = [0, 1].map(|end| sides[end].cuts(&by_growth[end], |z| z.re));
        let mut bounds = vec![0];
        bounds.extend((1..count).filter(|&j| is_cut[0][j] && is_cut[1][j]));
        bounds.push(count);
        let parts = bounds.windows(2).map(|pair| {
            by_growth
                .each_ref()
                .map(|places| places[pair[0]..pair[1]].to_vec())
        });
        let is_seen = |places: &Places| {
            let decays = |end: usize| {
                let mut all = places[end].iter();
                all.all(|&place| sides[end].z[place].0.re < -self.top_rad_per_s)
            };
            !places[0].is_empty() && !(decays(0) && decays(1))
        };
        parts.filter(is_seen).collect()
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

/// The eigenvalues at one end of a piece, and how far the other end is, negative from the upper one.
struct Side<'a> {
    z: &'a [Sloped],
    width: f64,
    /// Neighbours nearer than this are not told apart.
    least: f64,
}

impl Side<'_> {
    /// Before which places of an order the eigenvalues from there on stay above those below over half of the piece, by a
    /// part of them and its slope, where none meets one from the other side.
    fn cuts(&self, order: &[usize], part: fn(c64) -> f64) -> Vec<bool> {
        let count = order.len();
        let mut is_cut: Vec<bool> = (0..count).map(|place| place > 0).collect();
        for share in [0.0, 0.25, 0.5] {
            let at = |k: &usize| part(self.z[*k].0) + share * self.width * part(self.z[*k].1);
            let values: Vec<f64> = order.iter().map(at).collect();
            let mut lowest_above = vec![f64::INFINITY; count];
            let mut lowest = f64::INFINITY;
            for place in (0..count).rev() {
                lowest = lowest.min(values[place]);
                lowest_above[place] = lowest;
            }
            let least = if share == 0.0 { self.least } else { 0.0 };
            let mut highest = f64::NEG_INFINITY;
            for place in 0..count {
                is_cut[place] &= lowest_above[place] - highest > least;
                highest = highest.max(values[place]);
            }
        }
        for first in 0..count {
            // No cut lies between two that meet; from the last that meets the first one on.
            let last = (first + 1..count)
                .rev()
                .find(|&k| self.meet(order[first], order[k]));
            for place in first + 1..=last.unwrap_or(first) {
                is_cut[place] = false;
            }
        }
        is_cut
    }

    /// Whether the difference of two eigenvalues, continued by its slope over half of the piece, comes near zero in the
    /// complex plane: two waves beside their coalescence may differ in growth alone.
    fn meet(&self, i: usize, k: usize) -> bool {
        let (difference, slope) = (self.z[i].0 - self.z[k].0, self.z[i].1 - self.z[k].1);
        let rate = slope.norm_sqr().max(f64::MIN_POSITIVE);
        let share = (-(difference * slope.conj()).re / rate / self.width).clamp(0.0, 0.5);
        (difference + slope * (share * self.width)).norm() < MEETING * difference.norm()
    }
}
