//! Which mode of a speed is which mode of the next one.

use faer::{Col, c64};

use super::assignment::cheapest;
use crate::spectrum::{DescribedMode, Mode, ModeKind};

/// A mode of each of two speeds, taken for the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Match {
    /// Index of the mode at the lower speed.
    pub before: usize,
    /// Index of the mode at the higher speed.
    pub after: usize,
    /// |xᴴy|² of the two shapes, 1 for the same shape.
    pub likeness: f64,
}

/// A mode with its shape in coordinates that both speeds share.
#[derive(Debug, Clone, Copy)]
pub struct Sighted<'a> {
    mode: &'a Mode,
    shape: &'a Col<c64>,
}

impl<'a> Sighted<'a> {
    /// Modes of one projection, in its own coordinates.
    pub fn of_modes(modes: &'a [Mode]) -> Vec<Self> {
        let shape = |mode: &'a Mode| &mode.coordinates;
        modes
            .iter()
            .map(|mode| Sighted {
                mode,
                shape: shape(mode),
            })
            .collect()
    }

    /// Modes of a chart, whose projections change from speed to speed.
    pub fn of_described(modes: &'a [DescribedMode]) -> Vec<Self> {
        modes
            .iter()
            .map(|m| Sighted {
                mode: &m.mode,
                shape: &m.shape,
            })
            .collect()
    }
}

/// Weight of a frequency that is off by the chart's height, against shapes that are wholly
/// unlike: shape decides between neighbours, and nothing leaps over the chart.
const OFF: f64 = 4.0;
/// Cost of a branch that ends or begins at the top of the chart or at no frequency at all, and of
/// one that does so anywhere else, which no eigenvalue of a stable window does.
const AT_EDGE: f64 = 0.5;
const INSIDE: f64 = 20.0;
/// Share of the height that counts as its top, besides the way a mode goes in one step.
const TOP: f64 = 0.02;
/// Frequencies below this share of the height are those of real λ, or of a free blade that drifts in turning air.
const STOPPED: f64 = 1e-6;
/// Weight of growth that has turned into decay, of damped modes: of two that have met the shapes
/// are conjugate and the frequencies equal, and growth alone tells them apart. Of the two real λ
/// into which a wave turns, the one that grows carries on its branch, as in an undamped blade.
const REGROWN: f64 = 0.2;
/// Cost of two modes that nothing can turn into each other.
const NEVER: f64 = 1e3;

/// The pairs of least total cost, of two speeds that are `step` apart. A mode is left alone only where it leaves or enters the
/// chart at its top, `height_rad_per_s`, or where one list is longer.
pub fn match_modes(
    [before, after]: [&[Sighted<'_>]; 2],
    step: f64,
    height_rad_per_s: f64,
) -> Vec<Match> {
    let old: Vec<Carrier<'_>> = before.iter().map(Carrier::new).collect();
    let new: Vec<Carrier<'_>> = after.iter().map(Carrier::new).collect();
    let height = height_rad_per_s.max(f64::MIN_POSITIVE);
    // Where a mode goes within the step, seen from its own speed. A damped mode that comes to a
    // stop turns into two real λ, of which one begins or ends there.
    let leaving = |c: &Carrier<'_>, step: f64| {
        let there = (c.frequency + c.slope * step).abs().max(c.frequency.abs());
        match there >= (1.0 - TOP) * height || c.has_stopped(height) {
            true => AT_EDGE,
            false => INSIDE,
        }
    };
    let size = old.len() + new.len();
    let mut costs = vec![vec![0.0; size]; size];
    let mut likeness = vec![vec![0.0; new.len()]; old.len()];
    for (i, x) in old.iter().enumerate() {
        for (k, y) in new.iter().enumerate() {
            (costs[i][k], likeness[i][k]) = x.cost(y, step, height);
        }
        costs[i][new.len()..].fill(leaving(x, step));
    }
    for row in &mut costs[old.len()..] {
        for (cost, y) in row.iter_mut().zip(&new) {
            *cost = leaving(y, -step);
        }
    }
    let columns = cheapest(&costs);
    let pairs = columns.iter().take(old.len()).enumerate();
    pairs
        .filter(|(i, k)| **k < new.len() && costs[*i][**k] < NEVER)
        .map(|(before, &after)| Match {
            before,
            after,
            likeness: likeness[before][after],
        })
        .collect()
}

/// A mode brought to positive action.
struct Carrier<'a> {
    frequency: f64,
    slope: f64,
    component: usize,
    shape: &'a Col<c64>,
    conjugated: bool,
    damped: bool,
    growth: f64,
}

