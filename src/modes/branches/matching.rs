//! Assignment of the modes at one speed to those at the next.

use faer::{Col, Mat, c64};

use super::assignment::cheapest;
use crate::modes::{Mode, ModeKind, NamedMode};

/// A mode at each of two speeds that belong to one branch.
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
    /// Modes of a chart.
    pub fn of_named(modes: &'a [NamedMode]) -> Vec<Self> {
        modes
            .iter()
            .map(|m| Sighted {
                mode: &m.mode,
                shape: &m.mode.coordinates,
            })
            .collect()
    }
}

/// Weight of a frequency difference as large as the chart's height, relative to completely different shapes:
/// the shape decides between neighbours, and no branch jumps across the chart.
const OFF: f64 = 4.0;
/// Cost of a branch that ends or begins at the top of the chart, or of a damped one at zero frequency.
const AT_EDGE: f64 = 0.5;
/// Cost of a branch that ends or begins elsewhere, which no eigenvalue does.
const INSIDE: f64 = 20.0;
/// Share of the height that counts as its top, in addition to the change of a frequency in one step.
const TOP: f64 = 0.02;
/// Frequencies below this share of the height belong to real λ, or to a free blade that drifts in rotating
/// air.
const STOPPED: f64 = 1e-6;
/// Weight of the difference of growth rates, for damped modes. Two modes that have coalesced have conjugate
/// shapes and equal frequencies, so that only growth distinguishes them. If a wave turns into two real λ, the
/// larger one continues its branch, as in an undamped blade.
const REGROWN: f64 = 0.2;
/// Cost of a pair of modes of different components, which never belong to one branch.
const NEVER: f64 = 1e3;

