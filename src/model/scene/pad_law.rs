//! The force of a guide pad by its transfer function.

use faer::{Mat, c64};

use super::rule::refuse;
use super::{ContactLaw, GuideControllerFile, GuideFile, RefusedValue, SceneError};
use crate::model::linalg::{LinalgError, real_eigenvalues};
use crate::page::text::shown;

/// A term r/(λ − p) of a transfer function; with Im p ≠ 0 together with its conjugate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoleTerm {
    /// p, in 1/s.
    pub pole: c64,
    /// r, in N/(m·s).
    pub residue: c64,
}

/// Force over mean deflection of a pad beside its spring, κ(λ) = k + cλ + Σ r/p + Σ r/(λ − p), so that κ(0) = k.
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
    /// The poles of the denominator were not found.
    #[error(transparent)]
    Poles(#[from] LinalgError),
    /// Poles are so near to each other that the terms cancel.
    #[error("poles are equal, or nearly so: the sum of their terms is off by {error:.1e}")]
    Cancels {
        /// Relative error of the sum of the terms.
        error: f64,
    },
    /// A real pole grows. The stiffness matrix then has a negative direction that is that of the law alone.
    #[error("the pole {pole_per_s} 1/s grows without oscillating")]
    Grows {
        /// The pole, in 1/s.
        pole_per_s: f64,
    },
}

/// Relative error of the sum of the terms that is accepted.
const ROUNDING: f64 = 1e-9;

impl PadLaw {
    /// What the lag of a film changes in the force of a damper: cλ/(1 + τλ) − cλ = −cλ + c/τ − (c/τ²)/(λ + 1/τ).
    fn lagging(damping_n_s_per_m: f64, lag_s: f64) -> Self {
        PadLaw {
            stiffness_n_per_m: 0.0,
            damping_n_s_per_m: -damping_n_s_per_m,
            terms: vec![PoleTerm {
                pole: c64::new(-1.0 / lag_s, 0.0),
                residue: c64::new(-damping_n_s_per_m / (lag_s * lag_s), 0.0),
            }],
        }
    }

    /// The law of a transfer function from its coefficients by falling powers, of which the first and the last of the denominator are
    /// not zero. A residue is r = N(p)/D′(p).
    ///
    /// # Errors
    /// [`LawError`].
    fn of_transfer(numerator: &[f64], denominator: &[f64]) -> Result<Self, LawError> {
        let order = denominator.len() - 1;
        let (lead, rest) = (denominator[0], denominator[order]);
        let ratio = |coefficients: &[f64], lambda: c64| {
            value(coefficients, lambda) / value(denominator, lambda)
        };
        let leading = numerator.len().checked_sub(denominator.len() + 1);
        let mut law = PadLaw {
            stiffness_n_per_m: numerator.last().map_or(0.0, |last| last / rest),
            damping_n_s_per_m: leading.map_or(0.0, |place| numerator[place] / lead),
            terms: Vec::new(),
        };
        if order == 0 {
            return Ok(law);
        }
        // In units of the mean magnitude of the poles the coefficients are alike.
        let unit = (rest / lead).abs().powf(1.0 / order as f64);
        let companion = Mat::from_fn(order, order, |i, k| match (i, k) {
            (0, k) => -denominator[k + 1] / lead * unit.powi(-(k as i32) - 1),
            (i, k) if i == k + 1 => 1.0,
            _ => 0.0,
        });
        let slope = derivative(denominator);
        for root in real_eigenvalues(companion.as_ref())? {
            let pole = root * unit;
            let pole = pole - value(denominator, pole) / value(&slope, pole);
            let residue = value(numerator, pole) / value(&slope, pole);
            if pole.im == 0.0 && pole.re > 0.0 {
                return Err(LawError::Grows {
                    pole_per_s: pole.re,
                });
            }
            if pole.im >= 0.0 {
                law.terms.push(PoleTerm { pole, residue });
            }
        }
        let places = [0.1, 0.3, 1.0, 3.0, 10.0].map(|share| c64::new(0.0, share * unit));
        let error = places.map(|lambda| {
            let exact = ratio(numerator, lambda);
            (law.at(lambda) - exact).norm() / exact.norm().max(law.stiffness_n_per_m.abs())
        });
        let error = error.into_iter().fold(0.0, f64::max);
        // A sum that is not a number is refused, too.
        if error <= ROUNDING {
            Ok(law)
        } else {
            Err(LawError::Cancels { error })
        }
    }

