//! Every coalescence of an undamped blade between two speeds, however narrow the band.
//!
//! Modes can coalesce only if their Krein signs differ, so a change in the order of signs
//! between two speeds betrays a crossing or a band between them. Intervals are halved until
//! each holds at most one event that explains all that differs at its ends: the order of the
//! waves, the number of real λ, and which quadruple continues which.

use rayon::prelude::*;

use super::evaluator::SignatureEvaluator;
use super::matching::{Matching, matched};
use super::pair_continuation::{
    Coalescence, Edge, NarrowBand, PairContinuation, Passage, VICINITY, passage,
};
use super::signature::{
    Change, Sign, Signature, SignedMode, between_crossings, change, crossing, may_touch,
};
use crate::spectrum::{SpectrumError, Work};
use crate::tuned::Tuned;

/// Intervals below this relative width are not halved any more.
const LEAST_WIDTH: f64 = 1e-9;
/// Relative width below which a crossing is not halved any more: the gap of its waves is then
/// below what eigenvalues can show.
const CROSSING_WIDTH: Tuned = Tuned::new("stability/search::CROSSING_WIDTH", 1e-5);
/// Share of |ω| + Ω below which a growth rate is rounding.
const GROWTH_FLOOR: f64 = 1e-7;
/// Share of an interval that is left on each side of a coalescence when the rest is searched.
const BESIDE_EDGE: Tuned = Tuned::new("stability/search::BESIDE_EDGE", 0.02);

/// The least distance from an edge, as a share of its speed: the models of the search shift edges
/// by less.
pub(super) fn least_beside() -> f64 {
    2.0 * VICINITY.get()
}

/// What happens between two neighbouring speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// The quadruple with this index at the lower speed ends.
    End(usize, Edge),
    /// The quadruple with this index at the upper speed begins.
    Begin(usize, Edge),
    /// A whole band.
    Band(NarrowBand),
}

/// From one speed to the next.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Step {
    /// Quadruples that go on: index below and above.
    pub continued: Vec<(usize, usize)>,
    /// At most one event.
    pub event: Option<Event>,
}

/// Signatures at ascending speeds, and a step between every two of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    /// At ascending speeds.
    pub signatures: Vec<Signature>,
    /// One fewer.
    pub steps: Vec<Step>,
}

impl Path {
    /// Searches all intervals between neighbouring signatures; they are independent.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn search(
        evaluator: &SignatureEvaluator<'_>,
        signatures: Vec<Signature>,
    ) -> Result<Self, SpectrumError> {
        let work = &Work::of(
            "intervals of the search",
            signatures.len().saturating_sub(1),
        );
        let pieces: Vec<Result<Path, SpectrumError>> = signatures
            .par_windows(2)
            .map(|pair| {
                let mut piece = Path::default();
                Search { evaluator, work }.between(&pair[0], &pair[1], 0, &mut piece)?;
                work.advance();
                Ok(piece)
            })
            .collect();
        let mut path = Path {
            signatures: signatures.first().cloned().into_iter().collect(),
            steps: Vec::new(),
        };
        for piece in pieces {
            let piece = piece?;
            path.signatures.extend(piece.signatures);
            path.steps.extend(piece.steps);
        }
        Ok(path)
    }

    /// Appends a step and the signature at its end.
    fn push(&mut self, step: Step, end: &Signature) {
        self.steps.push(step);
        self.signatures.push(end.clone());
    }
}

struct Search<'a> {
    evaluator: &'a SignatureEvaluator<'a>,
    work: &'a Work,
}

