//! Modes at two neighbouring speeds that belong to one branch.
//!
//! An eigenvalue λ(Ω) with its slope is expected at λ + λ′ΔΩ. Of two waves that cross between the speeds each therefore keeps its
//! branch. Modes without damping are compared in the form of positive action: a reflected wave (λ, q) is the same motion as (λ̄, q̄),
//! so that a backward wave passes through its critical speed as any other value, and the waves of a flutter band, which have opposite
//! signs, become the growing and the decaying mode.

use faer::c64;

use crate::modes::{Mode, ModeKind, nearest_pairs};

/// Share of the height below its top within which a branch may end or begin, and change of λ beyond its slope that no branch has
/// there.
const TOP: f64 = 0.02;
/// Weight of the difference of both slopes in a step, which distinguishes two paths that cross in its middle.
const TURNED: f64 = 0.25;
/// Factor for the distance of a wave and a real λ that grows more slowly: if a wave turns into two real λ, the larger one continues
/// its branch, as in an undamped blade.
const SLOWER: f64 = 2.0;

/// Index of the mode at the higher speed that continues each mode at the lower one, over a step in rad/s. A mode has no
/// continuation only if it leaves the chart at its top, `height_rad_per_s`, or if fewer modes follow.
pub fn links(ends: [&[Mode]; 2], step: f64, height_rad_per_s: f64) -> Vec<Option<usize>> {
    let [old, new] = ends.map(|modes| modes.iter().map(Value::new).collect::<Vec<_>>());
    let passes_top = |value: &Value, step: f64| {
        let there = (value.lambda + value.slope * step).im.abs();
        there.max(value.lambda.im.abs()) >= (1.0 - TOP) * height_rad_per_s
    };
    nearest_pairs([old.len(), new.len()], |i, k| {
        let (x, y) = (&old[i], &new[k]);
        let distance = x.distance(y, step)?;
        let are_others =
            passes_top(x, step) && passes_top(y, -step) && distance > TOP * height_rad_per_s;
        (!are_others).then_some(distance)
    })
}

/// The links of a step are certain if exchanging any two of them makes their distances this many times as large.
const CERTAIN: f64 = 4.0;

/// Whether the links of a step are certain: over a shorter one slopes tell waves apart that cross or run side by side.
pub fn are_certain(ends: [&[Mode]; 2], step: f64, links: &[Option<usize>]) -> bool {
    let [old, new] = ends.map(|modes| modes.iter().map(Value::new).collect::<Vec<_>>());
    let linked: Vec<(&Value, &Value)> = old
        .iter()
        .zip(links)
        .filter_map(|(value, next)| Some((value, &new[(*next)?])))
        .collect();
    let distance = |x: &Value, y: &Value| x.distance(y, step).unwrap_or(f64::INFINITY);
    let pairs =
        (0..linked.len()).flat_map(|i| (0..i).map(|k| (linked[i], linked[k])).collect::<Vec<_>>());
    let mut pairs = pairs.filter(|((x, _), (y, _))| x.component == y.component);
    pairs.all(|((x, to_x), (y, to_y))| {
        let exchanged = distance(x, to_y) + distance(y, to_x);
        CERTAIN * (distance(x, to_x) + distance(y, to_y)) <= exchanged
    })
}

/// λ of a mode in the form of positive action, with its slope.
struct Value {
    lambda: c64,
    slope: c64,
    component: usize,
    is_damped: bool,
}

impl Value {
    fn new(mode: &Mode) -> Self {
        let is_damped = mode.kind == ModeKind::Damped;
        // Next to a coalescence the action of a damped mode may have either sign.
        let turned = |z: c64| {
            if mode.action < 0 && !is_damped {
                z.conj()
            } else {
                z
            }
        };
        Value {
            lambda: turned(mode.lambda),
            slope: turned(mode.slope),
            component: mode.component,
            is_damped,
        }
    }

    /// Difference of another value from the one expected after a step, with that of the slopes. `None` for modes of different
    /// components, which act on each other at no speed.
    fn distance(&self, other: &Value, step: f64) -> Option<f64> {
        // Next to a coalescence slopes are unbounded, so that the slope at one end of the step predicts the change better than
        // that at the other.
        let slopes = [self.slope, other.slope, 0.5 * (self.slope + other.slope)];
        let moved = other.lambda - self.lambda;
        let off = slopes.map(|slope| (moved - slope * step).norm());
        let least = off.into_iter().fold(moved.norm(), f64::min);
        let turned = TURNED * step.abs() * (self.slope - other.slope).norm();
        let factor = if self.turns_into_slower(other) {
            SLOWER
        } else {
            1.0
        };
        (self.component == other.component).then_some(factor * (least + turned))
    }

