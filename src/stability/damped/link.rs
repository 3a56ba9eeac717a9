//! Which eigenvalue of one speed is which of the next.
//!
//! Eigenvalues of a damped blade are simple but for single speeds, at which a complex pair
//! becomes two real ones or back. Between such speeds each is a smooth function λ(Ω), and value
//! and slope at both ends of an interval tell which belongs to which, as long as the interval is
//! short enough; where they do not, it has to be halved.

use faer::c64;

use super::super::interpolation::Cubic;
use super::spectrum::{Eigenvalue, Spectrum};
use crate::tuned::Tuned;

/// A match must fit this much better than the next best one.
pub const STRICT: Tuned = Tuned::new("stability/damped/link::STRICT", 0.25);
/// The same for intervals that are not divided any more.
pub const LAST: f64 = 0.5;

/// An eigenvalue from one speed to the next; the later value is conjugated where the path runs
/// through the real axis.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Index at the lower speed.
    pub before: usize,
    /// Index at the higher speed.
    pub after: usize,
    /// Values and slopes at both ends.
    pub ends: [Eigenvalue; 2],
    width: f64,
}

impl Pair {
    /// Larger of the growth rates at both ends.
    pub fn growth(&self) -> f64 {
        self.ends[0].lambda.re.max(self.ends[1].lambda.re)
    }

    /// λ at a share of the way, by the cubic through values and slopes.
    pub fn at(&self, share: f64) -> c64 {
        between(&self.ends, self.width, share)
    }
}

/// λ at a share of an interval, by the cubic through values and slopes at its ends.
pub fn between(ends: &[Eigenvalue; 2], width: f64, share: f64) -> c64 {
    let [a, b] = ends;
    let cubic = |f0, d0: f64, f1, d1: f64| {
        Cubic {
            values: [f0, f1],
            slopes: [d0 * width, d1 * width],
        }
        .at(share)
    };
    c64::new(
        cubic(a.lambda.re, a.slope.re, b.lambda.re, b.slope.re),
        cubic(a.lambda.im, a.slope.im, b.lambda.im, b.slope.im),
    )
}

/// The matches of an interval.
#[derive(Debug)]
pub struct Link {
    /// Eigenvalues that are matched beyond doubt.
    pub pairs: Vec<Pair>,
    /// Whether one that may grow within the interval is not.
    pub is_ambiguous: bool,
}

impl Link {
    /// Matches the eigenvalues of two speeds; those above `highest` need no match.
    pub fn new(a: &Spectrum, b: &Spectrum, highest: f64, strictness: f64) -> Self {
        let width = b.speed - a.speed;
        let misfits: Vec<Vec<(f64, Eigenvalue)>> = a
            .values
            .iter()
            .map(|x| b.values.iter().map(|y| misfit(x, y, width)).collect())
            .collect();
        let column = |k: usize| best(misfits.iter().map(|row| row[k].0));
        let columns: Vec<_> = (0..b.values.len()).map(column).collect();
        let mut pairs = Vec::new();
        for (i, row) in misfits.iter().enumerate() {
            let Some((k, least, next)) = best(row.iter().map(|(misfit, _)| *misfit)) else {
                continue;
            };
            let fits = |next: f64| least <= strictness * next;
            let is_mutual = columns[k].is_some_and(|(back, _, next)| back == i && fits(next));
            if is_mutual && fits(next) {
                pairs.push(Pair {
                    before: i,
                    after: k,
                    ends: [a.values[i], row[k].1],
                    width,
                });
            }
        }
        let grows = |v: &Eigenvalue| {
            v.lambda.im <= highest && v.lambda.re + 2.0 * width * v.slope.re.abs() > 0.0
        };
        let lost = |values: &[Eigenvalue], known: &dyn Fn(usize) -> bool| {
            let mut values = values.iter().enumerate();
            values.any(|(i, v)| grows(v) && !known(i))
        };
        let is_ambiguous = lost(&a.values, &|i| pairs.iter().any(|p| p.before == i))
            || lost(&b.values, &|k| pairs.iter().any(|p| p.after == k));
        Link {
            pairs,
            is_ambiguous,
        }
    }
}

/// How far two eigenvalues are from lying on one path, and the second as it lies on it: λ must
/// change as the mean of both slopes says, and the slopes must be alike. The second part tells
/// two paths apart that cross in the middle of the interval.
fn misfit(x: &Eigenvalue, y: &Eigenvalue, width: f64) -> (f64, Eigenvalue) {
    if x.component != y.component {
        return (f64::INFINITY, *y);
    }
    let off = |y: &Eigenvalue| {
        let change = y.lambda - x.lambda - (x.slope + y.slope) * (0.5 * width);
        change.norm() + 0.25 * width * (x.slope - y.slope).norm()
    };
    let turned = y.conj();
    match off(y) <= off(&turned) {
        true => (off(y), *y),
        false => (off(&turned), turned),
    }
}

/// Place of the least, the least, and the next.
fn best(misfits: impl Iterator<Item = f64>) -> Option<(usize, f64, f64)> {
    let mut found: Option<(usize, f64, f64)> = None;
    for (place, misfit) in misfits.enumerate().filter(|(_, m)| m.is_finite()) {
        found = Some(match found {
            None => (place, misfit, f64::INFINITY),
            Some((_, least, _)) if misfit < least => (place, misfit, least),
            Some((at, least, next)) => (at, least, next.min(misfit)),
        });
    }
    found
}