impl Search<'_> {
    /// Appends all steps from `a` to `b`.
    fn between(
        &self,
        a: &Signature,
        b: &Signature,
        depth: usize,
        path: &mut Path,
    ) -> Result<(), SpectrumError> {
        let (x, y) = (a.speed_rad_per_s, b.speed_rad_per_s);
        let matching = matched(&a.quadruples, &b.quadruples, y - x);
        // A mode passes through zero at a critical speed; the speeds looked at are so close on
        // both sides that nothing else happens.
        if self.evaluator.spans_critical(x, y) {
            path.push(without_event(matching), b);
            return Ok(());
        }
        let settled = self.settled(a, b, &matching)?;
        let is_least = y - x <= LEAST_WIDTH * y || self.evaluator.is_exhausted();
        match settled {
            Some(Step {
                event: Some(Event::Begin(_, edge) | Event::End(_, edge)),
                ..
            }) if !is_least && depth < EDGE_DEPTH => self.around_edge([a, b], edge, depth, path),
            Some(step) => {
                path.push(step, b);
                Ok(())
            }
            None if is_least => {
                path.push(without_event(matching), b);
                Ok(())
            }
            None => {
                let share = match between_crossings(a, b) {
                    // Halving now and then bounds the depth wherever the waves go.
                    Some(share) if depth % 4 != 3 => share,
                    _ => 0.5,
                };
                let middle = x + share * (y - x);
                let middle = match y - x <= exact_width() * y {
                    true => self.evaluator.exactly_at(middle)?,
                    false => self.evaluator.at(middle)?,
                };
                self.work.extend(1);
                self.between(a, &middle, depth + 1, path)?;
                self.work.advance();
                self.between(&middle, b, depth + 1, path)
            }
        }
    }

    /// Both sides of a coalescence are searched for what else may happen there.
    fn around_edge(
        &self,
        [a, b]: [&Signature; 2],
        edge: Edge,
        depth: usize,
        path: &mut Path,
    ) -> Result<(), SpectrumError> {
        let width = b.speed_rad_per_s - a.speed_rad_per_s;
        let beside = (BESIDE_EDGE.get() * width).max(least_beside() * edge.speed_rad_per_s);
        let speeds = [-beside, beside].map(|away| edge.speed_rad_per_s + away);
        let mut ends = vec![a.clone()];
        for speed in speeds {
            let inner = [a, b].map(|end| (end.speed_rad_per_s - speed).abs() > beside);
            if inner == [true; 2] && (a.speed_rad_per_s..b.speed_rad_per_s).contains(&speed) {
                ends.push(self.evaluator.at(speed)?);
            }
        }
        ends.push(b.clone());
        for pair in ends.windows(2) {
            // The narrow interval about the edge is not parted again.
            let holds_edge =
                (pair[0].speed_rad_per_s..=pair[1].speed_rad_per_s).contains(&edge.speed_rad_per_s);
            let depth = if holds_edge {
                depth.max(EDGE_DEPTH)
            } else {
                depth + 1
            };
            self.between(&pair[0], &pair[1], depth, path)?;
        }
        Ok(())
    }

    /// The step from `a` to `b`, if no more than one event explains all that differs.
    fn settled(
        &self,
        a: &Signature,
        b: &Signature,
        matching: &Matching,
    ) -> Result<Option<Step>, SpectrumError> {
        if !matching.is_certain {
            return Ok(None);
        }
        let order = change(&a.order(), &b.order());
        let more_real = b.real.len() as isize - a.real.len() as isize;
        let step = |event| {
            Some(Step {
                continued: matching.pairs.clone(),
                event,
            })
        };
        // A pair of waves or of real λ comes with the end of a quadruple, and goes with its begin.
        let explained = |edge: &Edge, real_of_edge: isize| match edge.coalescence {
            Coalescence::Waves => order == Change::Pair && more_real == 0,
            Coalescence::Real => order == Change::None && more_real == real_of_edge,
        };
        Ok(match (&matching.ended[..], &matching.begun[..]) {
            ([], []) if more_real != 0 => None,
            ([], []) => match order {
                Change::None if !may_touch(a, b) => step(None),
                Change::Exchange(place) => self.exchange([a, b], place)?.and_then(step),
                _ => None,
            },
            ([ended], []) => {
                let edge = self.edge(a, &a.quadruples[*ended], b.speed_rad_per_s)?;
                let edge = edge.filter(|edge| explained(edge, 2));
                edge.and_then(|edge| step(Some(Event::End(*ended, edge))))
            }
            ([], [begun]) => {
                let edge = self.edge(b, &b.quadruples[*begun], a.speed_rad_per_s)?;
                let edge = edge.filter(|edge| explained(edge, -2));
                edge.and_then(|edge| step(Some(Event::Begin(*begun, edge))))
            }
            _ => None,
        })
    }

    fn edge(
        &self,
        at: &Signature,
        mode: &SignedMode,
        end_rad_per_s: f64,
    ) -> Result<Option<Edge>, SpectrumError> {
        let pair = PairContinuation::of_quadruple(self.evaluator, at.speed_rad_per_s, mode)?;
        Ok(pair.and_then(|pair| pair.edge(end_rad_per_s)))
    }

    /// What two waves did that stand in opposite order at `a` and `b`: `Some(None)` where they
    /// crossed, `None` where that is not known yet.
    fn exchange(
        &self,
        [a, b]: [&Signature; 2],
        place: usize,
    ) -> Result<Option<Option<Event>>, SpectrumError> {
        let (from, to) = (a.speed_rad_per_s, b.speed_rad_per_s);
        let mut unexchanged = b.clone();
        if place + 1 < unexchanged.waves.len() {
            unexchanged.waves.swap(place, place + 1);
        }
        if others_may_touch(a, &unexchanged, place) {
            return Ok(None);
        }
        let Some((speed, frequency)) = crossing(a, b, place) else {
            return Ok(None);
        };
        let expected = self.evaluator.at(speed)?;
        let nearest = |sign: Sign| {
            let away = |w: &&SignedMode| (w.lambda.im - frequency).abs();
            let same = expected.waves.iter().filter(|w| w.sign == sign);
            same.min_by(|x, y| away(x).total_cmp(&away(y)))
        };
        let floor = GROWTH_FLOOR * (to + b.highest_rad_per_s());
        let same_count = expected.quadruples.len() == a.quadruples.len();
        let found = match (nearest(Sign::Plus), nearest(Sign::Minus)) {
            (Some(plus), Some(minus)) if same_count => {
                passage(self.evaluator, (from, to), (speed, [plus, minus]), floor)?
            }
            _ => None,
        };
        let is_narrow = to - from <= CROSSING_WIDTH.get() * to && same_count;
        Ok(match found {
            Some(Passage::Crossing) => Some(None),
            Some(Passage::Band(band)) => Some(Some(Event::Band(band))),
            None => is_narrow.then_some(None),
        })
    }
}

/// Relative width from which the coarser models between the anchors may show an edge on the
/// wrong side of a speed.
fn exact_width() -> f64 {
    4.0 * VICINITY.get()
}
/// Depth from which an interval about a coalescence is not parted any more.
const EDGE_DEPTH: usize = 1000;

fn without_event(matching: Matching) -> Step {
    Step {
        continued: matching.pairs,
        event: None,
    }
}

/// Whether waves may touch besides the two that have changed places.
fn others_may_touch(a: &Signature, b: &Signature, place: usize) -> bool {
    let without = |signature: &Signature| {
        let mut below = signature.clone();
        let mut above = signature.clone();
        below.waves.truncate(place + 1);
        above.waves.drain(..(place + 1).min(signature.waves.len()));
        (below, above)
    };
    let (a, b) = (without(a), without(b));
    may_touch(&a.0, &b.0) || may_touch(&a.1, &b.1)
}
