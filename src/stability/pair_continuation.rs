//! Two modes followed over speed together: their invariant subspace is smooth where they
//! coalesce and split, which their eigenvalues are not.
//!
//! Of the quadruple ±σ ± iω, σ² passes linearly through zero where it comes from two waves of
//! opposite Krein sign, and ω² where it goes on as two real λ. These roots are well conditioned;
//! the root of the growth rate itself, which starts like a square root, is not.

mod looked;

use self::looked::Looked;
use super::evaluator::SignatureEvaluator;
use super::maximum::Sample;
use super::signature::SignedMode;
use crate::spectrum::{ModePair, SpectrumError};

/// Relative difference of speed for the slope of σ²: its rounding is 1e-15 of ω², and the pair is exact to the square of the
/// distance.
const DIFFERENCE: f64 = 1e-6;
/// A last step of this relative length leaves its square, times how many widths of the
/// band the speed is: below the accuracy asked.
const NEWTON_TOLERANCE: f64 = 1e-8;
const MAX_STEPS: usize = 40;
/// Share of the way to the coalescence of two real λ that one step goes: beyond it the pair has
/// no complex states to be followed by.
const SHORT_OF_REAL: f64 = 0.999;
/// Share of σ² and, of the speed, the shift of an edge by which the states that the search goes by
/// may be off.
const LIKENESS: f64 = 0.05;
pub const VICINITY: f64 = 3e-5;

/// How a quadruple begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coalescence {
    /// Of a + and a − wave: σ = 0.
    Waves,
    /// Of two real λ: ω = 0.
    Real,
}

/// Begin or end of a quadruple.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// Of what.
    pub coalescence: Coalescence,
    /// ω there, in rad/s.
    pub frequency_rad_per_s: f64,
    /// σ² there, in 1/s².
    pub growth_square: f64,
    /// dσ²/dΩ there, in 1/s.
    pub growth_square_slope: f64,
}

impl Edge {
    /// σ² there with its slope.
    pub fn sample(&self) -> Sample {
        Sample {
            at: self.speed_rad_per_s,
            value: self.growth_square,
            slope: self.growth_square_slope,
        }
    }
}

/// A pair at a speed.
pub struct PairContinuation<'a> {
    evaluator: &'a SignatureEvaluator<'a>,
    pair: ModePair,
    speed: f64,
}

