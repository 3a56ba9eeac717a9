//! Proof that intervals of speed contain no unlisted instability.
//!
//! Krein's index is k_real + 2 k_flutter + 2 k_negative = n₋(K), and between two frequencies with nonsingular
//! L(iω) its count changes by p − m. So at any speed, for any frequencies 0 < ω₁ < ω₂ < … and ω₀ = 0,
//!
//! k_real + 2 k_flutter ≤ n₋(K) − 2 Σ max(0, n₋(L(iωᵢ)) − n₋(L(iωᵢ₊₁))):
//!
//! because the sum counts − modes that must exist. If the counts are constant along lines ωᵢ(Ω), which
//! [`FullModel`](crate::modes::FullModel) decides by two factorizations, and no critical speed changes
//! n₋(K), the bound holds at every speed of the interval. The spectra only propose the lines. Next to a
//! crossing or the edge of a band the gap closes, and intervals are halved down to a least width; the rest is
//! reported as searched but unproven.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::checked_modes::CheckedModes;
use crate::model::scene::SpeedRange;
use crate::modes::{AtSpeed, Cancellation, SpectrumError, Work};
use crate::stability::band::Instability;
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::mode_counts::{Gap, ModeCounts, gaps};
use crate::stability::pieces::Piece;
use crate::stability::sample::Sample;

/// Intervals narrower than this share of the highest speed are not halved further.
const LEAST_WIDTH: f64 = 1e-4;

/// A list of bands with the models for its proof.
pub struct Proof<'a> {
    pub full: &'a ModeCounts<'a>,
    pub checked: &'a CheckedModes<'a>,
    /// Pieces of the search.
    pub pieces: &'a [Piece],
    pub bands: &'a [Instability],
}

/// A line is not tried if its gap is narrower at one end than this share of its width at the other.
const CLOSING: f64 = 0.1;

/// A line is not tried if its speeds differ by more than this multiple of the width of its gap: of 605 lines
/// for the paper's saw, none longer than 0.45 widths was free of modes.
const LONGEST: f64 = 0.5;

