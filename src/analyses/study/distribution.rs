//! Distributions: from a uniform number between 0 and 1 to a value.

use statrs::distribution::{ContinuousCDF, Normal};

use super::file::{DistributionFile, StudyError};
use crate::model::scene::RefusedValue;
use crate::page::text::shown;

/// Range of the truncation, in standard deviations: a smaller one makes a normal distribution nearly uniform, a larger
/// one has no effect.
const TRUNCATION: (f64, f64) = (0.1, 8.0);
/// Largest number of listed values.
const MAX_VALUES: usize = 10_000;

/// A validated distribution of a number, in the unit of the number.
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Uniform between two values.
    Uniform(f64, f64),
    /// Normal and truncated: mean, standard deviation, share of the untruncated distribution below the lower
    /// limit.
    Normal(f64, f64, f64),
    /// Every value of a list.
    Grid(Vec<f64>),
}

impl Distribution {
    /// Validates the distribution of a number whose value in the scene is `nominal`; `key` is the path of the
    /// distribution in the study.
    pub fn new(file: &DistributionFile, nominal: f64, key: &str) -> Result<Self, StudyError> {
        match file {
            DistributionFile::Tolerance { plus_minus } => {
                let deviation = positive(&format!("{key}.plus_minus"), *plus_minus)?;
                Ok(Distribution::Uniform(
                    nominal - deviation,
                    nominal + deviation,
                ))
            }
            DistributionFile::Uniform { from, to } if from < to => {
                Ok(Distribution::Uniform(*from, *to))
            }
            DistributionFile::Uniform { from, to } => {
                let allowed = format!("above from, {}", shown(*from));
                let remedy = "exchange them, or leave a number that does not vary out of the study";
                Err(RefusedValue::new(format!("{key}.to"), *to, allowed, remedy).into())
            }
            DistributionFile::Normal {
                mean,
                standard_deviation,
                truncated_at_deviations,
            } => {
                let spread = positive(&format!("{key}.standard_deviation"), *standard_deviation)?;
                let cut = *truncated_at_deviations;
                if !(TRUNCATION.0..=TRUNCATION.1).contains(&cut) {
                    let key = format!("{key}.truncated_at_deviations");
                    let allowed = format!("between {} and {}", TRUNCATION.0, TRUNCATION.1);
                    let remedy = "3 leaves 0.3 % out";
                    return Err(RefusedValue::new(key, cut.to_string(), allowed, remedy).into());
                }
                let mean = mean.unwrap_or(nominal);
                Ok(Distribution::Normal(
                    mean,
                    spread,
                    Normal::standard().cdf(-cut),
                ))
            }
            DistributionFile::Grid { values } => grid(values, key),
        }
    }

    /// The quantile of `share`, between 0 and 1; for a list of values, the first value.
    pub fn at(&self, share: f64) -> f64 {
        match self {
            Distribution::Uniform(from, to) => from + share * (to - from),
            Distribution::Normal(mean, spread, cut) => {
                let within = cut + share * (1.0 - 2.0 * cut);
                mean + spread * Normal::standard().inverse_cdf(within)
            }
            Distribution::Grid(values) => values[0],
        }
    }
}

fn positive(key: &str, value: f64) -> Result<f64, StudyError> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    let remedy = "give it in the unit of the number, or leave a number that does not vary out";
    Err(RefusedValue::new(key, value.to_string(), "above 0", remedy).into())
}

fn grid(values: &[f64], key: &str) -> Result<Distribution, StudyError> {
    let repeated = (1..values.len()).find(|k| values[..*k].contains(&values[*k]));
    let refuse = |value: String, allowed: String| {
        let key = format!("{key}.values");
        RefusedValue::new(key, value, allowed, "list each value once").into()
    };
    if values.is_empty() || values.len() > MAX_VALUES {
        let count = format!("a list of {}", values.len());
        return Err(refuse(count, format!("of 1 to {MAX_VALUES} values")));
    }
    match repeated {
        Some(k) => {
            let twice = format!("a list with {} twice", shown(values[k]));
            Err(refuse(twice, "of different values".into()))
        }
        None => Ok(Distribution::Grid(values.to_vec())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distribution(json: &str) -> Result<Distribution, StudyError> {
        Distribution::new(&serde_json::from_str(json).unwrap(), 10.0, "here")
    }

    /// Source: Φ⁻¹(0.75) = 0.67448975019608171, Φ(−2) = 0.022750131948179195.
    #[test]
    fn shares_are_those_of_the_truncated_normal_distribution() {
        let wide = distribution(
            r#"{"kind": "normal", "standard_deviation": 2, "truncated_at_deviations": 8}"#,
        );
        let quartile = wide.unwrap().at(0.75);
        let exact = 10.0 + 2.0 * 0.674_489_750_196_081_7;
        assert!((quartile - exact).abs() < 1e-12, "{quartile}");
        let cut = distribution(
            r#"{"kind": "normal", "mean": 0, "standard_deviation": 1, "truncated_at_deviations": 2}"#,
        )
        .unwrap();
        // The library's Φ has ten digits; tolerances are known to three.
        for (share, exact) in [(0.0, -2.0), (1.0, 2.0)] {
            let error = cut.at(share) - exact;
            assert!(error.abs() < 1e-9, "{share}: {error:e}");
        }
        let below = 0.022_750_131_948_179_195;
        // The share of the truncated distribution below −σ follows from Φ(−1) = 0.15865525393145707.
        let share = (0.158_655_253_931_457_07 - below) / (1.0 - 2.0 * below);
        let error = cut.at(share) + 1.0;
        assert!(error.abs() < 1e-9, "{error:e}");
    }

    #[test]
    fn a_tolerance_lies_about_the_value_of_the_scene() {
        let even = distribution(r#"{"kind": "tolerance", "plus_minus": 0.5}"#).unwrap();
        assert_eq!(
            [even.at(0.0), even.at(0.5), even.at(1.0)],
            [9.5, 10.0, 10.5]
        );
    }

    #[test]
    fn invalid_distributions_are_refused_by_key() {
        for (json, key) in [
            (
                r#"{"kind": "tolerance", "plus_minus": 0}"#,
                "here.plus_minus",
            ),
            (r#"{"kind": "uniform", "from": 2, "to": 2}"#, "here.to"),
            (
                r#"{"kind": "normal", "standard_deviation": -1}"#,
                "here.standard_deviation",
            ),
            (
                r#"{"kind": "normal", "standard_deviation": 1, "truncated_at_deviations": 9}"#,
                "here.truncated_at_deviations",
            ),
            (r#"{"kind": "grid", "values": []}"#, "here.values"),
            (r#"{"kind": "grid", "values": [1, 2, 1]}"#, "here.values"),
        ] {
            let error = distribution(json).unwrap_err().to_string();
            assert!(error.starts_with(key), "{error}");
        }
    }
}