impl<'a> PairContinuation<'a> {
    /// The pair of a quadruple: it and its mirror image.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn of_quadruple(
        evaluator: &'a SignatureEvaluator<'a>,
        speed_rad_per_s: f64,
        mode: &SignedMode,
    ) -> Result<Option<Self>, SpectrumError> {
        let pair = evaluator.pair(speed_rad_per_s, mode.lambda)?;
        let begun = pair.map(|pair| PairContinuation {
            evaluator,
            pair,
            speed: speed_rad_per_s,
        });
        Ok(begun.filter(|pair| pair.is_mode(mode)))
    }

    /// Follows the pair to a speed. `None` where it is lost.
    pub fn to(&self, speed: f64) -> Option<Self> {
        Some(PairContinuation {
            evaluator: self.evaluator,
            pair: self.evaluator.moved(&self.pair, speed)?,
            speed,
        })
    }

    /// σ² and ω².
    fn squares(&self) -> [f64; 2] {
        self.pair.squares(self.speed)
    }

    /// Growth rate and frequency while coalesced, in 1/s and rad/s.
    pub fn growth_and_frequency(&self) -> Option<(f64, f64)> {
        let [growth, frequency] = self.squares();
        (growth > 0.0 && frequency >= 0.0).then(|| (growth.sqrt(), frequency.sqrt()))
    }

    /// Whether a quadruple is this pair: a pair may be taken for its neighbours on the way.
    fn is_mode(&self, mode: &SignedMode) -> bool {
        let [growth, frequency] = self.squares();
        let (sigma, omega) = (mode.lambda.re, mode.lambda.im);
        let shift = VICINITY * self.speed;
        let off = |square: f64, part: f64, slope: f64| {
            let allowed = LIKENESS * sigma * sigma.max(part) + 2.0 * part * slope.abs() * shift;
            (square - part * part).abs() <= allowed
        };
        off(growth, sigma, mode.slope.re) && off(frequency, omega, mode.slope.im)
    }

    /// Derivatives of σ² and ω², by central differences.
    fn slopes(&self) -> [f64; 2] {
        let h = DIFFERENCE * self.speed;
        let [before, after] = [-h, h].map(|d| self.pair.squares(self.speed + d));
        [0, 1].map(|k| (after[k] - before[k]) / (2.0 * h))
    }

    /// What is known of σ² and ω² here.
    fn looked(&self) -> Looked {
        Looked {
            speed: self.speed,
            squares: self.squares(),
            slopes: self.slopes(),
        }
    }

    /// The speed next to which σ² or ω² is zero, on the way upwards or downwards: that of the cubic through the
    /// speed looked at before and this one, or of the tangent.
    fn root(here: &Looked, before: Option<&Looked>, direction: f64) -> Option<Edge> {
        let of = |k: usize, coalescence| {
            let left = before
                .and_then(|before| here.root_of_cubic(before, k, direction))
                .or_else(|| here.root_of_tangent(k, direction))?;
            let at_root = [0, 1].map(|k| here.squares[k] + here.slopes[k] * left);
            Some(Edge {
                speed_rad_per_s: here.speed + left,
                coalescence,
                frequency_rad_per_s: at_root[1].max(0.0).sqrt(),
                growth_square: at_root[0].max(0.0),
                growth_square_slope: here.slopes[0],
            })
        };
        let edges = [of(0, Coalescence::Waves), of(1, Coalescence::Real)];
        let away = |edge: &Edge| (edge.speed_rad_per_s - here.speed) * direction;
        let edges = edges.into_iter().flatten();
        edges.min_by(|x, y| away(x).total_cmp(&away(y)))
    }

    /// Where the quadruple ends on the way from here to `end`, a speed at which it is not any
    /// more. `None` where it is lost on the way.
    pub fn edge(&self, end: f64) -> Option<Edge> {
        // From the start: the edge may lie a little beyond `end`.
        let direction = (end - self.speed).signum();
        let by_cubics = self.edge_by(end, |here, before| Self::root(here, before, direction));
        by_cubics.or_else(|| self.edge_by(end, |here, _| Self::root(here, None, direction)))
    }

    /// The same by a guess of the edge from what is known here and at the speed looked at before.
    fn edge_by(
        &self,
        end: f64,
        root: impl Fn(&Looked, Option<&Looked>) -> Option<Edge>,
    ) -> Option<Edge> {
        let (start, direction) = (self.speed, (end - self.speed).signum());
        // The last speed known inside, and the first known outside. Where the edge is next to
        // an end, a coarser model may have seen it on the other side.
        let margin = direction * VICINITY * start;
        let (mut inside, mut outside) = (start - margin, end + margin);
        let mut followed: Option<Self> = None;
        let mut before: Option<Looked> = None;
        for _ in 0..MAX_STEPS {
            let current = followed.as_ref().unwrap_or(self);
            let (here, speed) = (current.looked(), current.speed);
            let found = root(&here, before.as_ref());
            let distance = |edge: &Edge| (edge.speed_rad_per_s - speed).abs();
            if let Some(edge) = found.filter(|e| distance(e) <= NEWTON_TOLERANCE * speed) {
                let from_start = (edge.speed_rad_per_s - start + margin) * direction;
                let to_end = (end + margin - edge.speed_rad_per_s) * direction;
                return (from_start >= 0.0 && to_end >= 0.0).then_some(edge);
            }
            let share = match found.map(|edge| edge.coalescence) {
                Some(Coalescence::Real) => SHORT_OF_REAL,
                _ => 1.0,
            };
            let guess = found.map(|e| speed + share * (e.speed_rad_per_s - speed));
            let between = |guess: &f64| {
                (guess - inside) * direction > 0.0 && (outside - guess) * direction > 0.0
            };
            let next = guess.filter(between).unwrap_or(0.5 * (inside + outside));
            let Some(moved) = current.to(next) else {
                outside = next;
                continue;
            };
            let [growth, frequency] = moved.squares();
            if growth > 0.0 && frequency > 0.0 {
                inside = next;
            } else {
                outside = next;
            }
            if frequency <= 0.0 {
                // Two real λ have no complex states to be followed by: the way goes on from here.
                before = Some(moved.looked());
                continue;
            }
            before = Some(here);
            followed = Some(moved);
        }
        None
    }

    /// σ² with its slope, for the search of its maximum.
    pub fn sample(&self) -> Sample {
        let [slope, _] = self.slopes();
        Sample {
            at: self.speed,
            value: self.squares()[0],
            slope,
        }
    }
}
