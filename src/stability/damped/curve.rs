//! Curves of the eigenvalues of a damped blade over speed, from the pieces of a search.
//!
//! Eigenvalues are simple except at single speeds, at which a complex pair turns into two real ones or back, and
//! at which curves end and begin. Between such speeds each eigenvalue is a smooth function λ(Ω) with Im λ ≥ 0.
//! Values and slopes identify it from one speed to the next if the step is short enough.

use faer::c64;

use super::spectrum::finite;
use crate::modes::{nearest_pairs, smallest};
use crate::stability::band::CurvePoint;
use crate::stability::group::Sloped;
use crate::stability::partition::decay_together;
use crate::stability::pieces::{Grouped, Piece};
use crate::stability::verdict::growth_between;

/// One eigenvalue over speed.
pub type Curve = Vec<CurvePoint>;

/// The error of the best match must be below this share of the error of the second best.
const STRICT: f64 = 0.25;
/// Smallest number of steps over a piece for a group of several eigenvalues.
const STEPS: usize = 8;
/// Steps below this share of a piece are not divided further.
const LEAST_STEP: f64 = 1e-10;
/// Allowed error of the growth between the points of a curve, as a share of the growth; points need no
/// eigenproblem.
const CURVE_TOLERANCE: f64 = 1e-3;
/// Frequencies below this share of the highest belong to real eigenvalues: a double real eigenvalue is
/// accurate only to the square root of rounding.
const REAL: f64 = 1e-10;
/// Difference of two eigenvalues, as a share of their size, that is rounding: that of double ones is its square root.
const DOUBLE: f64 = 3e-8;

/// An eigenvalue at the last speed up to which it was followed, with its curve.
type Tip = (Sloped, Curve);

/// Curves over speed of the eigenvalues with Im λ ≥ 0 in the pieces of a search. A growth of `noise_per_s` is
/// rounding.
pub fn curves(pieces: &[Piece], top_rad_per_s: f64, noise_per_s: f64) -> Vec<Curve> {
    let upper = |all: &[Sloped]| upper(all, top_rad_per_s);
    let (mut ended, mut open): (Vec<Curve>, Vec<Tip>) = (Vec::new(), Vec::new());
    for piece in pieces {
        let [from, to] = piece.ends.each_ref().map(|end| end.speed_rad_per_s);
        let ends = piece.ends.each_ref().map(|end| upper(&end.eigenvalues));
        let mut tips = begun(&mut open, ends[0].clone(), from);
        ended.extend(open.drain(..).map(|(_, curve)| curve));
        if piece.groups.is_empty() {
            let (kept, lost) = linked(tips, ends[1].clone(), to);
            (open, tips) = (kept, lost);
        }
        for Grouped { group, places, .. } in &piece.groups {
            let at_end = |end: usize| {
                let all = &piece.ends[end].eigenvalues;
                let own: Vec<Sloped> = places[end].iter().map(|&place| all[place]).collect();
                upper(&own)
            };
            let own = at_end(0);
            let (mine, others) = tips.into_iter().partition(|(tip, _)| own.contains(tip));
            tips = others;
            let at = |speed: f64| upper(&group.sloped_at(speed));
            let follower = Follower {
                at: &at,
                // Steps of the size of rounding errors of the speed cannot be halved.
                least_rad_per_s: (LEAST_STEP * (to - from)).max(8.0 * f64::EPSILON * to),
                noise_per_s,
                ended: Vec::new(),
            };
            let (kept, lost) = follower.across(mine, [from, to], group.size(), at_end(1));
            open.extend(kept);
            ended.extend(lost);
        }
        ended.extend(tips.into_iter().map(|(_, curve)| curve));
    }
    ended.extend(open.into_iter().map(|(_, curve)| curve));
    ended
}

/// Eigenvalues with Im λ ≥ 0; frequencies that are rounding, beside the highest one, are set to zero.
pub fn upper(all: &[Sloped], top_rad_per_s: f64) -> Vec<Sloped> {
    let real = REAL * top_rad_per_s;
    let upper = all.iter().filter(|(z, _)| z.im > -real);
    let cleared = upper.map(|&(z, slope)| {
        if z.im.abs() <= real {
            (c64::new(z.re, 0.0), c64::new(slope.re, 0.0))
        } else {
            (z, slope)
        }
    });
    cleared.collect()
}

