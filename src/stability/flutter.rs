//! Flutter bands: a quadruple from the speed at which it begins to the speed at which it ends.

use faer::c64;
use rayon::prelude::*;

use super::band::{Instability, InstabilityKind};
use super::evaluator::SignatureEvaluator;
use super::found::Found;
use super::maximum::{Sample, between, maximise};
use super::pair_continuation::{Coalescence, Edge, PairContinuation, VICINITY};
use super::pieces::Piece;
use super::quadruples::{Bound, Stretch, stretches};
use super::signature::SignedMode;
use crate::spectrum::SpectrumError;

/// Distance from its end, as a share of a band's width, of a peak at the end.
const BESIDE_END: f64 = 1e-3;
/// Distance from its expected end, as a share of an interval, at which following a quadruple to its end
/// starts.
const INSIDE: f64 = 0.02;
/// An end further than this share of the way from the prediction belongs to another quadruple.
const SAME_END: f64 = 0.1;
/// An end nearer than this share of the way is certain.
const CERTAIN_END: f64 = 0.01;

/// A quadruple followed over speed.
#[derive(Debug, Clone)]
pub(super) struct Quadruple {
    begin: End,
    end: End,
    /// Coalesced modes at ascending speeds.
    points: Vec<(f64, SignedMode)>,
}

/// Begin or end of a band.
#[derive(Debug, Clone, Copy)]
enum End {
    /// A coalescence.
    Edge(Edge),
    /// End of the range inside the band.
    Range(f64),
    /// Unknown end: the quadruple could not be followed to it.
    Unknown(f64),
}

impl End {
    fn speed(&self) -> f64 {
        match self {
            End::Edge(edge) => edge.speed_rad_per_s,
            End::Range(speed) | End::Unknown(speed) => *speed,
        }
    }

    /// σ² there, if no signature gives it.
    fn sample(&self) -> Option<Sample> {
        match self {
            End::Edge(edge) => Some(edge.sample()),
            End::Range(_) | End::Unknown(_) => None,
        }
    }
}

/// Quadruples in the pieces of a search, by their begin.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn quadruples(
    evaluator: &SignatureEvaluator<'_>,
    pieces: &[Piece],
) -> Result<Vec<Quadruple>, SpectrumError> {
    let found: Vec<Option<Quadruple>> = stretches(pieces)
        .par_iter()
        .map(|stretch| Quadruple::new(evaluator, stretch))
        .collect::<Result<_, _>>()?;
    let mut found: Vec<Quadruple> = found.into_iter().flatten().collect();
    found.sort_by(|x, y| x.begin.speed().total_cmp(&y.begin.speed()));
    Ok(found)
}

/// Bands in which a + and a − mode have coalesced.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn flutter(
    evaluator: &SignatureEvaluator<'_>,
    quadruples: &[Quadruple],
    range: (f64, f64),
) -> Result<Vec<Found>, SpectrumError> {
    let bands = quadruples
        .par_iter()
        .map(|quadruple| Found::new(range, |limits| quadruple.band(evaluator, limits)));
    bands.collect()
}

/// Part of a quadruple between two speeds.
#[derive(Debug, Clone, Copy)]
struct Part {
    from: f64,
    to: f64,
    /// Whether the part ends before the quadruple does, at each side.
    is_cut: [bool; 2],
}

impl Part {
    /// Speeds at which the quadruple is cut.
    fn cuts(&self) -> impl Iterator<Item = f64> {
        let ends = [self.from, self.to].into_iter().zip(self.is_cut);
        ends.filter_map(|(speed, is_cut)| is_cut.then_some(speed))
    }
}

/// A quadruple at a speed of a cut.
struct Cut {
    sample: Sample,
    growth_and_frequency: (f64, f64),
}

/// Quadruples that differ from the prediction by more than this share of its growth are others.
const SAME_QUADRUPLE: f64 = 0.7;

fn is_expected(mode: &SignedMode, square: c64) -> bool {
    let expected = square.sqrt();
    let growth = mode.lambda.re.max(expected.re);
    (mode.lambda - expected).norm() <= SAME_QUADRUPLE * growth
}

