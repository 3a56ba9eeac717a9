//! A controller that acts on a guide pad.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::pad_law::{LawError, POLES_PER_S, PadLaw, STIFFEST};
use super::{RefusedValue, SceneError};
use crate::page::text::shown;

/// A controller, or any other element with a linear law, that presses on the blade at a pad beside the pad's spring and damper. Its
/// force is uniform over the pad, and opposes the mean deflection w of the blade over the pad, less that of the head of its arm, by the
/// transfer function κ(s) = numerator/denominator in N/m, where s is in 1/s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideControllerFile {
    /// Coefficients of the numerator, from the highest power of s to the constant. It has at most one degree more than the
    /// denominator.
    pub numerator: Vec<f64>,
    /// Coefficients of the denominator, from the highest power of s to the constant. Its roots differ; their magnitudes are 0, of an
    /// integrator, or from 1e-3 to 1e6 1/s.
    pub denominator: Vec<f64>,
}

/// Largest number of coefficients: no controller of a pad has nearly as many.
const MOST: usize = 20;

impl GuideControllerFile {
    /// The law of the controller; `of` is the path of one of its keys.
    ///
    /// # Errors
    /// [`SceneError`] that names the key.
    pub(super) fn law(&self, of: impl Fn(&str) -> String) -> Result<PadLaw, SceneError> {
        let refused = |name: &str, given: String, allowed: String, remedy: &'static str| {
            Err(RefusedValue::new(of(name), given, allowed, remedy).into())
        };
        let below = &self.denominator;
        if !(1..=MOST).contains(&below.len()) {
            let remedy = "give the coefficients of the denominator, [1] for a polynomial";
            let allowed = format!("1 to {MOST} numbers");
            return refused("denominator", count(below), allowed, remedy);
        }
        if below[0] == 0.0 {
            let remedy = "leave out the leading zero";
            return refused("denominator[0]", shown(0.0), "not zero".to_owned(), remedy);
        }
        if !(1..=below.len() + 1).contains(&self.numerator.len()) {
            let allowed = format!("1 to {} numbers, with this denominator", below.len() + 1);
            let remedy = if self.numerator.is_empty() {
                "give the coefficients of the numerator, or leave the controller out"
            } else {
                "a force in proportion to the acceleration is that of a mass; give the pad an arm with a mass"
            };
            return refused("numerator", count(&self.numerator), allowed, remedy);
        }
        PadLaw::of_transfer(&self.numerator, below).or_else(|error| {
            let [slowest, fastest] = POLES_PER_S.map(shown);
            let (list, allowed, remedy) = match error {
                LawError::Poles(_) | LawError::Stiff { .. } => (
                    ("numerator", &self.numerator),
                    format!("such that no part of the law exceeds {} N/m ({error})", shown(STIFFEST)),
                    "divide it; a pad of this stiffness is rigid",
                ),
                LawError::Speed { .. } => (
                    ("denominator", below),
                    format!("such that its roots are 0 or have magnitudes from {slowest} to {fastest} 1/s ({error})"),
                    "leave a faster pole out, because it acts at once; put a slower one at 0, because it integrates",
                ),
                LawError::Cancels => (
                    ("denominator", below),
                    format!("such that its roots differ ({error})"),
                    "move one of the equal poles by 1 %",
                ),
            };
            refused(list.0, in_words(list.1), allowed, remedy)
        })
    }
}

fn count(numbers: &[f64]) -> String {
    match numbers.len() {
        0 => "an empty list".to_owned(),
        1 => "1 number".to_owned(),
        more => format!("{more} numbers"),
    }
}

fn in_words(numbers: &[f64]) -> String {
    let all: Vec<String> = numbers.iter().map(|number| shown(*number)).collect();
    format!("[{}]", all.join(", "))
}
