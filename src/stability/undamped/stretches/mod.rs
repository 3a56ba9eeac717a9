//! Intervals of speed over which a number λ² of an undamped blade grows, from the pieces of a search.

use faer::c64;

use crate::modes::nearest_pairs;
use crate::stability::band::CurvePoint;
use crate::stability::critical_sides::is_double;
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::pieces::{Grouped, Piece};
use crate::stability::sample::{Plane, Sample};

/// Begin or end of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// Coalescence of two numbers.
    Coalescence {
        /// Speed at which the interpolated numbers coalesce.
        expected_rad_per_s: f64,
        /// Nearest speed of the search outside the interval.
        outside_rad_per_s: f64,
    },
    /// Critical speed.
    Critical(f64),
    /// Critical speed that the search passes in one step with that at the other end.
    Passed(f64),
    /// End of the search inside the interval.
    Range(f64),
    /// Speed up to which the number could be followed, because it crosses the highest frequency.
    Unfollowed(f64),
}

impl Bound {
    fn speed(&self) -> f64 {
        match self {
            Bound::Coalescence {
                expected_rad_per_s: speed,
                ..
            }
            | Bound::Critical(speed)
            | Bound::Passed(speed)
            | Bound::Range(speed)
            | Bound::Unfollowed(speed) => *speed,
        }
    }
}

/// Interval over which a number grows: for flutter the square (σ + iω)² with σω > 0 of a quadruple ±σ ± iω, for divergence σ² of a real
/// pair ±σ.
#[derive(Debug, Clone)]
pub struct Stretch<'a> {
    pub kind: InstabilityKind,
    pub begin: Bound,
    pub end: Bound,
    /// The number at the speeds of the search within the interval.
    pub points: Vec<CurvePoint>,
    parts: Vec<Part<'a>>,
}

/// Part of an interval within a piece.
#[derive(Debug, Clone)]
struct Part<'a> {
    from_rad_per_s: f64,
    to_rad_per_s: f64,
    grouped: &'a Grouped,
    /// Number of larger numbers of the same kind in the group.
    rank: usize,
}

/// Number of steps in which a part of an interval is searched for its largest growth.
const STEPS: usize = 16;

impl Stretch<'_> {
    /// Interpolated number at a speed, in 1/s²; `None` outside the interval.
    pub fn square(&self, speed_rad_per_s: f64) -> Option<c64> {
        let covers =
            |part: &&Part<'_>| (part.from_rad_per_s..=part.to_rad_per_s).contains(&speed_rad_per_s);
        let part = self.parts.iter().find(covers)?;
        let size = |square: &c64| self.kind.size(*square);
        let mut values = part.grouped.group.at(speed_rad_per_s);
        values.sort_by(|x, y| size(y).total_cmp(&size(x)));
        let square = values.get(part.rank)?;
        Some(c64::new(square.re, square.im.max(0.0)))
    }

    /// Speed of the largest interpolated growth; `None` if the interval is not interpolated.
    pub fn fastest_rad_per_s(&self) -> Option<f64> {
        let growth = |speed: f64| {
            let square = self.square(speed);
            square.map_or(0.0, |square| Plane::Squares.growth_per_s(square))
        };
        let speeds = self.parts.iter().flat_map(|part| {
            let (from, to) = (part.from_rad_per_s, part.to_rad_per_s);
            let at = |k: usize| from + (to - from) * k as f64 / STEPS as f64;
            (0..=STEPS).map(at).collect::<Vec<f64>>()
        });
        speeds.max_by(|x, y| growth(*x).total_cmp(&growth(*y)))
    }

    /// Middle of the interval.
    pub fn middle_rad_per_s(&self) -> f64 {
        0.5 * (self.begin.speed() + self.end.speed())
    }
}

/// Intervals of flutter and of divergence, of one number each. `critical` are the critical speeds, ascending.
pub fn stretches<'a>(pieces: &'a [Piece], critical: &[f64]) -> Vec<Stretch<'a>> {
    let of = |kind| Reader::new(kind, pieces, critical).read();
    let mut all = of(InstabilityKind::Flutter);
    all.extend(of(InstabilityKind::Divergence));
    all
}

/// An unfinished interval and the index of its number in the last sample.
type Open<'a> = (Stretch<'a>, usize);

/// Reader of the growing numbers of one kind.
struct Reader<'a, 'c> {
    kind: InstabilityKind,
    pieces: &'a [Piece],
    critical: &'c [f64],
    ended: Vec<Stretch<'a>>,
}

impl<'a, 'c> Reader<'a, 'c> {
    fn new(kind: InstabilityKind, pieces: &'a [Piece], critical: &'c [f64]) -> Self {
        Reader {
            kind,
            pieces,
            critical,
            ended: Vec::new(),
        }
    }

