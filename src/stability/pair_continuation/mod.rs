//! Continuation of a mode pair over speed: the invariant subspace of two modes is smooth where they coalesce and
//! split, unlike their eigenvalues.
//!
//! For a quadruple ±σ ± iω, σ² passes linearly through zero where two waves of opposite Krein sign coalesce,
//! and ω² where the quadruple turns into two real λ. These roots are well conditioned; the root of the growth
//! rate itself, which starts like a square root, is not.

mod looked;

use self::looked::Looked;
use super::evaluator::SignatureEvaluator;
use super::maximum::Sample;
use super::signature::SignedMode;
use crate::modes::{ModePair, SpectrumError, smallest};

/// Relative speed difference for the slopes of σ² and ω²: rounding is 1e-15 of ω², and the error of the pair
/// is of the order of the square of the difference.
const DIFFERENCE: f64 = 1e-6;
/// Relative length of the last step. The error after it is the square of this length times the ratio of speed
/// to band width, below the required accuracy.
const NEWTON_TOLERANCE: f64 = 1e-8;
/// Number of steps after which the continuation fails.
const MAX_STEPS: usize = 40;
/// Largest share of the way to the coalescence of two real λ in one step: beyond the coalescence the pair has
/// no complex states to follow.
const SHORT_OF_REAL: f64 = 0.999;
/// Allowed relative error of σ² in the models of the search.
const LIKENESS: f64 = 0.05;
/// Allowed shift of an edge in the models of the search, relative to the speed.
pub const VICINITY: f64 = 3e-5;

/// Kind of begin or end of a quadruple.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coalescence {
    /// Coalescence of a + and a − wave: σ = 0.
    Waves,
    /// Coalescence of two real λ: ω = 0.
    Real,
}

/// Begin or end of a quadruple.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Kind of coalescence.
    pub coalescence: Coalescence,
    /// ω at the edge, in rad/s.
    pub frequency_rad_per_s: f64,
    /// σ² at the edge, in 1/s².
    pub growth_square: f64,
    /// dσ²/dΩ at the edge, in 1/s.
    pub growth_square_slope: f64,
}

impl Edge {
    /// σ² at the edge with its slope.
    pub fn sample(&self) -> Sample {
        Sample {
            at: self.speed_rad_per_s,
            value: self.growth_square,
            slope: self.growth_square_slope,
        }
    }
}

/// A pair of modes at a speed, which can be followed to other speeds.
pub struct PairContinuation<'a> {
    evaluator: &'a SignatureEvaluator<'a>,
    pair: ModePair,
    speed: f64,
}

impl<'a> PairContinuation<'a> {
    /// The pair of a quadruple and its mirror image.
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

    /// Whether a quadruple is this pair: the refinement may have converged to a neighbour.
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

    /// σ² and ω² at this speed with their slopes.
    fn looked(&self) -> Looked {
        Looked {
            speed: self.speed,
            squares: self.squares(),
            slopes: self.slopes(),
        }
    }

    /// Estimated edge at which σ² or ω² is zero, the first in a direction of speed: from the cubic through
    /// this and the previous speed, or from the tangent.
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
        smallest(edges.into_iter().flatten(), away)
    }

    /// Edge of the quadruple between this speed and `end`, a speed outside it. `None` if the pair is lost on
    /// the way.
    pub fn edge(&self, end: f64) -> Option<Edge> {
        let direction = (end - self.speed).signum();
        let by_cubics = self.edge_by(end, |here, before| Self::root(here, before, direction));
        by_cubics.or_else(|| self.edge_by(end, |here, _| Self::root(here, None, direction)))
    }

    /// Finds the edge by a function that estimates it from this and the previous speed.
    fn edge_by(
        &self,
        end: f64,
        root: impl Fn(&Looked, Option<&Looked>) -> Option<Edge>,
    ) -> Option<Edge> {
        let (start, direction) = (self.speed, (end - self.speed).signum());
        // The edge is between `inside` and `outside`. The margin is needed because a coarser model may have
        // placed the edge on the other side of the start or the end.
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
                // Two real λ have no complex states to follow, so the continuation returns to the previous
                // speed.
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
