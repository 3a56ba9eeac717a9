//! The force of a guide pad by its transfer function.

use faer::{Mat, c64};

use crate::model::linalg::{LinalgError, real_eigenvalues};

/// A term r/(λ − p) of a transfer function; with Im p ≠ 0 together with its conjugate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoleTerm {
    /// p, in 1/s.
    pub pole: c64,
    /// r, in N/(m·s).
    pub residue: c64,
}

impl PoleTerm {
    /// Whether the pole is at zero.
    pub fn integrates(&self) -> bool {
        self.pole == c64::ZERO
    }

    /// r/p, less which the force at rest is zero; zero for a pole at zero.
    fn at_rest(&self) -> c64 {
        if self.integrates() {
            c64::ZERO
        } else {
            self.residue / self.pole
        }
    }
}

/// Force over a deflection of a pad, κ(λ) = k + cλ + Σ (r/p + r/(λ − p)) + r₀/λ, so that κ(0) = k without a pole at zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PadLaw {
    /// k, in N/m.
    pub stiffness_n_per_m: f64,
    /// c, in N·s/m.
    pub damping_n_s_per_m: f64,
    /// Terms with a pole, of each pair of conjugates the one with Im p > 0.
    pub terms: Vec<PoleTerm>,
}

/// Reason for which a transfer function has no law.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LawError {
    /// Coefficients are not finite, or too large for their poles to be found.
    #[error(transparent)]
    Poles(#[from] LinalgError),
    /// A pole is too slow or too fast.
    #[error("a root has the magnitude {per_s:.4e} 1/s")]
    Speed {
        /// Magnitude of the pole, in 1/s.
        per_s: f64,
    },
    /// A part of the law is too stiff, or not finite.
    #[error("a part has {stiffness_n_per_m:.1e} N/m")]
    Stiff {
        /// Stiffness of the part, in N/m.
        stiffness_n_per_m: f64,
    },
    /// Poles are so near to each other that their terms cancel.
    #[error("some are equal, or nearly so")]
    Cancels,
}

/// Magnitudes of poles other than zero, in 1/s. A force of a faster pole acts at once, one of a slower pole integrates.
pub const POLES_PER_S: [f64; 2] = [1e-3, 1e6];
/// Stiffness at rest and of each term, in N/m, and damping, in N·s/m. Terms larger than this would cancel all that is left of a blade.
pub const STIFFEST: f64 = 1e12;
/// Stiffness of a pad that holds the blade as an integrator does at rest: some 10⁵ times that of a blade at its rim.
const RIGID_N_PER_M: f64 = 1e10;
/// Relative error of the sum of the terms that is accepted.
const ROUNDING: f64 = 1e-9;

impl PadLaw {
    /// The force of a damper that lags: cλ/(1 + τλ) = c/τ − (c/τ²)/(λ + 1/τ).
    pub fn lagging(damping_n_s_per_m: f64, lag_s: f64) -> Self {
        PadLaw {
            stiffness_n_per_m: 0.0,
            damping_n_s_per_m: 0.0,
            terms: vec![PoleTerm {
                pole: c64::new(-1.0 / lag_s, 0.0),
                residue: c64::new(-damping_n_s_per_m / (lag_s * lag_s), 0.0),
            }],
        }
    }

    /// The law of a transfer function from its coefficients by falling powers, of which the first of the denominator is not zero. A
    /// residue is r = N(p)/D′(p).
    ///
    /// # Errors
    /// [`LawError`].
    pub fn of_transfer(numerator: &[f64], denominator: &[f64]) -> Result<Self, LawError> {
        let lead = denominator[0];
        let [numerator, monic] =
            [numerator, denominator].map(|all| all.iter().map(|c| c / lead).collect::<Vec<_>>());
        let leading = numerator.len().checked_sub(monic.len() + 1);
        let law = PadLaw {
            stiffness_n_per_m: at_rest(&numerator, &monic),
            damping_n_s_per_m: leading.map_or(0.0, |place| numerator[place]),
            terms: terms(&numerator, &monic)?,
        };
        let of_terms = law.terms.iter().map(|term| term.at_rest().norm());
        let direct = [law.stiffness_n_per_m, law.damping_n_s_per_m];
        for part in direct.into_iter().chain(of_terms) {
            let stiffness_n_per_m = part.abs();
            if part.is_nan() || stiffness_n_per_m > STIFFEST {
                return Err(LawError::Stiff { stiffness_n_per_m });
            }
        }
        let is_sum = |term: &PoleTerm| {
            let lambda = term.pole.norm().max(POLES_PER_S[0]) * c64::new(0.6, 0.8);
            let exact = value(&numerator, lambda) / value(&monic, lambda);
            let size = exact.norm().max(law.stiffness_n_per_m.abs());
            (law.at(lambda) - exact).norm() <= ROUNDING * size
        };
        if law.terms.iter().all(is_sum) {
            Ok(law)
        } else {
            Err(LawError::Cancels)
        }
    }

