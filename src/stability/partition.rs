//! Partition of the eigenvalues at two speeds into groups that may coalesce between them.

use faer::c64;

use super::group::Sloped;
use super::sample::{Plane, Sample};

/// Two numbers are not distinguished if they differ by less than this share of the highest frequency (or its
/// square).
const LEAST_STEP: f64 = 1e-9;
/// Two eigenvalues may coalesce if their difference, continued by its slope, falls below this share of its size.
const COALESCING: f64 = 0.3;

/// Numbers decay together if they differ over a piece by less than this share of their decay.
const TOGETHER: f64 = 0.25;

/// Indices of the eigenvalues of a group in the samples at both ends.
pub type Places = [Vec<usize>; 2];

/// Groups of all numbers up to a frequency. By values and slopes at both ends, numbers of different groups do
/// not coalesce. `None` if there is no gap above the frequency.
pub fn partition(plane: Plane, ends: [&Sample; 2], top_rad_per_s: f64) -> Option<Vec<Places>> {
    let [a, b] = ends.map(|end| end.speed_rad_per_s);
    let sides = [0, 1].map(|end| Side {
        z: &ends[end].eigenvalues,
        width: [b - a, a - b][end],
        least: LEAST_STEP * plane.sized(top_rad_per_s),
    });
    match plane {
        Plane::Eigenvalues => by_frequency(&sides, ends.map(Sample::middle), top_rad_per_s),
        Plane::Squares => by_square(&sides, plane.sized(top_rad_per_s)),
    }
}

/// Groups of squares, from the fastest divergence to the first gap above the highest frequency.
fn by_square(sides: &[Side<'_>; 2], top: f64) -> Option<Vec<Places>> {
    let all = [0, 1].map(|end| (0..sides[end].z.len()).collect::<Vec<_>>());
    let is_cut = [0, 1].map(|end| sides[end].cuts(&all[end], |z| -z.re));
    let count = all[0].len().min(all[1].len());
    let mut bounds = vec![0];
    for j in (1..count).filter(|&j| is_cut[0][j] && is_cut[1][j]) {
        bounds.push(j);
        if sides.iter().all(|side| -side.z[j].0.re > top) {
            let pairs = bounds.windows(2);
            return Some(
                pairs
                    .map(|pair| [0, 1].map(|_| (pair[0]..pair[1]).collect()))
                    .collect(),
            );
        }
    }
    None
}

/// Groups of eigenvalues, from the real axis upwards.
fn by_frequency(
    sides: &[Side<'_>; 2],
    middles: [usize; 2],
    top_rad_per_s: f64,
) -> Option<Vec<Places>> {
    let count = (0..2).map(|end| sides[end].z.len() - middles[end]).min()?;
    let all = [0, 1].map(|end| (0..sides[end].z.len()).collect::<Vec<_>>());
    let is_cut = [0, 1].map(|end| sides[end].cuts(&all[end], |z| z.im));
    let mut cuts: Vec<usize> = Vec::new();
    let mut is_closed = false;
    for j in (0..count).filter(|&j| is_cut[0][middles[0] + j] && is_cut[1][middles[1] + j]) {
        cuts.push(j);
        let above = |end: usize| sides[end].z[middles[end] + j].0.im > top_rad_per_s;
        if above(0) && above(1) {
            is_closed = true;
            break;
        }
    }
    let lowest = cuts.first().copied().filter(|_| is_closed)?;
    let mut parts = about_the_axis(
        sides,
        middles.map(|m| (m - lowest, m + lowest)),
        top_rad_per_s,
    );
    parts.extend(
        cuts.windows(2)
            .map(|pair| middles.map(|middle| (middle + pair[0]..middle + pair[1]).collect())),
    );
    Some(parts)
}

/// Groups of the eigenvalues near the real axis, by growth, without groups whose decay rates all exceed the
/// highest frequency, and without those whose numbers decay together.
fn about_the_axis(
    sides: &[Side<'_>; 2],
    ranges: [(usize, usize); 2],
    top_rad_per_s: f64,
) -> Vec<Places> {
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
        let mut all = [0, 1].into_iter().flat_map(|end| {
            let places = places[end].iter();
            places.map(move |&place| sides[end].z[place].0.re)
        });
        all.any(|growth| growth >= -top_rad_per_s)
    };
    parts
        .filter(|places| {
            let of_end = |end: usize| places[end].iter().map(move |&place| sides[end].z[place]);
            let all: Vec<Sloped> = of_end(0).chain(of_end(1)).collect();
            is_seen(places) && !(places[0].len() > 1 && decay_together(&all, sides[0].width))
        })
        .collect()
}

/// Whether numbers at two speeds, that far apart, are so near to each other and decay so fast that none can grow between: films of equal
/// lag on many pads have many real numbers that are nearly equal, and none can be told from the next.
pub fn decay_together(numbers: &[Sloped], width: f64) -> bool {
    let largest = |part: &dyn Fn(&Sloped) -> f64| numbers.iter().map(part).fold(f64::MIN, f64::max);
    let growth = largest(&|(z, _)| z.re);
    let apart = largest(&|(z, _)| (z - numbers[0].0).norm());
    let moved = width * largest(&|(_, slope)| slope.norm());
    apart + moved < TOGETHER * -growth
}

/// Eigenvalues at one end of a piece, and the distance to the other end, negative from the upper one.
struct Side<'a> {
    z: &'a [Sloped],
    width: f64,
    /// Neighbours closer than this are not distinguished.
    least: f64,
}

impl Side<'_> {
    /// Positions at which an order of the eigenvalues can be cut. Over half of the piece, the real or the
    /// imaginary part and its slope must separate the eigenvalues above the cut from those below, and no two
    /// may coalesce across it.
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
            // No boundary of groups lies between two numbers that may coalesce.
            let last = (first + 1..count)
                .rev()
                .find(|&k| self.may_coalesce(order[first], order[k]));
            is_cut[first + 1..=last.unwrap_or(first)].fill(false);
        }
        is_cut
    }

    /// Whether the difference of two eigenvalues, continued by its slope over half of the piece, comes near
    /// zero in the complex plane. Two waves next to their coalescence may differ only in growth.
    fn may_coalesce(&self, i: usize, k: usize) -> bool {
        let (difference, slope) = (self.z[i].0 - self.z[k].0, self.z[i].1 - self.z[k].1);
        let rate = slope.norm_sqr().max(f64::MIN_POSITIVE);
        let share = (-(difference * slope.conj()).re / rate / self.width).clamp(0.0, 0.5);
        (difference + slope * (share * self.width)).norm() < COALESCING * difference.norm()
    }
}
