//! Flutter bands: a quadruple from the speed at which it begins to the speed at which it ends.

mod end;

use faer::c64;
use rayon::prelude::*;

pub(super) use self::end::VICINITY;
use self::end::{End, Point};

use super::band::{Instability, InstabilityKind};
use super::evaluator::SignatureEvaluator;
use super::maximum::{Sample, maximize};
use super::pieces::Piece;
use super::quadruples::{Stretch, stretches};
use super::search_result::Found;
use super::signature::SignedMode;
use crate::model::scene::SpeedRange;
use crate::modes::{SpectrumError, smallest};

/// Distance of a peak at the end of a band from that end, as a share of the width.
const BESIDE_END: f64 = 1e-3;

/// A quadruple over an interval of speed.
#[derive(Debug, Clone)]
pub(super) struct Quadruple {
    begin: End,
    end: End,
    /// Coalesced modes at ascending speeds.
    points: Vec<Point>,
}

/// Quadruples in the pieces of a search, by their begin.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn quadruples(
    evaluator: &SignatureEvaluator<'_>,
    pieces: &[Piece],
) -> Result<Vec<Quadruple>, SpectrumError> {
    let followed: Vec<Option<Quadruple>> = stretches(pieces)
        .par_iter()
        .map(|stretch| Quadruple::new(evaluator, stretch))
        .collect::<Result<_, _>>()?;
    let mut found: Vec<Quadruple> = followed.into_iter().flatten().collect();
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
    range: SpeedRange,
) -> Result<Vec<Found>, SpectrumError> {
    let bands = quadruples
        .par_iter()
        .map(|quadruple| Found::new(range, |limits| quadruple.band(evaluator, limits)));
    bands.collect()
}

/// Part of a quadruple between two speeds.
#[derive(Debug, Clone, Copy)]
struct Part {
    range: SpeedRange,
    /// Whether the quadruple continues below the range, and above it.
    is_cut: [bool; 2],
}

impl Part {
    /// Speeds at which the quadruple is cut.
    fn cuts(&self) -> impl Iterator<Item = f64> {
        let ends = self.range.ends().into_iter().zip(self.is_cut);
        ends.filter_map(|(speed, is_cut)| is_cut.then_some(speed))
    }
}

/// A quadruple that differs from the expected one by more than this share of the growth is another quadruple.
const SAME_QUADRUPLE: f64 = 0.7;

fn is_expected(mode: &SignedMode, square: c64) -> bool {
    let expected = square.sqrt();
    let growth = mode.lambda.re.max(expected.re);
    (mode.lambda - expected).norm() <= SAME_QUADRUPLE * growth
}

impl Quadruple {
    /// The quadruple of an interval with both ends; `None` if no eigenproblem confirms it.
    fn new(
        evaluator: &SignatureEvaluator<'_>,
        stretch: &Stretch<'_>,
    ) -> Result<Option<Self>, SpectrumError> {
        let mut points: Vec<Point> = Vec::new();
        for &(speed, square) in &stretch.points {
            points.extend(
                evaluator
                    .quadruple(speed, square.sqrt())?
                    .map(|mode| Point { speed, mode }),
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
                    .map(|mode| Point { speed, mode }),
            );
        }
        if points.is_empty() {
            return Ok(None);
        }
        let nearest = [points[0], points[points.len() - 1]];
        let [begin, end] = [(stretch.begin, nearest[0]), (stretch.end, nearest[1])]
            .map(|(bound, inside)| End::new(evaluator, stretch, bound, inside));
        Ok(Some(Quadruple { begin, end, points }))
    }

    /// Ends of the quadruple that are coalescences of two real eigenvalues.
    pub fn real_ends(&self) -> impl Iterator<Item = f64> {
        let ends = [self.begin, self.end].into_iter();
        ends.filter_map(|end| match end {
            End::Edge(edge) if edge.lambda.re > 0.0 => Some(edge.speed_rad_per_s),
            _ => None,
        })
    }