/// Curves that end at eigenvalues of a speed, taken from the open ones; eigenvalues without one begin new
/// curves.
fn begun(open: &mut Vec<Tip>, values: Vec<Sloped>, speed_rad_per_s: f64) -> Vec<Tip> {
    let tips =
        values.into_iter().map(
            |value| match open.iter().position(|(tip, _)| *tip == value) {
                Some(place) => open.swap_remove(place),
                None => (value, vec![point(speed_rad_per_s, value)]),
            },
        );
    tips.collect()
}

fn point(speed_rad_per_s: f64, (number, slope): Sloped) -> CurvePoint {
    CurvePoint::new(speed_rad_per_s, (number, finite(slope)))
}

fn extended((_, mut curve): Tip, value: Sloped, speed_rad_per_s: f64) -> Tip {
    curve.push(point(speed_rad_per_s, value));
    (value, curve)
}

/// A curve that ends within a step, up to the end of the step, at which other curves begin: its eigenvalue is there equal to one
/// of theirs, up to rounding.
fn closed((last, curve): Tip, found: &[Sloped], speed_rad_per_s: f64) -> Tip {
    let nearest = smallest(found, |(z, _)| (z - last.0).norm());
    match nearest {
        Some((z, slope)) => {
            let value = (c64::new(z.re, last.0.im), *slope);
            extended((last, curve), value, speed_rad_per_s)
        }
        None => (last, curve),
    }
}

/// Continues curves by the eigenvalues of one group over a piece.
struct Follower<'a> {
    /// Eigenvalues with Im λ ≥ 0 at a speed.
    at: &'a dyn Fn(f64) -> Vec<Sloped>,
    /// Smallest step.
    least_rad_per_s: f64,
    /// Growth that is rounding.
    noise_per_s: f64,
    ended: Vec<Curve>,
}

impl Follower<'_> {
    /// Continues curves over the piece, which ends at the eigenvalues `last`, and returns those that have
    /// ended.
    fn across(
        mut self,
        mut tips: Vec<Tip>,
        [from, to]: [f64; 2],
        size: usize,
        last: Vec<Sloped>,
    ) -> (Vec<Tip>, Vec<Curve>) {
        let steps = if size == 1 { 1 } else { STEPS };
        let speed = |k: usize| from + (to - from) * k as f64 / steps as f64;
        for k in 1..steps {
            tips = self.step(tips, [speed(k - 1), speed(k)], (self.at)(speed(k)));
        }
        tips = self.step(tips, [speed(steps - 1), to], last);
        (tips, self.ended)
    }

    /// Continues curves over a step, in halves if that is uncertain, to the eigenvalues `found`.
    fn step(&mut self, tips: Vec<Tip>, [a, b]: [f64; 2], found: Vec<Sloped>) -> Vec<Tip> {
        let matched = matched(&tips, &found, b - a);
        let is_settled = matched.is_none() && are_alike(&tips, &found);
        if is_settled || b - a <= self.least_rad_per_s {
            let at_end = found.clone();
            let (kept, lost) = linked(tips, found, b);
            let ended = lost.into_iter().map(|tip| closed(tip, &at_end, b));
            self.ended.extend(ended.map(|(_, curve)| curve));
            return kept;
        }
        match matched {
            Some(places) if self.is_drawn(&tips, &found, &places, [a, b]) => {
                let tips = tips.into_iter().zip(places);
                tips.map(|(tip, place)| extended(tip, found[place], b))
                    .collect()
            }
            _ => {
                let middle = 0.5 * (a + b);
                let tips = self.step(tips, [a, middle], (self.at)(middle));
                self.step(tips, [middle, b], found)
            }
        }
    }

    /// Whether the growth within a step agrees with the interpolation from its ends.
    fn is_drawn(&self, tips: &[Tip], found: &[Sloped], places: &[usize], [a, b]: [f64; 2]) -> bool {
        let pairs = tips
            .iter()
            .zip(places)
            .map(|((first, _), &place)| [point(a, *first), point(b, found[place])]);
        let growing: Vec<[CurvePoint; 2]> = pairs
            .filter(|[first, last]| first.number.re.max(last.number.re) > 0.0)
            .collect();
        growing.is_empty()
            || [0.5, 0.25, 0.75].into_iter().all(|share| {
                let between = (self.at)(a + share * (b - a));
                growing.iter().all(|pair| {
                    let expected = growth_between(pair, share);
                    let off = between.iter().map(|(z, _)| (z.re - expected).abs());
                    let size = expected.max(pair[0].number.re).max(pair[1].number.re);
                    let allowed = CURVE_TOLERANCE * size + self.noise_per_s;
                    off.fold(f64::INFINITY, f64::min) <= allowed
                })
            })
    }
}