impl Quadruple {
    /// Quadruple of an interval; `None` if none was computed within it.
    fn new(
        evaluator: &SignatureEvaluator<'_>,
        stretch: &Stretch<'_>,
    ) -> Result<Option<Self>, SpectrumError> {
        let mut points: Vec<(f64, SignedMode)> = Vec::new();
        for &(speed, square) in &stretch.points {
            points.extend(
                evaluator
                    .quadruple(speed, square.sqrt())?
                    .map(|mode| (speed, mode)),
            );
        }
        if points.is_empty() {
            let speed = stretch.fastest_rad_per_s();
            let Some(square) = stretch.square(speed) else {
                return Ok(None);
            };
            let found = evaluator.quadruple(speed, square.sqrt())?;
            points.extend(
                found
                    .filter(|mode| is_expected(mode, square))
                    .map(|mode| (speed, mode)),
            );
        }
        if points.is_empty() {
            return Ok(None);
        }
        let begin = Self::end(evaluator, stretch, stretch.begin, &points)?;
        let inwards: Vec<(f64, SignedMode)> = points.iter().rev().copied().collect();
        let end = Self::end(evaluator, stretch, stretch.end, &inwards)?;
        Ok(Some(Quadruple { begin, end, points }))
    }

    /// End of an interval whose quadruple is known at the given inner speeds, the nearest to the end first.
    fn end(
        evaluator: &SignatureEvaluator<'_>,
        stretch: &Stretch<'_>,
        bound: Bound,
        inwards: &[(f64, SignedMode)],
    ) -> Result<End, SpectrumError> {
        let (expected, outside) = match bound {
            Bound::Coalescence {
                expected_rad_per_s,
                outside_rad_per_s,
            } => (expected_rad_per_s, outside_rad_per_s),
            Bound::Range(speed) => return Ok(End::Range(speed)),
            Bound::Height(speed) => return Ok(End::Unknown(speed)),
        };
        let off = |edge: &Edge| (edge.speed_rad_per_s - expected).abs();
        let followed = |start: f64, mode: &SignedMode| -> Result<Option<Edge>, SpectrumError> {
            let pair = PairContinuation::of_quadruple(evaluator, start, mode)?;
            let edge = pair.and_then(|pair| pair.edge(outside));
            let way = (expected - start).abs();
            Ok(edge.filter(|edge| off(edge) <= SAME_END * way + VICINITY * expected))
        };
        let (inside, mode) = inwards[0];
        let mut from_inside = followed(inside, &mode)?;
        let is_certain = |edge: &Edge| off(edge) <= CERTAIN_END * (expected - inside).abs();
        if let Some(edge) = from_inside.filter(is_certain) {
            return Ok(End::Edge(edge));
        }
        // The nearest speed may be closer to the end than the error of the states that gave it.
        if let (None, Some((speed, mode))) = (from_inside, inwards.get(1)) {
            from_inside = followed(*speed, mode)?;
        }
        // On a long way the pair may be mistaken for another that ends next to it.
        let beside = expected + INSIDE * (inside - expected);
        let near = match stretch.square(beside) {
            Some(square) => evaluator
                .quadruple(beside, square.sqrt())?
                .filter(|mode| is_expected(mode, square)),
            None => None,
        };
        let from_beside = near.map_or(Ok(None), |near| followed(beside, &near))?;
        let both = [from_beside, from_inside].into_iter().flatten();
        if let Some(edge) = both.min_by(|x, y| off(x).total_cmp(&off(y))) {
            return Ok(End::Edge(edge));
        }
        let Some(square) = stretch.square(expected) else {
            return Ok(End::Unknown(expected));
        };
        let is_real = square.re > 0.0;
        Ok(End::Edge(Edge {
            speed_rad_per_s: expected,
            coalescence: if is_real {
                Coalescence::Real
            } else {
                Coalescence::Waves
            },
            frequency_rad_per_s: if is_real { 0.0 } else { mode.lambda.im },
            growth_square: if is_real { mode.lambda.re.powi(2) } else { 0.0 },
            growth_square_slope: f64::NAN,
        }))
    }

    /// Ends of the quadruple that are coalescences of two real eigenvalues.
    pub fn real_ends(&self) -> impl Iterator<Item = f64> {
        let ends = [self.begin, self.end].into_iter();
        ends.filter_map(|end| match end {
            End::Edge(edge) if edge.coalescence == Coalescence::Real => Some(edge.speed_rad_per_s),
            _ => None,
        })
    }

    fn part(&self, (from, to): (f64, f64)) -> Part {
        let (begin, end) = (self.begin.speed(), self.end.speed());
        Part {
            from: from.max(begin),
            to: to.min(end),
            is_cut: [begin < from, to < end],
        }
    }

    /// Band of the quadruple between two speeds.
    fn band(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        limits: (f64, f64),
    ) -> Result<Instability, SpectrumError> {
        let part = self.part(limits);
        let (peak, fastest) = self.fastest(evaluator, part)?;
        let is_open = |end: &End| matches!(end, End::Range(_));
        Ok(Instability {
            kind: InstabilityKind::Flutter,
            from_rad_per_s: part.from,
            to_rad_per_s: part.to,
            closed: !is_open(&self.begin) && !is_open(&self.end),
            peak_rad_per_s: peak,
            peak_growth_per_s: fastest.0,
            frequency_rad_per_s: fastest.1,
            curve: Vec::new(),
        })
    }