    /// Stiffness at rest: k, or with a pole at zero, whose force at rest has no end, that of a nearly rigid pad.
    pub fn stiffness_at_rest_n_per_m(&self) -> f64 {
        if self.terms.iter().any(PoleTerm::integrates) {
            RIGID_N_PER_M
        } else {
            self.stiffness_n_per_m
        }
    }

    /// κ(λ), in N/m.
    fn at(&self, lambda: c64) -> c64 {
        let direct = lambda * self.damping_n_s_per_m + self.stiffness_n_per_m;
        let of_term = |term: &PoleTerm| {
            let one = term.at_rest() + term.residue / (lambda - term.pole);
            if term.pole.im == 0.0 {
                one
            } else {
                let conjugate = term.residue.conj() / (lambda - term.pole.conj());
                one + term.at_rest().conj() + conjugate
            }
        };
        direct + self.terms.iter().map(of_term).sum::<c64>()
    }

    /// The poles that grow, in 1/s, of each pair the one with Im p > 0.
    pub fn growing_poles_per_s(&self) -> impl Iterator<Item = c64> {
        let poles = self.terms.iter().map(|term| term.pole);
        poles.filter(|pole| pole.re > 0.0)
    }
}

/// The terms of all poles of a transfer function with a monic denominator; a pole that a zero cancels has none.
fn terms(numerator: &[f64], monic: &[f64]) -> Result<Vec<PoleTerm>, LawError> {
    let slope = derivative(monic);
    let term = |pole: c64| PoleTerm {
        pole,
        residue: value(numerator, pole) / value(&slope, pole),
    };
    let all = poles(monic, &slope)?.into_iter().map(term);
    Ok(all.filter(|term| term.residue != c64::ZERO).collect())
}

/// The poles of a monic denominator with its derivative, of each pair the one with Im p > 0.
fn poles(monic: &[f64], slope: &[f64]) -> Result<Vec<c64>, LawError> {
    let zeros = monic.iter().rev().take_while(|c| **c == 0.0).count();
    if zeros > 1 {
        return Err(LawError::Cancels);
    }
    let mut poles = vec![c64::ZERO; zeros];
    let order = monic.len() - 1 - zeros;
    if order == 0 {
        return Ok(poles);
    }
    // In units of the mean magnitude of the poles the coefficients are alike.
    let unit = monic[order].abs().powf(1.0 / order as f64);
    let companion = Mat::from_fn(order, order, |i, k| match (i, k) {
        (0, k) => -monic[k + 1] * unit.powi(-(k as i32) - 1),
        (i, k) if i == k + 1 => 1.0,
        _ => 0.0,
    });
    for root in real_eigenvalues(companion.as_ref())? {
        let near = root * unit;
        let pole = near - value(monic, near) / value(slope, near);
        let per_s = pole.norm();
        let [slowest, fastest] = POLES_PER_S;
        // Newton's step from an exactly double pole is not a number.
        if per_s.is_nan() {
            return Err(LawError::Cancels);
        }
        if !(slowest..=fastest).contains(&per_s) {
            return Err(LawError::Speed { per_s });
        }
        if pole.im >= 0.0 {
            poles.push(pole);
        }
    }
    Ok(poles)
}

/// k of a transfer function with a monic denominator, N(0)/D(0). With D = λE it is the slope of N/E at zero, where N/E − N(0)/E(0) is
/// the rest of N/D beside the pole.
fn at_rest(numerator: &[f64], monic: &[f64]) -> f64 {
    let coefficient = |all: &[f64], power: usize| {
        let place = all.len().checked_sub(power + 1);
        place.map_or(0.0, |place| all[place])
    };
    let [n0, n1] = [0, 1].map(|power| coefficient(numerator, power));
    let [d0, d1, d2] = [0, 1, 2].map(|power| coefficient(monic, power));
    if d0 == 0.0 {
        (n1 * d1 - n0 * d2) / (d1 * d1)
    } else {
        n0 / d0
    }
}