    fn part(&self, limits: SpeedRange) -> Part {
        let whole = SpeedRange::new(self.begin.speed(), self.end.speed());
        let range = whole.within(limits);
        Part {
            range,
            is_cut: [
                whole.from_rad_per_s < range.from_rad_per_s,
                range.to_rad_per_s < whole.to_rad_per_s,
            ],
        }
    }

    /// Band of the quadruple between two speeds.
    fn band(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        limits: SpeedRange,
    ) -> Result<Instability, SpectrumError> {
        let part = self.part(limits);
        let [from_rad_per_s, to_rad_per_s] = part.range.ends();
        let (peak_rad_per_s, fastest) = self.fastest(evaluator, part)?;
        let is_open = |end: &End| matches!(end, End::Range(_));
        Ok(Instability {
            kind: InstabilityKind::Flutter,
            from_rad_per_s,
            to_rad_per_s,
            closed: !is_open(&self.begin) && !is_open(&self.end),
            peak_rad_per_s,
            peak_growth_per_s: fastest.re,
            frequency_rad_per_s: fastest.im,
            curve: Vec::new(),
        })
    }

    /// Speed of the largest growth in a part, in rad/s, and λ there.
    fn fastest(
        &self,
        evaluator: &SignatureEvaluator<'_>,
        part: Part,
    ) -> Result<(f64, c64), SpectrumError> {
        let mut known = self.points.clone();
        for speed in part.cuts() {
            let mode = continued(evaluator, &self.points, speed)?;
            known.extend(mode.map(|mode| Point { speed, mode }));
        }
        known.sort_by(|x, y| x.speed.total_cmp(&y.speed));
        let ends = [&self.begin, &self.end].into_iter().filter_map(End::sample);
        let mut samples: Vec<Sample> = known.iter().map(sample).chain(ends).collect();
        samples.retain(|sample| part.range.contains(sample.at));
        samples.sort_by(|x, y| x.at.total_cmp(&y.at));
        let found = maximize(samples, |_, speed| {
            let Some(mode) = continued(evaluator, &known, speed)? else {
                return Ok(None);
            };
            let place = known.partition_point(|known| known.speed < speed);
            known.insert(place, Point { speed, mode });
            Ok(Some(sample(&known[place])))
        })?;
        let at = found.map_or(self.points[0].speed, |sample| sample.at);
        // At the coalescence of two real λ the growth is not zero and may be the largest of the band. The
        // peak is then placed slightly inside the band.
        let [from, to] = part.range.ends();
        for (end, other) in [(&self.begin, to), (&self.end, from)] {
            if let End::Edge(edge) = end
                && edge.speed_rad_per_s == at
            {
                let inside = at + BESIDE_END * (other - at);
                return Ok((inside, edge.lambda));
            }
        }
        let peak = nearest(&known, at);
        Ok((peak.speed, peak.mode.lambda))
    }
}

/// The quadruple at the known speed nearest to a given one.
fn nearest(known: &[Point], speed: f64) -> Point {
    let nearest = smallest(known, |point| (point.speed - speed).abs());
    *nearest.unwrap_or(&known[0])
}

/// σ² of a quadruple at a speed.
fn sample(Point { speed, mode }: &Point) -> Sample {
    Sample {
        at: *speed,
        value: mode.lambda.re.powi(2),
        slope: 2.0 * mode.lambda.re * mode.slope.re,
    }
}

/// Quadruple at another speed, nearest to the estimate from neighbouring speeds.
fn continued(
    evaluator: &SignatureEvaluator<'_>,
    known: &[Point],
    speed: f64,
) -> Result<Option<SignedMode>, SpectrumError> {
    let place = known.partition_point(|known| known.speed < speed);
    let expected = match known.get(place.saturating_sub(1)..=place) {
        Some([before, after]) => {
            let share = (speed - before.speed) / (after.speed - before.speed);
            before.mode.lambda * (1.0 - share) + after.mode.lambda * share
        }
        _ => {
            let Point { speed: at, mode } = nearest(known, speed);
            mode.lambda + mode.slope * (speed - at)
        }
    };
    evaluator.quadruple(speed, expected)
}
