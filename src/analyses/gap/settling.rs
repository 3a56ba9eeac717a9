//! Steady states of a quantity that changes slowly, such as the temperature of a blade.
//!
//! The quantity T drifts towards an answer F(T) to itself, Ṫ ∝ F(T) − T, so that its steady states are T = F(T), stable if the slope of F
//! is below one in all directions. The iteration T ← T + ω(F(T) − T) follows this drift; with ω = 1 it would swing for ever where the
//! slope is below −1. Each ω is that for which the last two steps would have met the steady state if F were linear (B. M. Irons &
//! R. C. Tuck, *A version of the Aitken accelerator for computer iteration*, Int. J. Numer. Methods Eng. 1 (1969), 275–277); a negative
//! one would lead against the drift to an unstable state, and one is taken instead.

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// At a steady state.
    Settled,
    /// The quantity grew beyond its limit, or still grew.
    RunsAway,
    /// The drift changes its direction between two values, because the answer has a jump between them.
    Swings,
    /// The quantity drifts to values for which there is no answer.
    NoAnswer,
}

/// The last value of an iteration that has an answer.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Settling {
    pub value: Vec<f64>,
    pub end: End,
    /// Largest entry of F(T) − T, relative to that of F(T) and T.
    pub change: f64,
    /// Number of answers.
    pub repetitions: usize,
}

/// Relative change at which the iteration ends.
const CONVERGED: f64 = 1e-4;
/// Number of repetitions after which the iteration ends.
pub(super) const MOST: usize = 40;
/// Smallest and largest factor ω.
const FACTORS: (f64, f64) = (0.05, 20.0);
/// Number of times that a step to a value without an answer is halved.
const HALVINGS: usize = 6;

/// Iterates from a value to a steady state, or until an entry exceeds `limit`. `answer` gives F(T), `None` where there is none.
///
/// # Errors
/// Those of `answer`.
pub(super) fn settled<E>(
    first: Vec<f64>,
    limit: f64,
    mut answer: impl FnMut(&[f64]) -> Result<Option<Vec<f64>>, E>,
) -> Result<Settling, E> {
    let mut found = Settling {
        value: first.clone(),
        end: End::NoAnswer,
        change: f64::INFINITY,
        repetitions: 0,
    };
    let (mut next, mut factor, mut halved) = (first, 1.0, 0);
    let mut last: Option<Vec<f64>> = None;
    while found.repetitions < MOST {
        let own = if largest(&next) > limit {
            None
        } else {
            answer(&next)?
        };
        let Some(own) = own else {
            found.end = End::NoAnswer;
            if last.is_none() || halved == HALVINGS {
                break;
            }
            halved += 1;
            let pairs = next.iter().zip(&found.value);
            next = pairs.map(|(next, value)| 0.5 * (next + value)).collect();
            continue;
        };
        let drift: Vec<f64> = own
            .iter()
            .zip(&next)
            .map(|(own, next)| own - next)
            .collect();
        let size = largest(&own).max(largest(&next));
        found.change = if size > 0.0 {
            largest(&drift) / size
        } else {
            0.0
        };
        found.repetitions += 1;
        found.value = next;
        found.end = match &last {
            _ if found.change <= CONVERGED => End::Settled,
            Some(last) if product(last, &drift) < 0.0 => End::Swings,
            _ => End::RunsAway,
        };
        if found.end == End::Settled || size > limit {
            break;
        }
        if let Some(last) = &last {
            let turn: Vec<f64> = drift.iter().zip(last).map(|(new, old)| new - old).collect();
            let best = -factor * product(last, &turn) / product(&turn, &turn);
            factor = if best > 0.0 && best.is_finite() {
                best.clamp(FACTORS.0, FACTORS.1)
            } else {
                1.0
            };
        }
        let pairs = found.value.iter().zip(&drift);
        next = pairs.map(|(value, drift)| value + factor * drift).collect();
        last = Some(drift);
    }
    Ok(found)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(answer: impl Fn(f64) -> Option<f64>) -> Settling {
        let answer = |value: &[f64]| Ok::<_, ()>(answer(value[0]).map(|own| vec![own]));
        settled(vec![0.0], 1000.0, answer).unwrap()
    }

    /// Independent values: roots of linear and quartic equations. The answers to the answers would swing or settle slowly.
    #[test]
    fn a_steady_state_is_found_whatever_the_slope_below_one() {
        for slope in [-3.0, -1.0, -0.5, 0.5, 0.97] {
            let found = of(|x| Some(10.0 + slope * x));
            assert_eq!(found.end, End::Settled, "{slope} {found:?}");
            let expected = 10.0 / (1.0 - slope);
            // The last change is that of the drift, and the distance to the steady state is larger by the slope.
            let within = 1e-4 / (1.0 - slope).min(1.0);
            assert!(
                (found.value[0] / expected - 1.0).abs() < within,
                "{slope} {found:?}"
            );
            assert!(found.repetitions < 12, "{slope} {found:?}");
        }
        // x (1 + x⁴) = 40.
        let found = of(|x| Some(40.0 / (1.0 + x.powi(4))));
        let x = found.value[0];
        assert!(found.end == End::Settled && (x * (1.0 + x.powi(4)) / 40.0 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn without_a_steady_state_the_end_says_why() {
        assert_eq!(of(|x| Some(1.0 + 1.2 * x)).end, End::RunsAway);
        // The steady state −10 is unstable, and against the drift.
        assert!(of(|x| Some(1.0 + 1.1 * x)).value[0] > 10.0);
        assert_eq!(
            of(|x| Some(if x < 1.0 { 3.0 } else { 0.2 })).end,
            End::Swings
        );
        let ends = of(|x| (x < 5.0).then_some(2.0 * x + 1.0));
        assert!(
            ends.end == End::NoAnswer && (4.0..5.0).contains(&ends.value[0]),
            "{ends:?}"
        );
        assert_eq!(of(|_| None).repetitions, 0);
    }
}
