//! Bessel functions of integer order and positive argument, to about fourteen digits.
//!
//! J and I follow from backward recurrences, normalized by J₀ + 2ΣJ₂ₖ = 1 and I₀ + 2ΣIₖ = eˣ (Miller); Y₀ and
//! Y₁ from Neumann's series in J; K₀ and K₁ from Kₙ(x) = ∫ exp(−x cosh t) cosh nt dt by the trapezoidal rule,
//! which converges faster than any power of its step; Y and K of higher order from forward recurrences.
//!
//! Sources: Abramowitz & Stegun, *Handbook of Mathematical Functions*, 9.1.27, 9.1.46, 9.1.88,
//! 9.6.24, 9.6.26, 9.6.37, 9.12; Trefethen & Weideman, SIAM Review 56 (2014), 385–458.

/// Euler's constant.
const GAMMA: f64 = 0.577_215_664_901_532_9;

/// Value and derivative of a function at x.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub value: f64,
    pub slope: f64,
}

/// Jₙ, Yₙ, e^{−x} Iₙ and e^{x} Kₙ. The derivatives are those of J, Y, I and K with the same factors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Four {
    pub j: Point,
    pub y: Point,
    pub scaled_i: Point,
    pub scaled_k: Point,
}

/// The four functions of order n at x > 0.
pub(super) fn four(n: usize, x: f64) -> Four {
    let bessel_j = by_backward_recurrence(n + 1, x, -1.0);
    let [y, y_next] = second_kind(n, x, &bessel_j);
    let bessel_i = by_backward_recurrence(n + 1, x, 1.0);
    let [k, k_next] = scaled_modified_second_kind(n, x);
    let share = n as f64 / x;
    // The derivative is fₙ′ = (n/x) fₙ − fₙ₊₁ for J, Y and K, and (n/x) fₙ + fₙ₊₁ for I (9.1.27, 9.6.26).
    let point = |value: f64, next: f64, sign: f64| Point {
        value,
        slope: share * value + sign * next,
    };
    Four {
        j: point(bessel_j[n], bessel_j[n + 1], -1.0),
        y: point(y, y_next, -1.0),
        scaled_i: point(bessel_i[n], bessel_i[n + 1], 1.0),
        scaled_k: point(k, k_next, -1.0),
    }
}

/// J₀, J₁, … (sign −1) or e^{−x} I₀, e^{−x} I₁, … (sign 1), by f_{m−1} = (2m/x) f_m + sign · f_{m+1}.
fn by_backward_recurrence(orders: usize, x: f64, sign: f64) -> Vec<f64> {
    // The recurrence starts at an order so far above `orders` and x that the starting values do not affect
    // the result.
    let above = (orders as f64).max(x);
    let start = 2 * ((0.5 * (above + 20.0 + (60.0 * above).sqrt())) as usize) + 2;
    let mut values = vec![0.0_f64; start + 2];
    values[start] = f64::MIN_POSITIVE;
    for m in (1..=start).rev() {
        values[m - 1] = 2.0 * m as f64 / x * values[m] + sign * values[m + 1];
        if values[m - 1].abs() > 1e200 {
            values[m - 1..]
                .iter_mut()
                .for_each(|value| *value *= 1e-200);
        }
    }
    let step = if sign < 0.0 { 2 } else { 1 };
    let rest: f64 = values[step..].iter().step_by(step).sum();
    let norm = values[0] + 2.0 * rest;
    values.iter_mut().for_each(|value| *value /= norm);
    values
}

/// Yₙ and Yₙ₊₁, from J₀, J₁, … up to orders far beyond the argument.
fn second_kind(n: usize, x: f64, bessel_j: &[f64]) -> [f64; 2] {
    let logarithm = (0.5 * x).ln() + GAMMA;
    let (mut zero, mut one) = (
        0.5 * logarithm * bessel_j[0],
        0.5 * (logarithm * bessel_j[1] - bessel_j[0] / x),
    );
    for k in 1..(bessel_j.len() - 1) / 2 {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let weight = sign / k as f64;
        zero -= weight * bessel_j[2 * k];
        // Y₁ = −Y₀′ follows from the derivative of each term of the series.
        one += 0.5 * weight * (bessel_j[2 * k - 1] - bessel_j[2 * k + 1]);
    }
    let scale = 4.0 / std::f64::consts::PI;
    forward([scale * zero, scale * one], n, x, -1.0)
}