impl Proof<'_> {
    /// Unproven intervals between ascending samples.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn unproven(&self, samples: &[Sample]) -> Result<Vec<SpeedRange>, SpectrumError> {
        let Some(last) = samples.last() else {
            return Ok(Vec::new());
        };
        let least = LEAST_WIDTH * last.speed_rad_per_s;
        let ends: Vec<End> = samples.iter().map(|s| self.end(s)).collect();
        let is_uncritical = |a: &End, b: &End| !self.checked.spans_critical(a.speed, b.speed);
        let stretches: Vec<&[End]> = ends.chunk_by(is_uncritical).collect();
        let step = &Work::of("stretches of the proof", stretches.len());
        let within: Vec<Result<Vec<SpeedRange>, SpectrumError>> = stretches
            .into_par_iter()
            .map(|stretch| self.within(stretch, &[], least, step))
            .collect();
        let mut open: Vec<SpeedRange> = within
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?
            .into_iter()
            .flatten()
            .collect();
        let critical = ends
            .windows(2)
            .filter(|pair| !is_uncritical(&pair[0], &pair[1]));
        open.extend(critical.map(|pair| SpeedRange::new(pair[0].speed, pair[1].speed)));
        Ok(open)
    }

    fn end(&self, sample: &Sample) -> End {
        End {
            speed: sample.speed_rad_per_s,
            gaps: gaps(sample, self.checked.height_rad_per_s()),
            at: Arc::default(),
        }
    }

    /// Sample for proposals, neither counted nor checked: from the pieces of the search if they show it.
    fn guess_at(&self, speed: f64) -> Result<Sample, SpectrumError> {
        let piece = Piece::settled(self.pieces, speed);
        match piece.and_then(|piece| piece.sample_at(speed)) {
            Some(sample) => Ok(sample),
            None => self.checked.guess_at(speed),
        }
    }

    /// Unproven intervals from the first to the last of some speeds; between the last two left, further
    /// speeds are computed. `known` are lines that cross no mode, `least` is the smallest width of an
    /// interval.
    fn within(
        &self,
        ends: &[End],
        known: &[Line],
        least: f64,
        step: &Work,
    ) -> Result<Vec<SpeedRange>, SpectrumError> {
        let [a, .., b] = ends else {
            step.advance();
            return Ok(Vec::new());
        };
        let mut known = known.to_vec();
        Cancellation::current().check()?;
        if b.speed <= a.speed || self.is_proven(a, b, &mut known) {
            step.advance();
            return Ok(Vec::new());
        }
        let halves = |below: &[End], above: &[End]| {
            step.extend(1);
            let (below, above) = rayon::join(
                || self.within(below, &known, least, step),
                || self.within(above, &known, least, step),
            );
            let mut open = below?;
            open.extend(above?);
            Ok(open)
        };
        let middle = 0.5 * (a.speed + b.speed);
        if ends.len() > 2 {
            let place = ends
                .partition_point(|end| end.speed < middle)
                .clamp(1, ends.len() - 2);
            return halves(&ends[..=place], &ends[place..]);
        }
        let is_open = self.full.has_free_motions() || self.full.is_dense();
        if is_open || b.speed - a.speed <= least || self.checked.is_exhausted() {
            step.advance();
            return Ok(vec![SpeedRange::new(a.speed, b.speed)]);
        }
        let middle = match a.halfway(b) {
            Some(middle) => middle,
            None => self.end(&self.guess_at(middle)?),
        };
        halves(&[a.clone(), middle.clone()], &[middle, b.clone()])
    }

    /// Whether the listed bands account for all unstable modes between two speeds. Lines that cross no mode
    /// are added to the known ones, even if they do not suffice.
    fn is_proven(&self, a: &End, b: &End, known: &mut Vec<Line>) -> bool {
        let negative = self.full.negative_stiffness(a.speed);
        let listed = self.listed([a.speed, b.speed]);
        if negative <= listed {
            return true;
        }
        // With free rigid motions the number of negative eigenvalues of the dynamic stiffness L(iω) at small
        // ω differs from that of the stiffness K. In a dense model each count factorizes a matrix of the
        // order of the basis, so that the proof would take longer than the whole search.
        if self.full.has_free_motions() || self.full.is_dense() {
            return false;
        }
        let mut are_free = true;
        for (x, y) in a.alike(b) {
            let covers = |line: &Line| line.net == x.net && line.is_within([(a, x), (b, y)]);
            if known.iter().any(covers) {
                continue;
            }
            match self.line([a, b], [x, y], negative) {
                Some(line) => known.push(line),
                None => are_free = false,
            }
        }
        are_free && a.is_like(b) && negative.saturating_sub(2 * a.reflected()) <= listed
    }

    /// Line through the middle of a gap at both ends, if its count is proven to be constant.
    fn line(&self, ends: [&End; 2], gap: [&Gap; 2], negative: usize) -> Option<Line> {
        let [x, y] = gap.map(Gap::width_rad_per_s);
        let [from, to] = ends.map(|end| end.speed);
        let is_closing = x.min(y) < CLOSING * x.max(y);
        let is_long = to - from > LONGEST * x.min(y);
        let count = negative.checked_add_signed(gap[0].net)?;
        let frequencies = gap.map(Gap::middle_rad_per_s);
        if is_closing || is_long {
            return None;
        }
        let at = ends.map(|end| end.at.get_or_init(|| self.full.at(end.speed)));
        let is_free = self.full.is_count_along(at, frequencies, count);
        is_free.then(|| Line {
            speeds: ends.map(|end| end.speed),
            frequencies,
            net: gap[0].net,
        })
    }

    /// k_real + 2 k_flutter of the bands that cover the whole interval between two speeds.
    fn listed(&self, [from, to]: [f64; 2]) -> usize {
        let covers = |band: &&Instability| band.from_rad_per_s <= from && to <= band.to_rad_per_s;
        let index = |band: &Instability| match band.kind {
            InstabilityKind::Divergence => 1,
            InstabilityKind::Flutter => 2,
        };
        self.bands.iter().filter(covers).map(index).sum()
    }
}

