//! A pair of modes pursued over speed: a factorization a speed in place of an eigenproblem.
//!
//! Where two modes of opposite Krein sign merge, D = ((ω₁ − ω₂)/2)² passes linearly through
//! zero and goes on as −σ². Its root is well conditioned; the root of the growth rate σ
//! itself, which starts like a square root, is not.

use super::finder::Finder;
use super::station::{Change, Sign, Station, Token, change, crossing};
use crate::spectrum::{ModePair, SpectrumError};

/// Relative accuracy in speed to which an onset is bracketed before Newton's method.
const ROUGH_TOLERANCE: f64 = 1e-5;
/// How far beyond its bracket, relatively, an onset may turn out to be: the bracket comes
/// from few states.
const VICINITY: f64 = 1e-5;
/// Relative differences of speed for the slope and the curvature of D: its rounding is
/// 1e-15 of ω², and the pair is exact to the square of the distance.
const NEWTON_DIFFERENCE: f64 = 1e-6;
const VERTEX_DIFFERENCE: f64 = 1e-5;
/// A last step of this relative length leaves its square, times how many widths of the
/// band the speed is: below the accuracy asked.
const NEWTON_TOLERANCE: f64 = 1e-8;
/// The same for the vertex of a crossing: what is left of it, (nΩδ)², is below the square of
/// the least growth rate told from rounding.
const VERTEX_TOLERANCE: f64 = 1e-6;
const MAX_NEWTON: usize = 8;
/// Relative distance over which a pair is not taken for another.
const NO_NEIGHBOURS: f64 = 1e-5;
const MAX_STEPS: usize = 40;
/// Share of a square growth rate by which the few states of a station may be off.
const LIKENESS: f64 = 0.05;

/// A pair at a speed.
pub struct Pursuit<'a> {
    finder: &'a Finder<'a>,
    pair: ModePair,
    /// Where it is.
    pub speed_rad_per_s: f64,
}

/// A band inside an interval of speeds.
pub struct Inside {
    /// Onset.
    pub from: f64,
    /// End.
    pub to: f64,
}

/// What a pair that has exchanged its order did in between.
pub enum Passage {
    /// It crossed.
    Crossing,
    /// It merged and parted.
    Band(Inside),
}

impl<'a> Pursuit<'a> {
    /// The two modes of a speed next to a frequency. `None` where there are none such.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn begin(
        finder: &'a Finder<'a>,
        speed_rad_per_s: f64,
        frequency_rad_per_s: f64,
    ) -> Result<Option<Self>, SpectrumError> {
        let pair = finder.pair(speed_rad_per_s, frequency_rad_per_s)?;
        Ok(pair.map(|pair| Pursuit {
            finder,
            pair,
            speed_rad_per_s,
        }))
    }

    /// Follows the pair to a speed. `None` where it is lost.
    pub fn to(&self, speed_rad_per_s: f64) -> Option<Self> {
        let pair = self.finder.moved(&self.pair, speed_rad_per_s)?;
        Some(Pursuit {
            finder: self.finder,
            pair,
            speed_rad_per_s,
        })
    }

    /// ((ω₁ − ω₂)/2)², once merged −σ².
    pub fn discriminant(&self) -> f64 {
        self.pair.discriminant(self.speed_rad_per_s)
    }

    /// (ω₁ + ω₂)/2.
    pub fn mean_frequency(&self) -> f64 {
        self.pair.mean_frequency(self.speed_rad_per_s)
    }

    /// First and second derivative of D by central differences.
    fn derivatives(&self, relative_difference: f64) -> (f64, f64) {
        let h = relative_difference * self.speed_rad_per_s;
        let at = |d: f64| self.pair.discriminant(self.speed_rad_per_s + d);
        let (before, here, after) = (at(-h), at(0.0), at(h));
        let bend = (before - 2.0 * here + after) / (h * h);
        ((after - before) / (2.0 * h), bend)
    }

    /// Newton's method on D, from the side `ends.0`, where it is positive, to `ends.1`, where
    /// it is negative. `None` where it does not settle between them.
    fn onset(mut self, ends: (f64, f64)) -> Option<(f64, Self)> {
        let (low, high) = (ends.0.min(ends.1), ends.0.max(ends.1));
        for _ in 0..MAX_NEWTON {
            let speed = self.speed_rad_per_s;
            let (slope, _) = self.derivatives(NEWTON_DIFFERENCE);
            let next = speed - self.discriminant() / slope;
            let margin = VICINITY * speed;
            let lost = !(low - margin..=high + margin).contains(&next);
            if lost || slope * (ends.1 - ends.0) >= 0.0 {
                return None;
            }
            if (next - speed).abs() <= NEWTON_TOLERANCE * speed {
                return Some((next, self));
            }
            self = self.to(next)?;
        }
        None
    }

    /// Whether a token is this pair merged: a pair may have been taken for its neighbours on
    /// the way.
    pub fn is_token(&self, token: &Token) -> bool {
        let square = token.growth.powi(2);
        token.sign == Sign::Merged && (square + self.discriminant()).abs() <= LIKENESS * square
    }

    /// Whether the word of a speed shows this pair merged where it stood at `place` of the
    /// word `before`.
    fn is_shown(
        &self,
        before: &[Sign],
        speed_rad_per_s: f64,
        place: usize,
    ) -> Result<bool, SpectrumError> {
        let station = self.finder.station(speed_rad_per_s)?;
        let tokens = station.doubled();
        let pair = self.to(speed_rad_per_s);
        let same = pair.zip(tokens.get(place));
        Ok(change(before, &station.word()) == Change::Merge(place)
            && same.is_some_and(|(pair, token)| pair.is_token(token)))
    }

    /// The speed of least D between the ends, and the curvature of D there: the zero of its
    /// slope by the secant method, for a pair's own curvature lacks what it becomes elsewhere.
    fn vertex(mut self, ends: (f64, f64)) -> Option<(Self, f64)> {
        let (mut slope, mut bend) = self.derivatives(VERTEX_DIFFERENCE);
        for _ in 0..MAX_NEWTON {
            let speed = self.speed_rad_per_s;
            let step = -slope / bend;
            if bend <= 0.0 || !(ends.0..=ends.1).contains(&(speed + step)) {
                return None;
            }
            self = self.to(speed + step)?;
            if step.abs() <= VERTEX_TOLERANCE * speed {
                return Some((self, bend));
            }
            let (next, _) = self.derivatives(VERTEX_DIFFERENCE);
            (slope, bend) = (next, (next - slope) / step);
        }
        None
    }

    /// False position in its Illinois form on D, from a speed where the pair is apart by D =
    /// `apart` to this one, where it is merged, until Newton's method is near enough.
    fn bracketed(mut self, (from, apart): (f64, f64)) -> Option<Self> {
        let mut out = (from, apart);
        let mut inn = (self.speed_rad_per_s, self.discriminant());
        for step in 0..MAX_STEPS {
            let width = inn.0 - out.0;
            if width.abs() <= ROUGH_TOLERANCE * inn.0.abs() || inn.1 >= 0.0 {
                break;
            }
            // A halving now and then bounds the steps whatever the function does.
            let share = if step % 8 == 7 {
                0.5
            } else {
                (out.1 / (out.1 - inn.1)).clamp(1e-4, 1.0 - 1e-4)
            };
            let (before, speed) = (self.speed_rad_per_s, out.0 + share * width);
            self = self.to(speed)?;
            let d = self.discriminant();
            if d > 0.0 {
                out = (speed, d);
                inn.1 *= 0.5;
            } else {
                inn = (speed, d);
                out.1 *= 0.5;
            }
            if (speed - before).abs() <= ROUGH_TOLERANCE * speed.abs() {
                break;
            }
        }
        Some(self)
    }
}