    /// κ(λ), in N/m.
    fn at(&self, lambda: c64) -> c64 {
        let direct = lambda * self.damping_n_s_per_m + self.stiffness_n_per_m;
        let of_pole = |pole: c64, residue: c64| residue / pole + residue / (lambda - pole);
        let of_term = |term: &PoleTerm| {
            let one = of_pole(term.pole, term.residue);
            if term.pole.im == 0.0 {
                one
            } else {
                one + of_pole(term.pole.conj(), term.residue.conj())
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

/// The sum of the laws of the film and of the controller of a pad; `None` without both.
///
/// # Errors
/// [`SceneError`] that names the key.
pub fn law(of: &impl Fn(&str) -> String, pad: &GuideFile) -> Result<Option<PadLaw>, SceneError> {
    let mut law = None;
    if let Some(film) = pad.film {
        let damping = pad.damping_n_s_per_m;
        if damping == 0.0 {
            let allowed = "above 0 where the pad has a film";
            let remedy = "give the damping of the film, whose force lags, or leave the film out";
            return Err(refuse(&of("damping_n_s_per_m"), damping, allowed, remedy));
        }
        if pad.contact == ContactLaw::OneSided {
            let allowed = "left out where the contact is one_sided";
            let remedy = "a pad that lifts off has no film that pulls";
            return Err(refuse(&of("film.lag_s"), film.lag_s, allowed, remedy));
        }
        law = Some(PadLaw::lagging(damping, film.lag_s));
    }
    if let Some(controller) = &pad.controller {
        if pad.contact == ContactLaw::OneSided {
            let allowed = "left out where the contact is one_sided";
            let remedy = "a pad that lifts off cannot pull";
            return Err(RefusedValue::new(of("controller"), "given", allowed, remedy).into());
        }
        let lagging = law.unwrap_or_default();
        let mut controlled = controlled(of, controller)?;
        controlled.damping_n_s_per_m += lagging.damping_n_s_per_m;
        controlled.terms.extend(lagging.terms);
        law = Some(controlled);
    }
    Ok(law)
}

/// Largest degree of a denominator: poles of higher ones are not found to many digits.
const MOST_POLES: usize = 12;

fn controlled(
    of: &impl Fn(&str) -> String,
    controller: &GuideControllerFile,
) -> Result<PadLaw, SceneError> {
    let GuideControllerFile {
        numerator,
        denominator,
    } = controller;
    let refused = |name: &str, given: String, allowed: String, remedy: &'static str| {
        Err(RefusedValue::new(of(name), given, allowed, remedy).into())
    };
    let numbers = |count: usize| match count {
        0 => "an empty list".to_owned(),
        1 => "1 number".to_owned(),
        more => format!("{more} numbers"),
    };
    if !(1..=MOST_POLES + 1).contains(&denominator.len()) {
        let allowed = format!("1 to {} numbers", MOST_POLES + 1);
        let remedy = "give the coefficients of the denominator, [1] for a polynomial";
        let given = numbers(denominator.len());
        return refused("controller.denominator", given, allowed, remedy);
    }
    let last = denominator.len() - 1;
    for (place, remedy) in [
        (0, "leave out the leading zero"),
        (
            last,
            "a pole at zero integrates: at rest its force has no end; move it to a slow decay",
        ),
    ] {
        if denominator[place] == 0.0 {
            let name = format!("controller.denominator[{place}]");
            return refused(&name, "0".to_owned(), "not zero".to_owned(), remedy);
        }
    }
    if !(1..=denominator.len() + 1).contains(&numerator.len()) {
        let allowed = format!(
            "1 to {} numbers, with this denominator",
            denominator.len() + 1
        );
        let remedy = if numerator.is_empty() {
            "give the coefficients of the numerator, or leave the controller out"
        } else {
            "a force in proportion to a higher derivative than the velocity is a mass: give the arm a mass"
        };
        return refused(
            "controller.numerator",
            numbers(numerator.len()),
            allowed,
            remedy,
        );
    }
    PadLaw::of_transfer(numerator, denominator).or_else(|error| {
        let (allowed, remedy) = match error {
            LawError::Grows { pole_per_s } => (
                format!(
                    "without a real pole above 0, as {} 1/s is",
                    shown(pole_per_s)
                ),
                "the controller grows without oscillating; make it stable without the blade",
            ),
            LawError::Cancels { .. } | LawError::Poles(_) => (
                format!("with poles that differ ({error})"),
                "move one of the equal poles by 1 %",
            ),
        };
        refused(
            "controller.denominator",
            shown_list(denominator),
            allowed,
            remedy,
        )
    })
}

fn shown_list(numbers: &[f64]) -> String {
    let shown: Vec<String> = numbers.iter().map(|number| shown(*number)).collect();
    format!("[{}]", shown.join(", "))
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
    fn equal_poles_and_a_growing_real_pole_are_refused() {
        let double = PadLaw::of_transfer(&[1e5], &[1.0, 200.0, 1e4]);
        assert!(
            matches!(double, Err(LawError::Cancels { .. })),
            "{double:?}"
        );
        let growing = PadLaw::of_transfer(&[1e5], &[1.0, -200.0]);
        assert_eq!(growing, Err(LawError::Grows { pole_per_s: 200.0 }));
        let pair = PadLaw::of_transfer(&[1e5], &[1.0, -2.0, 1e4]).unwrap();
        assert_eq!(pair.growing_poles_per_s().count(), 1);
    }
}