/// Index of the eigenvalue that continues each curve. λ must change by the mean of both slopes, and the
/// slopes must be similar, which distinguishes two paths that cross in the middle of the step. `None` if the
/// match is uncertain.
fn matched(tips: &[Tip], found: &[Sloped], width: f64) -> Option<Vec<usize>> {
    if tips.len() != found.len() {
        return None;
    }
    let misfit = |x: &Sloped, y: &Sloped| {
        let change = y.0 - x.0 - (x.1 + y.1) * (0.5 * width);
        let is_alike = (x.0.im == 0.0) == (y.0.im == 0.0);
        if is_alike {
            change.norm() + 0.25 * width * (x.1 - y.1).norm()
        } else {
            f64::INFINITY
        }
    };
    let mut taken = vec![false; found.len()];
    let mut places = Vec::new();
    for (tip, _) in tips {
        let all: Vec<f64> = found.iter().map(|value| misfit(tip, value)).collect();
        let best = smallest(0..all.len(), |&place| all[place])?;
        let others = (0..all.len()).filter(|&k| k != best).map(|k| all[k]);
        let next = others.fold(f64::INFINITY, f64::min);
        let is_certain = all[best].is_finite() && (all[best] <= STRICT * next);
        if !is_certain || std::mem::replace(&mut taken[best], true) {
            return None;
        }
        places.push(best);
    }
    Some(places)
}

/// Whether the eigenvalues at both ends of a step that cannot be told from each other need not be: they decay together, are real and
/// equal within the allowed error of a curve, as those of guides that lie evenly around the blade, or are equal within rounding, by which
/// two real ones and a complex pair are not distinct. Smaller steps could not tell them from each other either.
fn are_alike(tips: &[Tip], found: &[Sloped]) -> bool {
    let sides = [tips.iter().map(|(tip, _)| *tip).collect(), found.to_vec()];
    let uncertain = |side: usize| -> Vec<Sloped> {
        let all: &[Sloped] = &sides[side];
        let is_uncertain = |k: &usize| {
            let distance = |(z, _): &Sloped| (z - all[*k].0).norm();
            let beside = (0..all.len())
                .filter(|other| other != k)
                .map(|k| distance(&all[k]));
            let across = sides[1 - side].iter().map(distance);
            let [beside, across] = [
                beside.fold(f64::INFINITY, f64::min),
                across.fold(f64::INFINITY, f64::min),
            ];
            across > STRICT * beside
        };
        (0..all.len())
            .filter(is_uncertain)
            .map(|k| all[k])
            .collect()
    };
    let [before, after] = [0, 1].map(uncertain);
    let both = [before.as_slice(), after.as_slice()].concat();
    let largest =
        |part: &dyn Fn(c64) -> f64| both.iter().map(|(z, _)| part(*z)).fold(0.0, f64::max);
    let Some((first, _)) = both.first() else {
        return false;
    };
    let apart = largest(&|z| (z - first).norm());
    let is_real = before.len() == after.len() && largest(&|z| z.im) == 0.0;
    let allowed = if is_real {
        CURVE_TOLERANCE * largest(&|z| z.re)
    } else {
        DOUBLE * largest(&|z| z.norm())
    };
    apart <= allowed || decay_together(&both, 0.0)
}