/// Onset of the pair at a place of the doubled list, between a station where it is apart and
/// one where it is merged.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn onset_between(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<Option<f64>, SpectrumError> {
    let tokens = (apart.doubled(), merged.doubled());
    let (Some([one, other]), Some(inside)) = (tokens.0.get(place..place + 2), tokens.1.get(place))
    else {
        return Ok(None);
    };
    let ends = (apart.speed_rad_per_s, merged.speed_rad_per_s);
    let gap = (0.5 * (other.frequency - one.frequency)).powi(2);
    let Some(begun) = Pursuit::begin(finder, ends.1, inside.frequency)? else {
        return Ok(None);
    };
    let near = begun.bracketed((ends.0, gap));
    let Some((onset, pair)) = near.and_then(|near| near.onset(ends)) else {
        return Ok(None);
    };
    if (ends.1 - ends.0).abs() <= NO_NEIGHBOURS * ends.1 {
        return Ok(Some(onset));
    }
    let inside = onset + 0.1 * (ends.1 - onset);
    let shown = pair.is_shown(&apart.word(), inside, place)?;
    Ok(shown.then_some(onset))
}

/// What the pair does that stands at a place of the doubled list before and after, in the
/// other order.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn passage_between(
    finder: &Finder<'_>,
    [before, after]: [&Station; 2],
    place: usize,
    floor_per_s: f64,
) -> Result<Option<Passage>, SpectrumError> {
    let Some((start, frequency)) = crossing(before, after, place) else {
        return Ok(None);
    };
    let Some(pair) = Pursuit::begin(finder, start, frequency)? else {
        return Ok(None);
    };
    let ends = (before.speed_rad_per_s, after.speed_rad_per_s);
    let Some((vertex, bend)) = pair.vertex(ends) else {
        return Ok(None);
    };
    let lowest = vertex.discriminant();
    if lowest >= -floor_per_s.powi(2) {
        // Of two waves of one sign that avoid each other D is least above zero.
        return Ok((lowest <= floor_per_s.powi(2)).then_some(Passage::Crossing));
    }
    let (middle, half) = (vertex.speed_rad_per_s, (-2.0 * lowest / bend).sqrt());
    if !vertex.is_shown(&before.word(), middle, place)? {
        return Ok(None);
    }
    let onset = |edge: f64, outer: f64| {
        let near = vertex.to(edge)?;
        near.onset((outer, middle)).map(|(onset, _)| onset)
    };
    let (from, to) = (onset(middle - half, ends.0), onset(middle + half, ends.1));
    let band = from.zip(to).map(|(from, to)| Inside { from, to });
    Ok(band.map(Passage::Band))
}
