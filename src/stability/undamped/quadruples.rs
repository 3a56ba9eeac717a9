//! Intervals of speed over which two modes of an undamped blade have coalesced, from the pieces of a search.

use faer::c64;

use crate::modes::nearest_pairs;
use crate::stability::band::CurvePoint;
use crate::stability::pieces::{Grouped, Piece};
use crate::stability::sample::{Plane, Sample};

/// Begin or end of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// Coalescence of two modes.
    Coalescence {
        /// Speed at which the interpolated modes coalesce.
        expected_rad_per_s: f64,
        /// Nearest speed of the search outside the interval.
        outside_rad_per_s: f64,
    },
    /// End of the search inside the interval.
    Range(f64),
    /// Speed at which the quadruple crosses the highest frequency.
    Height(f64),
}

/// Interval over which a quadruple ±σ ± iω exists; its square (σ + iω)² is the one with σω > 0.
#[derive(Debug, Clone)]
pub struct Stretch<'a> {
    pub begin: Bound,
    pub end: Bound,
    /// The square at the speeds of the search within the interval.
    pub points: Vec<CurvePoint>,
    parts: Vec<Part<'a>>,
}

/// Part of an interval within a piece.
#[derive(Debug, Clone)]
struct Part<'a> {
    from_rad_per_s: f64,
    to_rad_per_s: f64,
    grouped: &'a Grouped,
    /// Number of squares of the group with a larger imaginary part.
    rank: usize,
}

/// Number of steps in which a part of an interval is searched for its largest growth.
const STEPS: usize = 16;

impl Stretch<'_> {
    /// Interpolated square (σ + iω)² at a speed, in 1/s²; `None` outside the interval.
    pub fn square(&self, speed_rad_per_s: f64) -> Option<c64> {
        let covers =
            |part: &&Part<'_>| (part.from_rad_per_s..=part.to_rad_per_s).contains(&speed_rad_per_s);
        let part = self.parts.iter().find(covers)?;
        let mut values = part.grouped.group.at(speed_rad_per_s);
        values.sort_by(|x, y| y.im.total_cmp(&x.im));
        let square = values.get(part.rank)?;
        Some(c64::new(square.re, square.im.max(0.0)))
    }

    /// Speed of the largest interpolated growth.
    pub fn fastest_rad_per_s(&self) -> f64 {
        let growth = |speed: f64| {
            let square = self.square(speed);
            square.map_or(0.0, |square| Plane::Squares.growth_per_s(square))
        };
        let speeds = self.parts.iter().flat_map(|part| {
            let (from, to) = (part.from_rad_per_s, part.to_rad_per_s);
            let at = |k: usize| from + (to - from) * k as f64 / STEPS as f64;
            (0..=STEPS).map(at).collect::<Vec<f64>>()
        });
        let fastest = speeds.max_by(|x, y| growth(*x).total_cmp(&growth(*y)));
        fastest.unwrap_or(0.0)
    }
}

/// An unfinished interval and the index of its square in the last sample.
type Open<'a> = (Stretch<'a>, usize);

/// Intervals of quadruples in the pieces of a search, in the order of their ends.
pub fn stretches(pieces: &[Piece]) -> Vec<Stretch<'_>> {
    let mut ended: Vec<Stretch<'_>> = Vec::new();
    let mut open: Vec<Open<'_>> = Vec::new();
    if let Some(first) = pieces.first() {
        let [sample, _] = &first.ends;
        let of = |place: usize| {
            let begin = Bound::Range(sample.speed_rad_per_s);
            (begun(begin, sample, place), place)
        };
        open = quadruples_of(sample).map(of).collect();
    }
    for piece in pieces {
        let mut next: Vec<Open<'_>> = Vec::new();
        if piece.groups.is_empty() {
            (next, ended) = across_unsettled(piece, open, ended);
        } else {
            for grouped in &piece.groups {
                across(piece, grouped, &mut open, &mut next, &mut ended);
            }
            ended.extend(open.into_iter().map(|(stretch, _)| Stretch {
                end: Bound::Height(piece.ends[0].speed_rad_per_s),
                ..stretch
            }));
        }
        open = next;
    }
    let last = pieces
        .last()
        .map_or(0.0, |piece| piece.ends[1].speed_rad_per_s);
    ended.extend(open.into_iter().map(|(stretch, _)| Stretch {
        end: Bound::Range(last),
        ..stretch
    }));
    ended
}

/// Indices of the squares with Im z > 0.
fn quadruples_of(sample: &Sample) -> impl Iterator<Item = usize> {
    let all = sample.eigenvalues.iter().enumerate();
    all.filter(|(_, (z, _))| z.im > 0.0).map(|(place, _)| place)
}

fn point(sample: &Sample, place: usize) -> CurvePoint {
    CurvePoint::new(sample.speed_rad_per_s, sample.eigenvalues[place])
}

fn coalescence(expected_rad_per_s: f64, outside_rad_per_s: f64) -> Bound {
    Bound::Coalescence {
        expected_rad_per_s,
        outside_rad_per_s,
    }
}

fn begun<'a>(begin: Bound, sample: &Sample, place: usize) -> Stretch<'a> {
    Stretch {
        begin,
        end: begin,
        points: vec![point(sample, place)],
        parts: Vec::new(),
    }
}