    /// The intervals in the order of their ends.
    fn read(mut self) -> Vec<Stretch<'a>> {
        let (Some(first), Some(last)) = (self.pieces.first(), self.pieces.last()) else {
            return Vec::new();
        };
        let [sample, _] = &first.ends;
        let begin = Bound::Range(sample.speed_rad_per_s);
        let begun = sample
            .growing(self.kind)
            .map(|place| self.begun(begin, sample, place));
        let mut open: Vec<Open<'a>> = begun.collect();
        for piece in self.pieces {
            open = if self.is_interpolated(piece) {
                self.across(piece, open)
            } else {
                self.across_unsettled(piece, open)
            };
        }
        self.end_all(open, Bound::Range(last.ends[1].speed_rad_per_s));
        self.ended
    }

    /// Whether the groups of a piece show where its growing numbers begin and end. The search has a speed on each side of every critical
    /// speed and none between them.
    fn is_interpolated(&self, piece: &Piece) -> bool {
        let passes_zero = self.kind == InstabilityKind::Divergence
            && self.critical.iter().any(|speed| piece.contains(*speed));
        !piece.groups.is_empty() && !passes_zero
    }

    fn begun(&self, begin: Bound, sample: &Sample, place: usize) -> Open<'a> {
        let stretch = Stretch {
            kind: self.kind,
            begin,
            end: begin,
            points: vec![point(sample, place)],
            parts: Vec::new(),
        };
        (stretch, place)
    }

    fn end_all(&mut self, open: Vec<Open<'a>>, end: Bound) {
        let ended = open
            .into_iter()
            .map(|(stretch, _)| Stretch { end, ..stretch });
        self.ended.extend(ended);
    }

    /// Continues, begins and ends intervals by the groups of a piece.
    fn across(&mut self, piece: &'a Piece, mut open: Vec<Open<'a>>) -> Vec<Open<'a>> {
        let mut next = Vec::new();
        for grouped in &piece.groups {
            self.across_group(piece, grouped, &mut open, &mut next);
        }
        self.end_all(open, Bound::Unfollowed(piece.ends[0].speed_rad_per_s));
        next
    }

    fn across_group(
        &mut self,
        piece: &'a Piece,
        grouped: &'a Grouped,
        open: &mut Vec<Open<'a>>,
        next: &mut Vec<Open<'a>>,
    ) {
        let [from, to] = piece.ends.each_ref();
        let [a, b] = [from, to].map(|end| end.speed_rad_per_s);
        let at_end = |end: usize| {
            let squares = &piece.ends[end].eigenvalues;
            let size = |place: usize| self.kind.size(squares[place].0);
            let mut places = grouped.places[end].clone();
            places.retain(|&place| InstabilityKind::of_square(squares[place].0) == Some(self.kind));
            places.sort_by(|&x, &y| size(y).total_cmp(&size(x)));
            places.into_iter()
        };
        let (mut firsts, mut lasts) = (at_end(0), at_end(1));
        for (rank, [first_share, last_share]) in grouped.group.stretches(self.kind) {
            let speed = |share: f64| if share < 1.0 { a + share * (b - a) } else { b };
            let (from_rad_per_s, to_rad_per_s) = (speed(first_share), speed(last_share));
            let first = (first_share == 0.0).then(|| firsts.next()).flatten();
            let mut stretch = match first {
                Some(place) => taken(open, place)
                    .unwrap_or_else(|| self.begun(Bound::Unfollowed(a), from, place).0),
                None => Stretch {
                    kind: self.kind,
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
                stretch.points.push(point(to, place));
                next.push((stretch, place));
            } else {
                stretch.end = coalescence(to_rad_per_s, b);
                self.ended.push(stretch);
            }
        }
        // Next to a coalescence the modes of a sample may be coalesced while those of the interpolated group are
        // not, so that a stretch may end or begin at an end of the piece.
        let end = coalescence(a, b);
        let left = firsts.filter_map(|place| taken(open, place));
        self.ended
            .extend(left.map(|stretch| Stretch { end, ..stretch }));
        next.extend(lasts.map(|place| self.begun(coalescence(b, a), to, place)));
    }

    /// Continues numbers by those at the other end of a piece, nearest pairs first; numbers without a partner end or begin at a critical
    /// speed of the piece, or else in the middle.
    fn across_unsettled(&mut self, piece: &'a Piece, open: Vec<Open<'a>>) -> Vec<Open<'a>> {
        let [from, to] = piece.ends.each_ref();
        let [a, b] = [from, to].map(|end| end.speed_rad_per_s);
        let found: Vec<usize> = to.growing(self.kind).collect();
        let passed = self.passed(piece);
        if open.is_empty() && found.is_empty() {
            // Without a real λ at either end, an odd number of negative eigenvalues of K(Ω) between two critical speeds implies one there.
            // At a double one both waves pass zero without divergence.
            let pairs = passed
                .chunks_exact(2)
                .filter(|pair| !is_double(pair[0], pair[1]));
            self.ended.extend(pairs.map(|pair| Stretch {
                kind: self.kind,
                begin: Bound::Passed(pair[0]),
                end: Bound::Passed(pair[1]),
                points: Vec::new(),
                parts: Vec::new(),
            }));
        }
        let flutter = [from, to].map(|end| end.growing(InstabilityKind::Flutter).count());
        // Where a quadruple takes the place of a real λ, the other of both has passed zero before.
        let bound = |outside: f64, [inner, outer]: [usize; 2]| match passed.first() {
            Some(speed) if outer <= inner => Bound::Critical(*speed),
            _ => coalescence(0.5 * (a + b), outside),
        };
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
                stretch.end = bound(b, flutter);
                self.ended.push(stretch);
            }
        }
        let is_new = |k: &usize| !partners.contains(&Some(*k));
        let new = (0..found.len()).filter(is_new).map(|k| found[k]);
        next.extend(new.map(|place| self.begun(bound(a, [flutter[1], flutter[0]]), to, place)));
        next
    }

    /// Critical speeds within a piece, at which a real λ may pass zero.
    fn passed(&self, piece: &Piece) -> Vec<f64> {
        if self.kind == InstabilityKind::Flutter {
            return Vec::new();
        }
        let inside = self.critical.iter().copied();
        inside.filter(|speed| piece.contains(*speed)).collect()
    }
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

/// Takes the open interval whose number has a given index in the last sample.
fn taken<'a>(open: &mut Vec<Open<'a>>, place: usize) -> Option<Stretch<'a>> {
    let known = open.iter().position(|(_, at)| *at == place)?;
    Some(open.swap_remove(known).0)
}

#[cfg(test)]
mod tests;
