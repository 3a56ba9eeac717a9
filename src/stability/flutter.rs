//! Flutter bands: what a quadruple does from the speed at which it begins to that at which it ends.

use rayon::prelude::*;

use faer::c64;

use super::band::{Instability, InstabilityKind};
use super::evaluator::SignatureEvaluator;
use super::found::Found;
use super::matching::matched;
use super::maximum::{Sample, between, maximise};
use super::pair_continuation::{Edge, NarrowBand, PairContinuation};
use super::search::{Event, Path};
use super::signature::{Sign, SignedMode};
use crate::spectrum::SpectrumError;
use crate::tuned::Tuned;

/// Share of a band's width from its end at which a peak at the end is said to be.
const BESIDE_END: Tuned = Tuned::new("stability/flutter::BESIDE_END", 1e-3);

/// A quadruple followed over speed.
#[derive(Debug, Clone)]
pub(super) struct Quadruple {
    begin: End,
    end: End,
    /// It at ascending speeds.
    points: Vec<(f64, SignedMode)>,
}

/// Where a band begins or ends.
#[derive(Debug, Clone, Copy)]
enum End {
    /// At a coalescence.
    Edge(Edge),
    /// Inside the band, at the end of the range.
    Range(f64),
    /// Between two speeds too close to tell what happens.
    Unknown(f64),
}

impl End {
    fn speed(&self) -> f64 {
        match self {
            End::Edge(edge) => edge.speed_rad_per_s,
            End::Range(speed) | End::Unknown(speed) => *speed,
        }
    }

    /// σ² there, where no signature says so.
    fn sample(&self) -> Option<Sample> {
        match self {
            End::Edge(edge) => Some(edge.sample()),
            End::Range(_) | End::Unknown(_) => None,
        }
    }
}

/// Joins the steps of a path: every quadruple that lasts from one speed to another.
fn quadruples(path: &Path) -> Vec<Quadruple> {
    let mut found: Vec<Quadruple> = Vec::new();
    let Some(first) = path.signatures.first() else {
        return found;
    };
    let mut start = |begin: End, speed: f64, mode: SignedMode| {
        found.push(Quadruple {
            begin,
            end: End::Range(speed),
            points: vec![(speed, mode)],
        });
        found.len() - 1
    };
    // For every quadruple of the present signature its place in the list.
    let mut here: Vec<usize> = Vec::new();
    for mode in &first.quadruples {
        let speed = first.speed_rad_per_s;
        here.push(start(End::Range(speed), speed, *mode));
    }
    let mut ends: Vec<(usize, End)> = Vec::new();
    let mut points: Vec<(usize, (f64, SignedMode))> = Vec::new();
    for (step, pair) in path.steps.iter().zip(path.signatures.windows(2)) {
        let unknown = End::Unknown(0.5 * (pair[0].speed_rad_per_s + pair[1].speed_rad_per_s));
        for (k, quadruple) in here.iter().enumerate() {
            if step.continued.iter().all(|(before, _)| *before != k) {
                let end = match step.event {
                    Some(Event::End(index, edge)) if index == k => End::Edge(edge),
                    _ => unknown,
                };
                ends.push((*quadruple, end));
            }
        }
        let speed = pair[1].speed_rad_per_s;
        let next = pair[1].quadruples.iter().enumerate().map(|(k, mode)| {
            let before = step.continued.iter().find(|(_, after)| *after == k);
            if let Some((before, _)) = before {
                points.push((here[*before], (speed, *mode)));
                return here[*before];
            }
            let begin = match step.event {
                Some(Event::Begin(index, edge)) if index == k => End::Edge(edge),
                _ => unknown,
            };
            start(begin, speed, *mode)
        });
        here = next.collect();
    }
    for (quadruple, point) in points {
        found[quadruple].points.push(point);
        found[quadruple].end = End::Range(point.0);
    }
    for (quadruple, end) in ends {
        found[quadruple].end = end;
    }
    found
}

/// Bands in which a + and a − mode have coalesced.
pub(super) fn flutter(
    evaluator: &SignatureEvaluator<'_>,
    path: &Path,
    range: (f64, f64),
) -> Result<Vec<Found>, SpectrumError> {
    let wide: Vec<Result<Found, SpectrumError>> = quadruples(path)
        .into_par_iter()
        .map(|quadruple| Found::new(range, |limits| quadruple.band(evaluator, limits)))
        .collect();
    let narrow = path.steps.iter().filter_map(|step| match step.event {
        Some(Event::Band(band)) => Some(band),
        _ => None,
    });
    let narrow = narrow.map(|band| {
        let quadruple = Quadruple::of_narrow(&band);
        Found::new(range, |limits| match quadruple.part(limits).is_whole() {
            true => Ok(narrow_band(&band)),
            false => quadruple.band(evaluator, limits),
        })
    });
    wide.into_iter().chain(narrow).collect()
}