/// e^{x} Kₙ and e^{x} Kₙ₊₁.
fn scaled_modified_second_kind(n: usize, x: f64) -> [f64; 2] {
    // For t > `end` the factor exp(−x (cosh t − 1)) of the integrand underflows.
    let end = (1.0 + 745.0 / x).acosh();
    // The step resolves the integrand, whose width in t is about 1/√x at large x.
    let step = f64::min(0.1, 0.6 / x.sqrt());
    let mut sum = [0.5, 0.5];
    for k in 1..=(end / step) as usize {
        let cosh = (k as f64 * step).cosh();
        let weight = (-x * (cosh - 1.0)).exp();
        sum[0] += weight;
        sum[1] += weight * cosh;
    }
    forward(sum.map(|value| step * value), n, x, 1.0)
}

/// Values of the orders n and n + 1 from those of 0 and 1, by f_{m+1} = (2m/x) f_m + sign · f_{m−1}.
fn forward([mut low, mut high]: [f64; 2], n: usize, x: f64, sign: f64) -> [f64; 2] {
    for m in 1..=n {
        (low, high) = (high, 2.0 * m as f64 / x * high + sign * low);
    }
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// J, Y, I, K by mpmath 1.3 with 40 digits.
    #[rustfmt::skip]
    const TABLE: [(usize, f64, [f64; 4]); 9] = [
        (0, 0.001, [0.99999975000002, -4.4714166113759, 1.00000025, 7.0236888005624]),
        (1, 0.3, [0.1483188162731, -2.2931051383885, 0.15169384000359, 3.0559920334573]),
        (2, 2.5, [0.44605905843962, -0.3813358492418, 1.2764661478192, 0.12146020627856]),
        (5, 5.25, [0.29260174978197, -0.38947071267731, 3.0243152941332, 0.022764709850133]),
        (3, 40.5, [-0.10684878771109, -0.065912061179779, 2.180835811854e16, 5.6459322153122e-19]),
        (10, 1.5, [1.474326907804e-08, -2183993.0260864, 1.63309244378e-08, 3027483.5236822]),
        (24, 30.25, [-0.059346067673582, 0.17541954003066, 98910417.610302, 1.3090589974744e-10]),
        (64, 66.5, [0.16290227919154, -0.072506423249259, 890396450221700.0, 6.0842457522932e-18]),
        (1, 250.0, [-0.043269038410331, 0.025966992185485, 9.4386044915156e106, 2.118944597814e-110]),
    ];

    #[test]
    fn values_agree_with_forty_digits() {
        for (n, x, [j, y, i, k]) in TABLE {
            let functions = four(n, x);
            let found = [
                functions.j.value,
                functions.y.value,
                functions.scaled_i.value * x.exp(),
                functions.scaled_k.value * (-x).exp(),
            ];
            for (found, expected) in found.into_iter().zip([j, y, i, k]) {
                let error = (found - expected).abs() / expected.abs();
                assert!(error < 2e-13, "{n} {x}: {found} {expected} {error:e}");
            }
        }
    }

    /// J Y′ − J′ Y = 2/πx and I K′ − I′ K = −1/x (9.1.16, 9.6.15).
    #[test]
    fn wronskians_hold() {
        for n in [0, 1, 2, 7, 30, 64] {
            for x in [0.004, 0.3, 1.0, 2.404825557695773, 9.0, 47.0, 150.0, 900.0] {
                let f = four(n, x);
                let first = f.j.value * f.y.slope - f.j.slope * f.y.value;
                let size = (f.j.value * f.y.slope).abs() + (f.j.slope * f.y.value).abs();
                let error = (first - 2.0 / (std::f64::consts::PI * x)).abs() / size;
                if size.is_finite() {
                    assert!(error < 1e-12, "J, Y of {n} at {x}: {error:e}");
                }
                let second =
                    f.scaled_i.value * f.scaled_k.slope - f.scaled_i.slope * f.scaled_k.value;
                if second.is_finite() {
                    assert!(
                        (second * x + 1.0).abs() < 1e-12,
                        "I, K of {n} at {x}: {second}"
                    );
                }
            }
        }
    }
}