/// The value of a polynomial, from its coefficients by falling powers.
fn value(coefficients: &[f64], lambda: c64) -> c64 {
    let next = |sum: c64, coefficient: &f64| sum * lambda + *coefficient;
    coefficients.iter().fold(c64::ZERO, next)
}

fn derivative(coefficients: &[f64]) -> Vec<f64> {
    let powers = (0..coefficients.len()).rev();
    let terms = coefficients.iter().zip(powers);
    let terms = terms.filter(|(_, power)| *power > 0);
    terms.map(|(c, power)| c * power as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// κ is the ratio of the polynomials, for proper and improper ones, real and complex poles, and any unit of the poles.
    #[test]
    fn the_law_is_the_ratio_of_the_polynomials() {
        let functions: [(&[f64], &[f64]); 6] = [
            (&[3.0], &[2.0]),
            (&[3.0, 2e4], &[1.0]),
            (&[5e3], &[1e-3, 1.0]),
            (&[1.0, 300.0, 2e6], &[1e-4, 1.0]),
            (&[2.0, 1e3, -4e5], &[1.0, 40.0, 9e4]),
            (&[1e9, 0.0, 3e12], &[1.0, 2e3, 1.5e6, 4e8, 3e10]),
        ];
        for (numerator, denominator) in functions {
            let law = PadLaw::of_transfer(numerator, denominator).unwrap();
            for (re, im) in [(0.0, 0.0), (0.0, 70.0), (-3.0, 2e3), (40.0, 0.0)] {
                let lambda = c64::new(re, im);
                let exact = value(numerator, lambda) / value(denominator, lambda);
                let error = (law.at(lambda) - exact).norm();
                assert!(
                    error <= 1e-8 * exact.norm(),
                    "{numerator:?} {lambda}: {error:e}"
                );
            }
        }
    }

    #[test]
    fn equal_poles_are_refused_and_growing_ones_are_not() {
        for double in [1e4, 1.01e4] {
            let found = PadLaw::of_transfer(&[1e5], &[1.0, 200.0, double]);
            let is_refused = matches!(found, Err(LawError::Cancels | LawError::Stiff { .. }));
            assert_eq!(is_refused, double == 1e4, "{found:?}");
        }
        let integrators = PadLaw::of_transfer(&[1e5], &[1.0, 0.0, 0.0]);
        assert_eq!(integrators, Err(LawError::Cancels));
        for denominator in [[1.0, -2.0, 1e4], [1.0, 100.0, -2e4]] {
            let law = PadLaw::of_transfer(&[1e5], &denominator).unwrap();
            assert_eq!(law.growing_poles_per_s().count(), 1, "{denominator:?}");
        }
    }

    #[test]
    fn numbers_that_overflow_and_poles_out_of_reach_are_refused() {
        let refused = |numerator: &[f64], denominator: &[f64]| {
            PadLaw::of_transfer(numerator, denominator).unwrap_err()
        };
        let stiff = |found: LawError| matches!(found, LawError::Stiff { .. });
        assert!(stiff(refused(&[1e60], &[1e-300])));
        assert!(stiff(refused(&[1e40], &[1e-3, 1.0])));
        assert!(stiff(refused(&[1e13, 0.0], &[1.0])));
        for denominator in [[1.0, 1e8], [1.0, 1e-200], [1e-60, 1e60]] {
            let found = refused(&[1e5], &denominator);
            assert!(matches!(found, LawError::Speed { .. }), "{found}");
        }
        // A pole far from the others, whose term is small beside theirs, is found as well.
        let wide = PadLaw::of_transfer(&[1.0, 2e3], &[1.0, 1e5 + 0.01, 1e3]).unwrap();
        let slow = wide
            .terms
            .iter()
            .map(|term| term.pole.re)
            .fold(f64::MIN, f64::max);
        assert!((slow + 0.01).abs() < 1e-12, "{slow}");
    }

    #[test]
    fn a_controller_that_does_nothing_is_allowed() {
        let law = PadLaw::of_transfer(&[0.0], &[1e-3, 1.0]).unwrap();
        assert_eq!(law.at(c64::new(0.0, 50.0)), c64::ZERO);
    }
}