/// Continues curves by the nearest eigenvalues, real ones by real ones; other eigenvalues begin new curves.
/// Returns these curves, and those without a continuation.
fn linked(tips: Vec<Tip>, found: Vec<Sloped>, speed_rad_per_s: f64) -> (Vec<Tip>, Vec<Tip>) {
    let partners = nearest_pairs([tips.len(), found.len()], |i, k| {
        let ((z, _), _) = tips[i];
        let (other, _) = found[k];
        ((z.im == 0.0) == (other.im == 0.0)).then(|| (z - other).norm())
    });
    let (mut kept, mut lost) = (Vec::new(), Vec::new());
    for (tip, place) in tips.into_iter().zip(&partners) {
        match place {
            Some(k) => kept.push(extended(tip, found[*k], speed_rad_per_s)),
            None => lost.push(tip),
        }
    }
    let is_new = |k: &usize| !partners.contains(&Some(*k));
    let new = (0..found.len()).filter(is_new).map(|k| found[k]);
    kept.extend(new.map(|value| (value, vec![point(speed_rad_per_s, value)])));
    (kept, lost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::pieces::Search;
    use crate::stability::sample::{Plane, Sample};

    /// Curves of eigenvalues given in closed form over 0 to 10 rad/s, and the number of speeds computed.
    fn followed(eigenvalues: &(dyn Fn(f64) -> Vec<Sloped> + Sync)) -> (Vec<Curve>, usize) {
        let solved = std::sync::atomic::AtomicUsize::new(0);
        let solve = |speed: f64| {
            solved.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            // A wave above all others gives the search a gap to end in.
            let above = (c64::new(-1.0, 50.0), c64::new(0.0, 0.0));
            let all = eigenvalues(speed).into_iter().chain([above]);
            Ok(Some(Sample::new(speed, all.filter(|(z, _)| z.im >= 0.0))))
        };
        let search = Search {
            plane: Plane::Eigenvalues,
            top_rad_per_s: 20.0,
            tolerance: 1e-3,
            definite_tolerance: 0.05,
            growth_tolerance: 0.01,
            noise_per_s: 1e-9,
            solve: &solve,
        };
        let speeds: Vec<f64> = (0..9).map(|k| 1.25 * f64::from(k)).collect();
        let curves = curves(&search.pieces(&speeds).unwrap(), 20.0, 1e-9);
        (curves, solved.into_inner())
    }

    /// First and last point of growth of each curve that grows.
    fn growing(curves: &[Curve]) -> Vec<[f64; 2]> {
        let mut found = Vec::new();
        for curve in curves {
            let grows: Vec<f64> = curve
                .iter()
                .filter(|p| p.number.re > 0.0)
                .map(|p| p.speed_rad_per_s)
                .collect();
            if let [first, .., last] = grows.as_slice() {
                found.push([*first, *last]);
            }
        }
        found
    }

    /// 5i − d ± √(w² − (Ω − Ω₀)²): two waves that coalesce within a band 1e-6 as wide as the first step.
    #[test]
    fn a_band_far_narrower_than_the_first_steps_is_found() {
        let (centre, half, decay) = (4.321_987, 1e-6, 1e-8);
        let pair = move |speed: f64| {
            let away = speed - centre;
            let root = c64::new(half * half - away * away, 0.0).sqrt();
            let mean = c64::new(-decay, 5.0);
            vec![(mean + root, -away / root), (mean - root, away / root)]
        };
        let (curves, asked) = followed(&pair);
        let bands = growing(&curves);
        assert_eq!(bands.len(), 1, "{bands:?}");
        let edge = (half * half - decay * decay).sqrt();
        for (found, exact) in bands[0].iter().zip([centre - edge, centre + edge]) {
            assert!((found - exact).abs() < 0.05 * half, "{found} {exact}");
        }
        assert!(asked < 80, "{asked} speeds");
    }

    /// ±√(Ω − 3)(7 − Ω) − 0.01: a wave turns into two real eigenvalues and oscillates again. The growing
    /// curve is real and ends where they coalesce.
    #[test]
    fn a_pair_that_turns_real_begins_and_ends_curves() {
        let pair = |speed: f64| {
            let square = (speed - 3.0) * (7.0 - speed);
            let root = c64::new(square, 0.0).sqrt();
            let slope = (10.0 - 2.0 * speed) / (2.0 * root);
            let decay = c64::new(-0.01, 0.0);
            vec![(decay + root, slope), (decay - root, -slope)]
        };
        let (curves, asked) = followed(&pair);
        let bands = growing(&curves);
        assert_eq!(bands.len(), 1, "{bands:?}");
        let [first, last] = bands[0];
        assert!(
            (first - 3.0).abs() < 1e-3 && (last - 7.0).abs() < 1e-3,
            "{first} {last}"
        );
        let real = |curve: &&Curve| curve.iter().all(|p| p.number.im == 0.0);
        assert_eq!(curves.iter().filter(real).count(), 2);
        assert!(asked < 60, "{asked} speeds");
    }

    /// Three waves cross in frequency and keep their decay rates: they stay separate, and nothing grows.
    #[test]
    fn waves_that_only_cross_keep_their_curves() {
        let waves = |speed: f64| {
            let wave = |decay: f64, from: f64, slope: f64| {
                (c64::new(-decay, from + slope * speed), c64::new(0.0, slope))
            };
            vec![
                wave(0.1, 4.0, 0.5),
                wave(0.2, 9.0, -0.5),
                wave(0.3, 6.0, 0.1),
            ]
        };
        let (curves, _) = followed(&waves);
        let below = curves.iter().filter(|curve| curve[0].number.im < 20.0);
        let whole: Vec<&Curve> = below.collect();
        assert_eq!(whole.len(), 3);
        for curve in whole {
            let first = curve[0].number.re;
            assert!(curve.iter().all(|p| (p.number.re - first).abs() < 1e-6));
        }
        assert!(growing(&curves).is_empty());
    }
}
