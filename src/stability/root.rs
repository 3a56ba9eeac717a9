//! Zero of a function between two points of opposite sign.

use std::convert::Infallible;

/// Evaluation of the function: position, value, and anything else that the caller needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look<P> {
    /// Argument of the function.
    pub at: f64,
    /// Value of the function.
    pub value: f64,
    /// Further result of the evaluation.
    pub point: P,
}

/// Largest number of evaluations; bisection alone would need a quarter of it for any tolerance above rounding.
const MOST_LOOKS: usize = 4 * 53;

/// Evaluation nearest to a zero, by Chandrupatla's method: inverse quadratic interpolation where the function
/// looks smooth enough for it, bisection elsewhere (*A new hybrid quadratic/bisection algorithm for finding
/// the zero of a nonlinear function without using derivatives*, Advances in Engineering Software 28, 1997).
/// `look` receives the two ends and the share of the way from the first to the second. If both ends have the
/// same sign, the one with the smaller magnitude is returned.
///
/// Stops when the interval is below `tolerance`, relative to the position.
///
/// # Errors
/// The errors of `look`.
pub fn bracketed<P: Copy, E>(
    ends: [Look<P>; 2],
    tolerance: f64,
    mut look: impl FnMut([P; 2], f64) -> Result<Look<P>, E>,
) -> Result<Look<P>, E> {
    let [mut far, mut last] = ends;
    let nearer = |x: Look<P>, y: Look<P>| if x.value.abs() < y.value.abs() { x } else { y };
    let mut best = nearer(far, last);
    if (far.value < 0.0) == (last.value < 0.0) {
        return Ok(best);
    }
    let mut share = 0.5;
    for _ in 0..MOST_LOOKS {
        let found = look([last.point, far.point], share)?;
        // The zero stays between `last` and `far`; `before` is the end that was replaced.
        let before;
        if (found.value < 0.0) == (last.value < 0.0) {
            before = last;
        } else {
            (before, far) = (far, last);
        }
        last = found;
        best = nearer(last, far);
        let least = 0.5 * tolerance * best.at.abs() / (far.at - last.at).abs();
        if best.value == 0.0 || least.is_nan() || least > 0.5 {
            break;
        }
        share = interpolated(last, far, before).clamp(least, 1.0 - least);
    }
    Ok(best)
}

/// Share of the way from `a` to `b` at which the inverse parabola through three points is zero, or a half
/// where it may not be monotonic.
fn interpolated<P: Copy>(a: Look<P>, b: Look<P>, c: Look<P>) -> f64 {
    let xi = (a.at - b.at) / (c.at - b.at);
    let phi = (a.value - b.value) / (c.value - b.value);
    if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
        let (fa, fb, fc) = (a.value, b.value, c.value);
        let straight = fa / (fb - fa) * fc / (fb - fc);
        let bent = (c.at - a.at) / (b.at - a.at) * fa / (fc - fa) * fb / (fc - fb);
        straight + bent
    } else {
        0.5
    }
}

/// Zero on [0, 1], to rounding, of a function whose evaluation takes little time. If both ends have the same
/// sign, the one with the smaller magnitude is returned.
pub fn share_of_zero(f: impl Fn(f64) -> f64) -> f64 {
    let at = |share: f64| Look {
        at: share,
        value: f(share),
        point: share,
    };
    let look = |[low, high]: [f64; 2], share: f64| Ok(at(low + share * (high - low)));
    let found: Result<_, Infallible> = bracketed([at(0.0), at(1.0)], 2.0 * f64::EPSILON, look);
    match found {
        Ok(look) => look.at,
    }
}

/// Zero between two points of a function whose evaluation takes little time, or the position of its jump.
pub fn place_of_zero([from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let place = |share: f64| from + share * (to - from);
    place(share_of_zero(|share| f(place(share))))
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

    /// A function with a jump has no value near zero: the number of evaluations is limited, and the search
    /// ends at the jump.
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