impl<'a> Carrier<'a> {
    fn new(&Sighted { mode, shape }: &Sighted<'a>) -> Self {
        let conjugated = mode.action < 0;
        let sign = if conjugated { -1.0 } else { 1.0 };
        Carrier {
            frequency: sign * mode.lambda.im,
            slope: sign * mode.frequency_slope,
            component: mode.component,
            shape,
            conjugated,
            damped: mode.kind == ModeKind::Damped,
            growth: mode.lambda.re,
        }
    }

    /// The same motion as (−ω, q̄).
    fn mirrored(&self) -> Self {
        Carrier {
            frequency: -self.frequency,
            slope: -self.slope,
            conjugated: !self.conjugated,
            ..*self
        }
    }

    /// Cost of taking both for one mode, and how alike their shapes are.
    fn cost(&self, other: &Carrier<'_>, step: f64, height: f64) -> (f64, f64) {
        if self.component != other.component {
            return (NEVER, 0.0);
        }
        let direct = self.cost_as_is(other, step, height);
        if !self.damped {
            return direct;
        }
        // The action of two damped modes that have all but merged is rounding.
        let turned = self.mirrored().cost_as_is(other, step, height);
        if turned.0 < direct.0 { turned } else { direct }
    }

    fn cost_as_is(&self, other: &Carrier<'_>, step: f64, height: f64) -> (f64, f64) {
        let likeness = self.likeness(other);
        let moved = other.frequency - self.frequency;
        // Next to a merging the slope of a frequency has no bound, and one end says more.
        let slopes = [self.slope, other.slope, 0.5 * (self.slope + other.slope)];
        // Of two damped modes that have met the slope, which is that without damping, says nothing.
        let level = self.damped.then_some(0.0);
        let off = slopes
            .into_iter()
            .chain(level)
            .map(|slope| (moved - slope * step).abs());
        let off = off.fold(f64::INFINITY, f64::min) / height;
        let regrown = match self.damped {
            true => REGROWN * self.regrown(other, height),
            false => 0.0,
        };
        (1.0 - likeness + OFF * off + regrown, likeness)
    }

    /// A damped mode of real λ.
    fn has_stopped(&self, height: f64) -> bool {
        self.damped && self.frequency.abs() <= STOPPED * height
    }

    /// Difference of the growth rates relative to both, from 0 to 1; of a wave and a real λ, 1 for the λ that
    /// grows less than the wave.
    fn regrown(&self, other: &Carrier<'_>, height: f64) -> f64 {
        match [self, other].map(|c| c.has_stopped(height)) {
            [true, false] => f64::from(u8::from(self.growth < other.growth)),
            [false, true] => f64::from(u8::from(other.growth < self.growth)),
            _ => {
                let size = (self.growth.abs() + other.growth.abs()).max(f64::MIN_POSITIVE);
                (self.growth - other.growth).abs() / size
            }
        }
    }

    /// |xᴴy|², 1 for the same shape.
    fn likeness(&self, other: &Carrier<'_>) -> f64 {
        let product: c64 = match self.conjugated == other.conjugated {
            true => self.shape.adjoint() * other.shape,
            false => self.shape.transpose() * other.shape,
        };
        product.norm_sqr()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn damped(re: f64, im: f64, place: usize) -> Mode {
        Mode {
            lambda: c64::new(re, im),
            kind: ModeKind::Damped,
            frequency_slope: 0.0,
            growth_slope: c64::new(0.0, 0.0),
            action: 1,
            component: 0,
            coordinates: Col::from_fn(4, |i| c64::new(f64::from(u8::from(i == place)), 0.0)),
        }
    }

    /// A damped mode comes to a stop below three that go on, the highest next to the top.
    #[test]
    fn of_two_real_eigenvalues_the_growing_one_carries_on_and_the_waves_above_go_on() {
        let waves = || [(40.0, 1), (70.0, 2), (97.0, 3)].map(|(im, k)| damped(-0.1, im, k));
        let before: Vec<Mode> = [damped(-0.1, 0.5, 0)].into_iter().chain(waves()).collect();
        let real = [damped(0.4, 0.0, 0), damped(-0.6, 0.0, 0)];
        let after: Vec<Mode> = real.into_iter().chain(waves()).collect();
        let seen = [&before, &after].map(|modes| Sighted::of_modes(modes));
        let pairs = |found: Vec<Match>| -> Vec<(usize, usize)> {
            found.iter().map(|m| (m.before, m.after)).collect()
        };
        let found = pairs(match_modes([&seen[0], &seen[1]], 1.0, 100.0));
        assert_eq!(found.len(), 4);
        assert_eq!(found, [(0, 0), (1, 2), (2, 3), (3, 4)]);
        let back = pairs(match_modes([&seen[1], &seen[0]], -1.0, 100.0));
        assert_eq!(back, [(0, 0), (2, 1), (3, 2), (4, 3)]);
    }
}