    /// Speed of the largest growth in a part, with growth rate and frequency.
    fn fastest(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        part: Part,
    ) -> Result<(f64, (f64, f64)), SpectrumError> {
        let mut known = self.points.clone();
        let mut samples: Vec<Sample> = self.points.iter().map(sample).collect();
        samples.extend(
            [self.begin.sample(), self.end.sample()]
                .into_iter()
                .flatten(),
        );
        samples.sort_by(|x, y| x.at.total_cmp(&y.at));
        let cuts = part
            .cuts()
            .map(|speed| self.cut(evaluator, &samples, speed));
        let cuts: Vec<Cut> = cuts.collect::<Result<_, _>>()?;
        samples.extend(cuts.iter().map(|cut| cut.sample));
        samples.retain(|sample| (part.from..=part.to).contains(&sample.at));
        samples.sort_by(|x, y| x.at.total_cmp(&y.at));
        let found = maximise(samples, |speed| {
            let Some(mode) = continued(evaluator, &known, speed)? else {
                return Ok(None);
            };
            let place = known.partition_point(|(at, _)| *at < speed);
            known.insert(place, (speed, mode));
            Ok(Some(sample(&known[place])))
        })?;
        let at = found.map_or(self.points[0].0, |sample| sample.at);
        if let Some(cut) = cuts.iter().find(|cut| cut.sample.at == at) {
            return Ok((at, cut.growth_and_frequency));
        }
        // Where two real λ coalesce growth does not vanish and is often largest just inside.
        for (end, other) in [(&self.begin, part.to), (&self.end, part.from)] {
            if let End::Edge(edge) = end
                && edge.speed_rad_per_s == at
            {
                let inside = at + BESIDE_END * (other - at);
                return Ok((
                    inside,
                    (edge.growth_square.sqrt(), edge.frequency_rad_per_s),
                ));
            }
        }
        let (speed, mode) = nearest(&known, at);
        // This pair is accurate to rounding, whereas the search uses coarser models.
        let sharp = PairContinuation::of_quadruple(evaluator, speed, &mode)?;
        let sharp = sharp.and_then(|pair| pair.growth_and_frequency());
        Ok((speed, sharp.unwrap_or((mode.lambda.re, mode.lambda.im))))
    }

    /// Quadruple at a speed: followed from the nearest known speed, or else from the cubic between its
    /// neighbours.
    fn cut(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        samples: &[Sample],
        speed: f64,
    ) -> Result<Cut, SpectrumError> {
        let (known, mode) = nearest(&self.points, speed);
        let pair = PairContinuation::of_quadruple(evaluator, known, &mode)?;
        let followed = pair.and_then(|pair| pair.to(speed)).and_then(|pair| {
            Some(Cut {
                sample: pair.sample(),
                growth_and_frequency: pair.growth_and_frequency()?,
            })
        });
        Ok(followed.unwrap_or_else(|| {
            let value = between(samples, speed).max(0.0);
            Cut {
                sample: Sample {
                    at: speed,
                    value,
                    slope: f64::NAN,
                },
                growth_and_frequency: (value.sqrt(), mode.lambda.im),
            }
        }))
    }
}

/// The quadruple at the known speed nearest to a given one.
fn nearest(known: &[(f64, SignedMode)], speed: f64) -> (f64, SignedMode) {
    let away = |x: &&(f64, SignedMode)| (x.0 - speed).abs();
    let nearest = known.iter().min_by(|x, y| away(x).total_cmp(&away(y)));
    nearest.copied().unwrap_or(known[0])
}

/// σ² of a quadruple at a speed.
fn sample((speed, mode): &(f64, SignedMode)) -> Sample {
    Sample {
        at: *speed,
        value: mode.lambda.re.powi(2),
        slope: 2.0 * mode.lambda.re * mode.slope.re,
    }
}

/// Quadruple at another speed, estimated from the neighbouring speeds.
fn continued(
    evaluator: &SignatureEvaluator<'_>,
    known: &[(f64, SignedMode)],
    speed: f64,
) -> Result<Option<SignedMode>, SpectrumError> {
    let place = known.partition_point(|(at, _)| *at < speed);
    let expected = match known.get(place.saturating_sub(1)..=place) {
        Some([(from, before), (to, after)]) => {
            let share = (speed - from) / (to - from);
            before.lambda * (1.0 - share) + after.lambda * share
        }
        _ => {
            let (at, mode) = nearest(known, speed);
            mode.lambda + mode.slope * (speed - at)
        }
    };
    evaluator.quadruple(speed, expected)
}