/// Line ω(Ω) that crosses no mode.
#[derive(Debug, Clone, Copy)]
struct Line {
    speeds: [f64; 2],
    frequencies: [f64; 2],
    /// p − m below the line.
    net: isize,
}

impl Line {
    /// Whether the line is within a gap at two of its speeds.
    fn is_within(&self, gap: [(&End, &Gap); 2]) -> bool {
        let ([from, to], [low, high]) = (self.speeds, self.frequencies);
        gap.iter().all(|(end, gap)| {
            let at = low + (high - low) * (end.speed - from) / (to - from);
            2.0 * (at - gap.middle_rad_per_s()).abs() < gap.width_rad_per_s()
        })
    }
}

/// End of an interval of speeds.
#[derive(Clone)]
struct End {
    speed: f64,
    gaps: Vec<Gap>,
    /// Data of the counts, shared by the intervals on both sides.
    at: Arc<OnceLock<AtSpeed>>,
}

impl End {
    /// Whether both ends have the same gaps, with the same p − m.
    fn is_like(&self, other: &End) -> bool {
        self.alike(other).count() == self.gaps.len().max(other.gaps.len())
    }

    /// Estimated gaps at the middle speed, by cubics through both ends, if both have the same gaps. The
    /// estimate only proposes lines.
    fn halfway(&self, other: &End) -> Option<End> {
        if self.gaps.is_empty() || !self.is_like(other) {
            return None;
        }
        let step = other.speed - self.speed;
        let between = |(x, y): (&Gap, &Gap)| {
            let sides = [0, 1].map(|k| {
                let [(f0, d0), (f1, d1)] = [x.sides[k], y.sides[k]];
                let slope = 1.5 * (f1 - f0) / step - 0.25 * (d0 + d1);
                (0.5 * (f0 + f1) + 0.125 * step * (d0 - d1), slope)
            });
            let gap = Gap { sides, net: x.net };
            let [narrow, wide] = [x, y].map(Gap::width_rad_per_s);
            let [narrow, wide] = [narrow.min(wide), narrow.max(wide)];
            // A width far from the widths at both ends is refused, because next to a coalescence slopes are
            // unbounded and the cubic is wrong.
            let is_sound = (0.5 * narrow..2.0 * wide).contains(&gap.width_rad_per_s());
            is_sound.then_some(gap)
        };
        let gaps: Option<Vec<Gap>> = self.gaps.iter().zip(&other.gaps).map(between).collect();
        Some(End {
            speed: self.speed + 0.5 * step,
            gaps: gaps?,
            at: Arc::default(),
        })
    }

    /// Gaps that both ends have in common, counted from below and from above.
    fn alike<'a>(&'a self, other: &'a End) -> impl Iterator<Item = (&'a Gap, &'a Gap)> {
        let same = |(x, y): &(&Gap, &Gap)| x.net == y.net;
        let (ours, theirs) = (&self.gaps, &other.gaps);
        let below = ours.iter().zip(theirs).take_while(same).count();
        let above = ours
            .iter()
            .rev()
            .zip(theirs.iter().rev())
            .take_while(same)
            .count()
            .min(ours.len().min(theirs.len()) - below);
        let first = ours[..below].iter().zip(&theirs[..below]);
        let last = ours[ours.len() - above..].iter();
        first.chain(last.zip(&theirs[theirs.len() - above..]))
    }

    /// Smallest number of − modes that the counts in the gaps imply.
    fn reflected(&self) -> usize {
        let below = [0].into_iter().chain(self.gaps.iter().map(|gap| gap.net));
        let fewer = below
            .zip(&self.gaps)
            .map(|(below, gap)| (below - gap.net).max(0));
        fewer.sum::<isize>() as usize
    }
}
