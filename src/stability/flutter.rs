//! Flutter bands: a quadruple from the speed at which it begins to the speed at which it ends.

use faer::c64;
use rayon::prelude::*;

use super::band::{Instability, InstabilityKind};
use super::evaluator::SignatureEvaluator;
use super::found::Found;
use super::maximum::{Sample, between, maximize};
use super::pieces::Piece;
use super::quadruples::{Bound, Stretch, stretches};
use super::signature::SignedMode;
use crate::spectrum::{DoubleEigenvalue, SpectrumError, smallest};

/// Distance of a peak at the end of a band from that end, as a share of the width.
const BESIDE_END: f64 = 1e-3;
/// An end whose distance from the expected end exceeds this share of the way to the nearest known speed belongs to another
/// quadruple.
const SAME_END: f64 = 0.1;
/// Allowed shift of an edge in the models of the search, relative to the speed.
pub(super) const VICINITY: f64 = 3e-5;
/// Allowed relative error of a growth rate in the models of the search.
const LIKENESS: f64 = 0.025;

/// A quadruple followed over speed.
#[derive(Debug, Clone)]
pub(super) struct Quadruple {
    begin: End,
    end: End,
    /// Coalesced modes at ascending speeds.
    points: Vec<(f64, SignedMode)>,
}

/// Coalescence of a + and a − wave or of two real λ.
#[derive(Debug, Clone, Copy)]
struct Edge {
    speed_rad_per_s: f64,
    /// λ, imaginary or real, in 1/s.
    lambda: c64,
    /// dσ²/dΩ, in 1/s; not finite if unknown.
    growth_square_slope: f64,
}

/// Begin or end of a band.
#[derive(Debug, Clone, Copy)]
enum End {
    /// Coalescence of two waves or of two real λ.
    Edge(Edge),
    /// End of the range inside the band.
    Range(f64),
    /// Estimated end of a quadruple that could not be followed to it.
    Unknown(f64),
}

impl End {
    fn speed(&self) -> f64 {
        match self {
            End::Edge(edge) => edge.speed_rad_per_s,
            End::Range(speed) | End::Unknown(speed) => *speed,
        }
    }

