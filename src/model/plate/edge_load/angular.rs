//! Integrals of products of three waves around the circle.

use std::f64::consts::FRAC_PI_2;

/// Phase of a wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The wave cos nθ.
    Cosine,
    /// The wave sin nθ.
    Sine,
}

/// The function factor · cos nθ or factor · sin nθ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Number n of waves around the circle.
    pub order: usize,
    pub phase: Phase,
    pub factor: f64,
}

impl Wave {
    pub fn new(order: usize, phase: Phase) -> Self {
        Wave {
            order,
            phase,
            factor: 1.0,
        }
    }

    /// Derivative ∂/∂θ of the function.
    pub fn derivative(self) -> Self {
        let n = self.order as f64;
        let (phase, factor) = match self.phase {
            Phase::Cosine => (Phase::Sine, -n),
            Phase::Sine => (Phase::Cosine, n),
        };
        Wave {
            phase,
            factor: factor * self.factor,
            ..self
        }
    }
}

/// Integral ∫ f g k dθ over the circle, exactly: the product is a sum of waves, of which each choice of signs with
/// ±n_f ± n_g = n_k contributes ±π/2.
pub fn triple_product(f: Wave, g: Wave, k: Wave) -> f64 {
    let is_sine = [f, g, k].map(|wave| wave.phase == Phase::Sine);
    let [order_f, order_g, order_k] = [f, g, k].map(|wave| wave.order as i64);
    let mut sum: i64 = 0;
    for sign_f in [1, -1] {
        for sign_g in [1, -1] {
            if sign_f * order_f + sign_g * order_g == order_k {
                sum += match is_sine {
                    [false, false, false] => 1,
                    [true, true, false] => -sign_f * sign_g,
                    [true, false, true] => sign_f,
                    [false, true, true] => sign_g,
                    _ => 0,
                };
            }
        }
    }
    FRAC_PI_2 * f.factor * g.factor * k.factor * sum as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The trapezoidal rule is exact for these trigonometric polynomials.
    #[test]
    fn products_agree_with_the_trapezoidal_rule() {
        let waves = |order| [Phase::Cosine, Phase::Sine].map(|phase| Wave::new(order, phase));
        let value = |wave: Wave, angle: f64| {
            let (sin, cos) = (wave.order as f64 * angle).sin_cos();
            wave.factor * if wave.phase == Phase::Sine { sin } else { cos }
        };
        let points = 64;
        let spacing = std::f64::consts::TAU / f64::from(points);
        for (n, m, l) in [
            (0, 0, 0),
            (2, 3, 5),
            (3, 2, 1),
            (4, 0, 4),
            (0, 3, 3),
            (2, 2, 4),
            (1, 2, 5),
        ] {
            for f in waves(n).into_iter().chain(waves(n).map(Wave::derivative)) {
                for g in waves(m) {
                    for k in waves(l) {
                        let sum: f64 = (0..points)
                            .map(|i| f64::from(i) * spacing)
                            .map(|angle| value(f, angle) * value(g, angle) * value(k, angle))
                            .sum();
                        let error = (triple_product(f, g, k) - sum * spacing).abs();
                        assert!(error < 1e-13, "{f:?} {g:?} {k:?}: {error}");
                    }
                }
            }
        }
    }
}