/// Continues, begins and ends intervals by the quadruples of a group over a piece.
fn across<'a>(
    piece: &'a Piece,
    grouped: &'a Grouped,
    open: &mut Vec<Open<'a>>,
    next: &mut Vec<Open<'a>>,
    ended: &mut Vec<Stretch<'a>>,
) {
    let [a, b] = piece.ends.each_ref().map(|end| end.speed_rad_per_s);
    let at_end = |end: usize| {
        let values = &piece.ends[end].eigenvalues;
        let mut places = grouped.places[end].clone();
        places.retain(|&place| values[place].0.im > 0.0);
        places.sort_by(|&x, &y| values[y].0.im.total_cmp(&values[x].0.im));
        places.into_iter()
    };
    let (mut firsts, mut lasts) = (at_end(0), at_end(1));
    for (rank, [first_share, last_share]) in group_stretches(grouped) {
        let speed = |share: f64| if share < 1.0 { a + share * (b - a) } else { b };
        let (from_rad_per_s, to_rad_per_s) = (speed(first_share), speed(last_share));
        let first = (first_share == 0.0).then(|| firsts.next()).flatten();
        let mut stretch = match first {
            Some(place) => {
                taken(open, place).unwrap_or_else(|| begun(Bound::Height(a), &piece.ends[0], place))
            }
            None => Stretch {
                begin: coalescence(from_rad_per_s, a),
                end: coalescence(to_rad_per_s, b),
                points: Vec::new(),
                parts: Vec::new(),
            },
        };
        stretch.parts.push(Part {
            from_rad_per_s,
            to_rad_per_s,
            grouped,
            rank,
        });
        let last = (last_share == 1.0).then(|| lasts.next()).flatten();
        if let Some(place) = last {
            stretch.points.push(point(&piece.ends[1], place));
            next.push((stretch, place));
        } else {
            stretch.end = coalescence(to_rad_per_s, b);
            ended.push(stretch);
        }
    }
    // Next to a coalescence the modes of a sample may be coalesced while those of the interpolated group are
    // not, so that a stretch may end or begin at an end of the piece.
    ended.extend(firsts.filter_map(|place| {
        let end = coalescence(a, b);
        taken(open, place).map(|stretch| Stretch { end, ..stretch })
    }));
    next.extend(lasts.map(|place| (begun(coalescence(b, a), &piece.ends[1], place), place)));
}

/// Intervals of a group, each with the rank of its square.
fn group_stretches(grouped: &Grouped) -> impl Iterator<Item = (usize, [f64; 2])> {
    let by_rank = grouped.group.complex_stretches().into_iter().enumerate();
    by_rank.flat_map(|(rank, all)| all.into_iter().map(move |stretch| (rank, stretch)))
}

/// Takes the open interval whose square has a given index in the last sample.
fn taken<'a>(open: &mut Vec<Open<'a>>, place: usize) -> Option<Stretch<'a>> {
    let known = open.iter().position(|(_, at)| *at == place)?;
    Some(open.swap_remove(known).0)
}

/// Continues quadruples over an unsettled piece by those at the other end, nearest pairs first; quadruples without a
/// partner end or begin in the middle.
fn across_unsettled<'a>(
    piece: &'a Piece,
    open: Vec<Open<'a>>,
    mut ended: Vec<Stretch<'a>>,
) -> (Vec<Open<'a>>, Vec<Stretch<'a>>) {
    let [from, to] = &piece.ends;
    let [a, b] = piece.ends.each_ref().map(|end| end.speed_rad_per_s);
    let middle = 0.5 * (a + b);
    let found: Vec<usize> = quadruples_of(to).collect();
    let partners = nearest_pairs([open.len(), found.len()], |i, k| {
        let (last, next) = (from.eigenvalues[open[i].1].0, to.eigenvalues[found[k]].0);
        Some((next - last).norm())
    });
    let mut next = Vec::new();
    for ((mut stretch, _), partner) in open.into_iter().zip(&partners) {
        if let Some(k) = partner {
            let place = found[*k];
            stretch.points.push(point(to, place));
            next.push((stretch, place));
        } else {
            stretch.end = coalescence(middle, b);
            ended.push(stretch);
        }
    }
    let is_new = |k: &usize| !partners.contains(&Some(*k));
    let new = (0..found.len()).filter(is_new).map(|k| found[k]);
    next.extend(new.map(|place| (begun(coalescence(middle, a), to, place), place)));
    (next, ended)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    /// Three quadruples at one end of a piece and two at the other: the first one ends, and does not take the place of another.
    #[test]
    fn a_quadruple_that_ends_in_an_unsettled_piece_leaves_the_others_their_places() {
        let lambdas = [(0.01, 49.0), (3.25, 70.0), (37.0, 208.0)];
        let sample = |speed: f64, lambdas: &[(f64, f64)]| {
            let squares = lambdas.iter().flat_map(|(re, im)| {
                let square = c64::new(*re, *im) * c64::new(*re, *im);
                [square, square.conj()].map(|z| ((z, c64::ZERO), 0))
            });
            Arc::new(Sample::of_squares(speed, squares.collect()))
        };
        let piece = Piece {
            ends: [sample(1.0, &lambdas), sample(1.1, &lambdas[1..])],
            groups: Vec::new(),
        };
        let found = stretches(std::slice::from_ref(&piece));
        assert_eq!(found.len(), 3);
        for stretch in found {
            let frequencies: Vec<f64> = stretch.points.iter().map(|p| p.number.sqrt().im).collect();
            if let Bound::Coalescence { .. } = stretch.end {
                assert!((frequencies[0] - 49.0).abs() < 1e-9 && frequencies.len() == 1);
            } else {
                assert_eq!(frequencies.len(), 2);
                assert!((frequencies[0] - frequencies[1]).abs() < 1e-9);
            }
        }
    }
}