    /// σ² at the end, if it is a coalescence.
    fn sample(&self) -> Option<Sample> {
        match self {
            End::Edge(edge) => Some(Sample {
                at: edge.speed_rad_per_s,
                value: edge.lambda.re.powi(2),
                slope: edge.growth_square_slope,
            }),
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

/// The flutter bands of quadruples.
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
    /// Whether the quadruple continues below `from`, and above `to`.
    is_cut: [bool; 2],
}

impl Part {
    /// Speeds at which the quadruple is cut.
    fn cuts(&self) -> impl Iterator<Item = f64> {
        let ends = [self.from, self.to].into_iter().zip(self.is_cut);
        ends.filter_map(|(speed, is_cut)| is_cut.then_some(speed))
    }
}

/// A quadruple at the end of a part that cuts it.
struct Cut {
    sample: Sample,
    /// In 1/s and rad/s.
    growth_and_frequency: (f64, f64),
}

/// A quadruple that differs from the expected one by more than this share of the growth is another quadruple.
const SAME_QUADRUPLE: f64 = 0.7;

fn is_expected(mode: &SignedMode, square: c64) -> bool {
    let expected = square.sqrt();
    let growth = mode.lambda.re.max(expected.re);
    (mode.lambda - expected).norm() <= SAME_QUADRUPLE * growth
}

impl Quadruple {
    /// Follows the quadruple of an interval to both ends; `None` if no eigenproblem confirms it.
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
        let nearest = [points[0], points[points.len() - 1]];
        let [begin, end] = [(stretch.begin, nearest[0]), (stretch.end, nearest[1])]
            .map(|(bound, inside)| Self::end(evaluator, stretch, bound, inside));
        Ok(Some(Quadruple { begin, end, points }))
    }

    /// End of an interval whose quadruple is known at an inner speed.
    fn end(
        evaluator: &SignatureEvaluator<'_>,
        stretch: &Stretch<'_>,
        bound: Bound,
        (inside, mode): (f64, SignedMode),
    ) -> End {
        let (expected, outside) = match bound {
            Bound::Coalescence {
                expected_rad_per_s,
                outside_rad_per_s,
            } => (expected_rad_per_s, outside_rad_per_s),
            Bound::Range(speed) => return End::Range(speed),
            Bound::Height(speed) => return End::Unknown(speed),
        };
        let square = stretch.square(expected);
        let re = square.unwrap_or(mode.lambda * mode.lambda).re;
        let is_real = re > 0.0;
        let lambda = match is_real {
            true => c64::new(re.sqrt(), 0.0),
            false => c64::new(0.0, (-re).sqrt()),
        };
        let direction = (outside - inside).signum();
        let margin = VICINITY * expected;
        let is_same = |found: &DoubleEigenvalue| {
            let off = (found.speed_rad_per_s - expected).abs();
            let beyond = (found.speed_rad_per_s - outside) * direction;
            let before = (inside - found.speed_rad_per_s) * direction;
            // ((λ₁ − λ₂)/2)² is σ² next to a coalescence of waves and −ω² next to one of real λ.
            let sign = if is_real { 1.0 } else { -1.0 };
            let is_outwards = found.square_slope * direction * sign > 0.0;
            let way = (expected - inside).abs();
            off <= SAME_END * way + margin && before.max(beyond) <= margin && is_outwards
        };
        let found = evaluator.coalescence(expected, lambda).filter(is_same);
        End::Edge(match found {
            Some(found) => Edge {
                speed_rad_per_s: found.speed_rad_per_s,
                lambda: found.lambda,
                growth_square_slope: if is_real {
                    f64::NAN
                } else {
                    found.square_slope
                },
            },
            None => Edge {
                speed_rad_per_s: expected,
                lambda,
                growth_square_slope: f64::NAN,
            },
        })
    }

    /// Ends of the quadruple that are coalescences of two real eigenvalues.
    pub fn real_ends(&self) -> impl Iterator<Item = f64> {
        let ends = [self.begin, self.end].into_iter();
        ends.filter_map(|end| match end {
            End::Edge(edge) if edge.lambda.re > 0.0 => Some(edge.speed_rad_per_s),
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

    /// Speed of the largest growth in a part, with growth rate and frequency, in rad/s, 1/s and rad/s.
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
        let found = maximize(samples, |speed| {
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
        // At the coalescence of two real λ the growth is not zero and may be the largest of the band. The
        // peak is then placed slightly inside the band.
        for (end, other) in [(&self.begin, part.to), (&self.end, part.from)] {
            if let End::Edge(edge) = end
                && edge.speed_rad_per_s == at
            {
                let inside = at + BESIDE_END * (other - at);
                return Ok((inside, (edge.lambda.re, edge.lambda.im)));
            }
        }
        let (speed, mode) = nearest(&known, at);
        let mode = sharp(evaluator, speed, mode);
        Ok((speed, (mode.lambda.re, mode.lambda.im)))
    }

    /// Quadruple at a speed, or else from the cubic between its neighbours.
    fn cut(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        samples: &[Sample],
        speed: f64,
    ) -> Result<Cut, SpectrumError> {
        if let Some(mode) = continued(evaluator, &self.points, speed)? {
            let mode = sharp(evaluator, speed, mode);
            return Ok(Cut {
                sample: sample(&(speed, mode)),
                growth_and_frequency: (mode.lambda.re, mode.lambda.im),
            });
        }
        let value = between(samples, speed).max(0.0);
        let (_, mode) = nearest(&self.points, speed);
        Ok(Cut {
            sample: Sample {
                at: speed,
                value,
                slope: f64::NAN,
            },
            growth_and_frequency: (value.sqrt(), mode.lambda.im),
        })
    }
}

/// The quadruple by the projection, whereas the search uses coarser models.
fn sharp(evaluator: &SignatureEvaluator<'_>, speed: f64, mode: SignedMode) -> SignedMode {
    let shift = VICINITY * speed;
    let near = |found: f64, expected: f64, slope: f64| {
        (found - expected).abs() <= LIKENESS * mode.lambda.re + slope.abs() * shift
    };
    let found = evaluator.next_to(speed, mode.lambda);
    // The iteration may lead to the mirror image −σ + iω.
    let found = found.map(|(lambda, slope)| match lambda.re < 0.0 {
        true => (-lambda.conj(), -slope.conj()),
        false => (lambda, slope),
    });
    let is_same = |(lambda, _): &(c64, c64)| {
        lambda.re > 0.0
            && near(lambda.re, mode.lambda.re, mode.slope.re)
            && near(lambda.im, mode.lambda.im, mode.slope.im)
    };
    found
        .filter(is_same)
        .map_or(mode, |(lambda, slope)| SignedMode {
            lambda,
            slope,
            ..mode
        })
}

/// The quadruple at the known speed nearest to a given one.
fn nearest(known: &[(f64, SignedMode)], speed: f64) -> (f64, SignedMode) {
    let nearest = smallest(known, |(at, _)| (at - speed).abs());
    *nearest.unwrap_or(&known[0])
}

/// σ² of a quadruple at a speed.
fn sample((speed, mode): &(f64, SignedMode)) -> Sample {
    Sample {
        at: *speed,
        value: mode.lambda.re.powi(2),
        slope: 2.0 * mode.lambda.re * mode.slope.re,
    }
}

/// Quadruple at another speed, nearest to the estimate from neighbouring speeds.
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