    /// Whether one value is a wave and the other one a real λ that grows more slowly.
    fn turns_into_slower(&self, other: &Value) -> bool {
        let is_real = |value: &Value| value.is_damped && value.lambda.im == 0.0;
        match [self, other].map(is_real) {
            [true, false] => self.lambda.re < other.lambda.re,
            [false, true] => other.lambda.re < self.lambda.re,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use faer::Col;

    use super::*;

    fn mode(kind: ModeKind, lambda: (f64, f64), slope: (f64, f64)) -> Mode {
        Mode {
            lambda: c64::new(lambda.0, lambda.1),
            kind,
            slope: c64::new(slope.0, slope.1),
            action: if matches!(kind, ModeKind::Negative | ModeKind::Decaying) {
                -1
            } else {
                1
            },
            component: 0,
            coordinates: Col::zeros(0),
        }
    }

    fn found(before: &[Mode], after: &[Mode], step: f64) -> Vec<Option<usize>> {
        links([before, after], step, 100.0)
    }

    /// A damped mode stops oscillating below three others, the highest next to the top.
    #[test]
    fn the_larger_of_two_real_eigenvalues_continues_the_branch_of_their_wave() {
        let damped = |re: f64, im: f64| mode(ModeKind::Damped, (re, im), (0.0, 0.0));
        let waves = || [40.0, 70.0, 97.0].map(|im| damped(-0.1, im));
        let before: Vec<Mode> = [damped(-0.1, 0.5)].into_iter().chain(waves()).collect();
        for first in [0, 1] {
            let mut real = [damped(0.4, 0.0), damped(-0.6, 0.0)];
            real.swap(0, first);
            let after: Vec<Mode> = real.into_iter().chain(waves()).collect();
            let on = [first, 2, 3, 4].map(Some);
            assert_eq!(found(&before, &after, 1.0), on);
            let mut back = vec![None, None, Some(1), Some(2), Some(3)];
            back[first] = Some(0);
            assert_eq!(found(&after, &before, -1.0), back);
        }
    }

    /// Waves of slopes 1 and −1 cross in the middle of the step.
    #[test]
    fn waves_that_cross_keep_their_slopes() {
        let wave = |im: f64, slope: f64| mode(ModeKind::Positive, (0.0, im), (0.0, slope));
        let before = [wave(50.0, 1.0), wave(52.0, -1.0)];
        let after = [wave(50.0, -1.0), wave(52.0, 1.0)];
        assert_eq!(found(&before, &after, 2.0), [Some(1), Some(0)]);
    }

    /// A forward and a reflected wave coalesce: λ = 30i ± √(Ω − 9) beyond Ω = 9.
    #[test]
    fn the_wave_of_positive_sign_becomes_the_growing_mode() {
        let before = [
            mode(ModeKind::Negative, (0.0, 29.0), (0.0, 0.5)),
            mode(ModeKind::Positive, (0.0, 31.0), (0.0, -0.5)),
        ];
        let after = [
            mode(ModeKind::Decaying, (-1.0, 30.0), (-0.5, 0.0)),
            mode(ModeKind::Flutter, (1.0, 30.0), (0.5, 0.0)),
        ];
        assert_eq!(found(&before, &after, 2.0), [Some(0), Some(1)]);
    }

    /// A backward wave of a free blade, ω = |80 − 4Ω|, stands still at Ω = 20.
    #[test]
    fn a_backward_wave_becomes_the_reflected_one() {
        let before = [
            mode(ModeKind::Positive, (0.0, 2.0), (0.0, -4.0)),
            mode(ModeKind::Positive, (0.0, 3.0), (0.0, 0.1)),
        ];
        let after = [
            mode(ModeKind::Negative, (0.0, 2.0), (0.0, 4.0)),
            mode(ModeKind::Positive, (0.0, 3.1), (0.0, 0.1)),
        ];
        assert_eq!(found(&before, &after, 1.0), [Some(0), Some(1)]);
    }

    /// One wave leaves the chart and another one enters it.
    #[test]
    fn a_branch_ends_at_the_top_where_another_begins() {
        let wave = |im: f64, slope: f64| mode(ModeKind::Positive, (0.0, im), (0.0, slope));
        assert_eq!(found(&[wave(99.0, 5.0)], &[wave(96.0, -5.0)], 1.0), [None]);
    }
}
