//! Which coalesced mode of one speed is which of another.
//!
//! A quadruple ±σ ± iω is an eigenvalue of its own as long as it lasts, so it is followed by
//! continuity, never by its rank in frequency, which changes when two quadruples pass each
//! other. σ² and ω² are smooth functions of the speed up to both ends of a band: where the two
//! waves coalesce σ² passes through zero, where two real λ coalesce ω² does.

use super::interpolation::Cubic;
use super::signature::SignedMode;
use crate::tuned::Tuned;

/// A continuation must fit this much better than any other.
const CLEARANCE: Tuned = Tuned::new("stability/matching::CLEARANCE", 0.25);
/// Largest misfit of a continuation, as a share of the growth rate: half of it would be no
/// continuation at all, and a tenth is met after a few halvings of any interval.
const LARGEST_MISFIT: Tuned = Tuned::new("stability/matching::LARGEST_MISFIT", 0.1);
/// A square that sinks below this share of its smaller end between two speeds may have passed
/// through zero there: the pair may have split and coalesced again.
const LEAST_DIP: Tuned = Tuned::new("stability/matching::LEAST_DIP", 0.25);

/// How the quadruples of two speeds belong together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Matching {
    /// Index at the first and at the second speed.
    pub pairs: Vec<(usize, usize)>,
    /// Those of the first speed that end before the second.
    pub ended: Vec<usize>,
    /// Those of the second speed that begin after the first.
    pub begun: Vec<usize>,
    /// Whether no pair may have split and coalesced again in between, and no other matching
    /// is nearly as good.
    pub is_certain: bool,
}

/// σ², or ω², over the way from one speed to another.
fn square(ends: [(f64, f64); 2], width: f64) -> Cubic {
    Cubic {
        values: ends.map(|(value, _)| value * value),
        slopes: ends.map(|(value, slope)| 2.0 * value * slope * width),
    }
}

fn squares(a: &SignedMode, b: &SignedMode, width: f64) -> [Cubic; 2] {
    [
        square([a, b].map(|m| (m.lambda.re, m.slope.re)), width),
        square([a, b].map(|m| (m.lambda.im, m.slope.im)), width),
    ]
}

/// What the mean of both slopes misses of the way from one to the other, in 1/s.
fn misfit(a: &SignedMode, b: &SignedMode, width: f64) -> f64 {
    let sums = [a.lambda.re + b.lambda.re, a.lambda.im + b.lambda.im];
    let missed = |(square, sum): (Cubic, f64)| {
        let Cubic {
            values: [from, to],
            slopes: [first, last],
        } = square;
        (to - from - 0.5 * (first + last)) / sum
    };
    let [growth, frequency] = squares(a, b, width);
    let misfit = missed((growth, sums[0])).hypot(missed((frequency, sums[1])));
    if misfit.is_nan() {
        f64::INFINITY
    } else {
        misfit
    }
}

/// Matches the quadruples of two speeds, each with the one that continues it.
pub fn matched(before: &[SignedMode], after: &[SignedMode], width: f64) -> Matching {
    let misfits: Vec<Vec<f64>> = before
        .iter()
        .map(|a| after.iter().map(|b| misfit(a, b, width)).collect())
        .collect();
    let mut matching = Matching {
        is_certain: true,
        ..Matching::default()
    };
    for (i, a) in before.iter().enumerate() {
        let best = (0..after.len()).min_by(|&j, &k| misfits[i][j].total_cmp(&misfits[i][k]));
        let Some(k) = best else { continue };
        let found = misfits[i][k];
        let growth = a.lambda.re.max(after[k].lambda.re);
        if found > LARGEST_MISFIT.get() * growth {
            continue;
        }
        let in_row = (0..after.len()).filter(|&j| j != k).map(|j| misfits[i][j]);
        let in_column = (0..before.len()).filter(|&j| j != i).map(|j| misfits[j][k]);
        let next = in_row.chain(in_column).fold(f64::INFINITY, f64::min);
        matching.is_certain &= found <= CLEARANCE.get() * next && !dips(a, &after[k], width);
        if matching.pairs.iter().all(|(_, taken)| *taken != k) {
            matching.pairs.push((i, k));
        }
    }
    let ended = (0..before.len()).filter(|i| matching.pairs.iter().all(|(x, _)| x != i));
    let begun = (0..after.len()).filter(|k| matching.pairs.iter().all(|(_, x)| x != k));
    (matching.ended, matching.begun) = (ended.collect(), begun.collect());
    matching
}

/// Whether a pair may have split and coalesced again on the way.
fn dips(a: &SignedMode, b: &SignedMode, width: f64) -> bool {
    squares(a, b, width).iter().any(|square| {
        let [from, to] = square.values;
        square.lowest() < LEAST_DIP.get() * from.min(to)
    })
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::stability::signature::Sign;

    /// σ² = growth², and ω, of a quadruple whose growth and frequency change at given rates.
    fn mode(growth: f64, frequency: f64, slopes: [f64; 2]) -> SignedMode {
        SignedMode {
            sign: Sign::Quadruple,
            lambda: c64::new(growth, frequency),
            slope: c64::new(slopes[0], slopes[1]),
        }
    }

    /// One rises from 10 to 30 rad/s, the other falls from 30 to 10: they change their ranks.
    #[test]
    fn quadruples_that_pass_each_other_keep_their_names() {
        let before = [mode(2.0, 10.0, [0.0, 20.0]), mode(1.0, 30.0, [0.0, -20.0])];
        let after = [mode(1.0, 10.0, [0.0, -20.0]), mode(2.0, 30.0, [0.0, 20.0])];
        let matching = matched(&before, &after, 1.0);
        assert_eq!(matching.pairs, [(0, 1), (1, 0)]);
        assert!(matching.is_certain);
    }

    #[test]
    fn one_that_ends_and_another_that_begins_are_not_joined() {
        let before = [mode(0.5, 10.0, [-2.0, 0.0])];
        let after = [mode(0.5, 14.0, [2.0, 0.0])];
        let matching = matched(&before, &after, 1.0);
        assert_eq!((matching.ended, matching.begun), (vec![0], vec![0]));
    }

    /// σ² sinks from 1 at slope −4 and comes back: it may have been below zero.
    #[test]
    fn a_pair_that_may_have_split_on_the_way_is_doubtful() {
        let before = [mode(1.0, 10.0, [-2.0, 0.0])];
        let after = [mode(1.0, 10.0, [2.0, 0.0])];
        assert!(!matched(&before, &after, 1.0).is_certain);
        assert!(matched(&before, &after, 0.1).is_certain);
    }
}
