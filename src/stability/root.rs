//! The zero of a function between two places at which its signs differ.

use std::convert::Infallible;

/// A look at the function: where, its value there, and what else the caller wants of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look<P> {
    /// Place.
    pub at: f64,
    /// f.
    pub value: f64,
    /// What was found there.
    pub point: P,
}

/// False position converges on one side only where the function is bent; the Illinois rule and
/// a bisection now and then bound the number of looks whatever its shape.
const BISECTED: usize = 4;
/// Bisections alone would reach any tolerance above rounding with as many.
const MOST_LOOKS: usize = 4 * 53;
/// A step of false position stays so far from both ends, as a share of the interval.
const FROM_END: f64 = 1e-3;

/// The look next to a zero, by the Illinois variant of false position (Dowell and Jarratt,
/// BIT 11, 1971) with safeguards. `look` is given the two ends and the share of the way between
/// them. Ends of one sign give the one of the smaller value.
///
/// It ends where the interval or a step is below `tolerance`, a relative one of the place.
///
/// # Errors
/// Those of `look`.
pub fn bracketed<P: Copy, E>(
    ends: [Look<P>; 2],
    tolerance: f64,
    mut look: impl FnMut([P; 2], f64) -> Result<Look<P>, E>,
) -> Result<Look<P>, E> {
    let [mut low, mut high] = ends;
    let mut best = if low.value.abs() < high.value.abs() {
        low
    } else {
        high
    };
    if (low.value < 0.0) == (high.value < 0.0) {
        return Ok(best);
    }
    // The values that false position sees: an end that stays counts half.
    let (mut at_low, mut at_high) = (low.value, high.value);
    for step in 1..=MOST_LOOKS {
        if (high.at - low.at).abs() <= tolerance * high.at.abs() || best.value == 0.0 {
            break;
        }
        let share = match step % BISECTED == 0 {
            true => 0.5,
            false => (at_low / (at_low - at_high)).clamp(FROM_END, 1.0 - FROM_END),
        };
        let found = look([low.point, high.point], share)?;
        let moved = (found.at - best.at).abs();
        if found.value.abs() <= best.value.abs() {
            best = found;
        }
        if (found.value < 0.0) == (high.value < 0.0) {
            (high, at_high) = (found, found.value);
            at_low *= 0.5;
        } else {
            (low, at_low) = (found, found.value);
            at_high *= 0.5;
        }
        if moved <= tolerance * found.at.abs() {
            break;
        }
    }
    Ok(best)
}

/// The zero on [0, 1] of a function that costs nothing, to rounding. Ends of one sign give the
/// end of the smaller value.
pub fn share_of_zero(f: impl Fn(f64) -> f64) -> f64 {
    let at = |share: f64| Look {
        at: share,
        value: f(share),
        point: share,
    };
    let look = |[low, high]: [f64; 2], share: f64| Ok(at(low + share * (high - low)));
    let found: Result<_, Infallible> = bracketed([at(0.0), at(1.0)], f64::EPSILON, look);
    match found {
        Ok(look) => look.at,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_of_bent_functions_are_found_to_rounding() {
        let root = |f: fn(f64) -> f64, exact: f64| {
            let found = share_of_zero(f);
            assert!((found - exact).abs() < 1e-14, "{found} {exact}");
        };
        root(|x| x * x - 0.5, 0.5_f64.sqrt());
        root(|x| 0.25 - x.powi(9), 0.25_f64.powf(1.0 / 9.0));
        root(|x| (40.0 * (x - 0.3)).exp() - 1.0, 0.3);
        root(|x| x - 1.0, 1.0);
        root(|x| x, 0.0);
    }

    /// A step has no value near zero: the looks are bounded and end at the step.
    #[test]
    fn a_jump_is_found_like_a_zero() {
        let found = share_of_zero(|x| if x < 0.7 { -3.0 } else { 1.0 });
        assert!((found - 0.7).abs() < 1e-14, "{found}");
    }

    #[test]
    fn ends_of_one_sign_give_the_nearer_one() {
        assert_eq!(share_of_zero(|x| 1.0 + x), 0.0);
        assert_eq!(share_of_zero(|x| 2.0 - x), 1.0);
    }

    #[test]
    fn smooth_zeros_take_few_looks() {
        let mut looks = 0;
        let at = |x: f64| Look {
            at: x,
            value: x.cos() - x,
            point: x,
        };
        let found: Result<_, Infallible> =
            bracketed([at(0.0), at(1.0)], 1e-10, |[low, high], share| {
                looks += 1;
                Ok(at(low + share * (high - low)))
            });
        let Ok(found) = found;
        assert!((found.at - 0.739_085_133_215_160_6).abs() < 1e-10);
        assert!(looks <= 10, "{looks}");
    }
}