/// Pairs of least total cost for the modes at two speeds that differ by `step`, in rad/s. A mode has no partner
/// only if it leaves or enters the chart at its top, `height_rad_per_s`, or if one list is longer.
pub fn match_modes(
    [before, after]: [&[Sighted<'_>]; 2],
    step: f64,
    height_rad_per_s: f64,
) -> Vec<Match> {
    let old: Vec<Carrier> = before.iter().map(Carrier::new).collect();
    let new: Vec<Carrier> = after.iter().map(Carrier::new).collect();
    let alike = Likenesses::new([before, after]);
    let height = height_rad_per_s.max(f64::MIN_POSITIVE);
    // An unpaired mode costs less if its frequency, extrapolated over the step, reaches the top of the chart,
    // or if it has stopped oscillating: a damped mode that stops turns into two real λ, one of which has no
    // partner.
    let leaving = |c: &Carrier, step: f64| {
        let there = (c.frequency + c.slope * step).abs().max(c.frequency.abs());
        if there >= (1.0 - TOP) * height || c.has_stopped(height) {
            AT_EDGE
        } else {
            INSIDE
        }
    };
    let size = old.len() + new.len();
    let mut costs = vec![vec![0.0; size]; size];
    let mut likeness = vec![vec![0.0; new.len()]; old.len()];
    for (i, x) in old.iter().enumerate() {
        for (k, y) in new.iter().enumerate() {
            let likeness_of = |is_mirrored| alike.of(i, k, is_mirrored);
            (costs[i][k], likeness[i][k]) = x.cost(y, step, height, likeness_of);
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

/// A mode converted to positive action.
struct Carrier {
    frequency: f64,
    slope: f64,
    component: usize,
    conjugated: bool,
    damped: bool,
    growth: f64,
}

impl Carrier {
    fn new(&Sighted { mode, .. }: &Sighted<'_>) -> Self {
        let conjugated = mode.action < 0;
        let sign = if conjugated { -1.0 } else { 1.0 };
        Carrier {
            frequency: sign * mode.lambda.im,
            slope: sign * mode.frequency_slope,
            component: mode.component,
            conjugated,
            damped: mode.kind == ModeKind::Damped,
            growth: mode.lambda.re,
        }
    }

    /// The same motion, written as (−ω, q̄).
    fn mirrored(&self) -> Self {
        Carrier {
            frequency: -self.frequency,
            slope: -self.slope,
            conjugated: !self.conjugated,
            ..*self
        }
    }

    /// Cost of the pair of two modes x and y, and the likeness of their shapes. The function gives the
    /// likeness of x and y, or of x̄ and y for `true`.
    fn cost(
        &self,
        other: &Carrier,
        step: f64,
        height: f64,
        likeness: impl Fn(bool) -> f64,
    ) -> (f64, f64) {
        if self.component != other.component {
            return (NEVER, 0.0);
        }
        let alike = |x: &Carrier| likeness(x.conjugated != other.conjugated);
        let direct = self.cost_as_is(other, step, height, alike(self));
        if !self.damped {
            return direct;
        }
        // Near a coalescence the sign of the action of a damped mode depends on rounding, so that both signs
        // are tried.
        let mirrored = self.mirrored();
        let turned = mirrored.cost_as_is(other, step, height, alike(&mirrored));
        if turned.0 < direct.0 { turned } else { direct }
    }

    fn cost_as_is(&self, other: &Carrier, step: f64, height: f64, likeness: f64) -> (f64, f64) {
        let moved = other.frequency - self.frequency;
        // Next to a coalescence the slope of a frequency is unbounded, so that the slope at the other end of
        // the step predicts the change better.
        let slopes = [self.slope, other.slope, 0.5 * (self.slope + other.slope)];
        // The slopes neglect damping and are wrong for two damped modes that have coalesced, so that a slope
        // of zero is tried too.
        let level = self.damped.then_some(0.0);
        let off = slopes
            .into_iter()
            .chain(level)
            .map(|slope| (moved - slope * step).abs())
            .fold(f64::INFINITY, f64::min)
            / height;
        let regrown = if self.damped {
            REGROWN * self.regrown(other, height)
        } else {
            0.0
        };
        (1.0 - likeness + OFF * off + regrown, likeness)
    }

    /// Whether a damped mode has a real λ.
    fn has_stopped(&self, height: f64) -> bool {
        self.damped && self.frequency.abs() <= STOPPED * height
    }

    /// Relative difference of the growth rates, from 0 to 1; for a wave and a real λ, 1 if the real one grows
    /// less than the wave, otherwise 0.
    fn regrown(&self, other: &Carrier, height: f64) -> f64 {
        match [self, other].map(|c| c.has_stopped(height)) {
            [true, false] => f64::from(u8::from(self.growth < other.growth)),
            [false, true] => f64::from(u8::from(other.growth < self.growth)),
            _ => {
                let size = (self.growth.abs() + other.growth.abs()).max(f64::MIN_POSITIVE);
                (self.growth - other.growth).abs() / size
            }
        }
    }
}

/// |xᴴy|² and |xᵀy|² of every mode x of one speed and every mode y of another, from one product of real matrices.
struct Likenesses {
    /// (Re x, Im x)ᵀ(Re y, Im y), two rows for each x and two columns for each y.
    products: Mat<f64>,
}

impl Likenesses {
    fn new(speeds: [&[Sighted<'_>]; 2]) -> Self {
        // Modes of different components, which may have different lengths, are never compared.
        let all = speeds.iter().copied().flatten();
        let rows = all.map(|mode| mode.shape.nrows()).max().unwrap_or(0);
        let halves = |modes: &[Sighted<'_>]| {
            let mut halves = Mat::zeros(rows, 2 * modes.len());
            for (k, mode) in modes.iter().enumerate() {
                for (i, entry) in mode.shape.iter().enumerate() {
                    halves[(i, 2 * k)] = entry.re;
                    halves[(i, 2 * k + 1)] = entry.im;
                }
            }
            halves
        };
        Likenesses {
            products: halves(speeds[0]).transpose() * halves(speeds[1]),
        }
    }

    /// |xᴴy|², or |xᵀy|² if x is mirrored: 1 for the same shape.
    fn of(&self, x: usize, y: usize, is_mirrored: bool) -> f64 {
        let product = |row: usize, column: usize| self.products[(2 * x + row, 2 * y + column)];
        let sign = if is_mirrored { -1.0 } else { 1.0 };
        let re = product(0, 0) + sign * product(1, 1);
        let im = product(0, 1) - sign * product(1, 0);
        re * re + im * im
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

    /// A damped mode stops oscillating below three others, the highest next to the top.
    #[test]
    fn the_larger_of_two_real_eigenvalues_continues_the_branch_of_their_wave() {
        let waves = || [(40.0, 1), (70.0, 2), (97.0, 3)].map(|(im, k)| damped(-0.1, im, k));
        let before: Vec<Mode> = [damped(-0.1, 0.5, 0)].into_iter().chain(waves()).collect();
        let real = [damped(0.4, 0.0, 0), damped(-0.6, 0.0, 0)];
        let after: Vec<Mode> = real.into_iter().chain(waves()).collect();
        let seen = [&before, &after].map(|modes| {
            let shapes = modes.iter().map(|mode| &mode.coordinates);
            let sighted = modes
                .iter()
                .zip(shapes)
                .map(|(mode, shape)| Sighted { mode, shape });
            sighted.collect::<Vec<_>>()
        });
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