fn narrow_band(band: &NarrowBand) -> Instability {
    Instability {
        kind: InstabilityKind::Flutter,
        from_rad_per_s: band.edges[0].speed_rad_per_s,
        to_rad_per_s: band.edges[1].speed_rad_per_s,
        closed: true,
        peak_rad_per_s: band.peak_rad_per_s,
        peak_growth_per_s: band.growth_per_s,
        frequency_rad_per_s: band.frequency_rad_per_s,
        curve: Vec::new(),
    }
}

/// The part of a quadruple between two speeds.
#[derive(Debug, Clone, Copy)]
struct Part {
    from: f64,
    to: f64,
    /// Whether it ends before the quadruple does.
    is_cut: [bool; 2],
}

impl Part {
    fn is_whole(&self) -> bool {
        self.is_cut == [false; 2]
    }

    /// The speeds at which the quadruple is cut.
    fn cuts(&self) -> impl Iterator<Item = f64> {
        let ends = [self.from, self.to].into_iter().zip(self.is_cut);
        ends.filter_map(|(speed, is_cut)| is_cut.then_some(speed))
    }
}

/// A quadruple at a speed at which it is cut.
struct Cut {
    sample: Sample,
    growth_and_frequency: (f64, f64),
}

impl Quadruple {
    /// That of a band between two speeds of the search.
    fn of_narrow(band: &NarrowBand) -> Self {
        let at_peak = SignedMode {
            sign: Sign::Quadruple,
            lambda: c64::new(band.growth_per_s, band.frequency_rad_per_s),
            slope: c64::new(0.0, 0.0),
        };
        Quadruple {
            begin: End::Edge(band.edges[0]),
            end: End::Edge(band.edges[1]),
            points: vec![(band.peak_rad_per_s, at_peak)],
        }
    }

    fn part(&self, (from, to): (f64, f64)) -> Part {
        let (begin, end) = (self.begin.speed(), self.end.speed());
        Part {
            from: from.max(begin),
            to: to.min(end),
            is_cut: [begin < from, to < end],
        }
    }

    /// Its band between two speeds.
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

    /// Speed of the largest growth in a part, with growth rate and frequency there.
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
        // Where two real λ coalesce growth does not end, and is often largest: just inside.
        for (end, other) in [(&self.begin, part.to), (&self.end, part.from)] {
            if let End::Edge(edge) = end
                && edge.speed_rad_per_s == at
            {
                let inside = at + BESIDE_END.get() * (other - at);
                return Ok((
                    inside,
                    (edge.growth_square.sqrt(), edge.frequency_rad_per_s),
                ));
            }
        }
        let (speed, mode) = nearest(&known, at);
        // To rounding, where the search goes by coarser models.
        let sharp = PairContinuation::of_quadruple(evaluator, speed, &mode)?;
        let sharp = sharp.and_then(|pair| pair.growth_and_frequency());
        Ok((speed, sharp.unwrap_or((mode.lambda.re, mode.lambda.im))))
    }

    /// It at a speed: followed from the nearest at which it is known, or else as the cubic between these says.
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

/// Of a quadruple at some speeds that at the one nearest to another.
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

/// The quadruple at another speed, from what it is at those next to it. `None` where that is
/// not certain.
fn continued(
    evaluator: &SignatureEvaluator<'_>,
    known: &[(f64, SignedMode)],
    speed: f64,
) -> Result<Option<SignedMode>, SpectrumError> {
    let signature = evaluator.at(speed)?;
    let place = known.partition_point(|(at, _)| *at < speed);
    let neighbours = [place.checked_sub(1), Some(place)];
    let neighbours = neighbours
        .into_iter()
        .flatten()
        .filter_map(|k| known.get(k));
    let of = |(at, mode): &(f64, SignedMode)| {
        let matching = matched(&[*mode], &signature.quadruples, speed - at);
        matching.pairs.first().map(|(_, k)| *k)
    };
    let mut found: Vec<usize> = neighbours.filter_map(of).collect();
    found.dedup();
    Ok(match found.as_slice() {
        [one] => Some(signature.quadruples[*one]),
        _ => None,
    })
}
