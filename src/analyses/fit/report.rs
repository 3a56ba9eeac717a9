//! `fit.json`: the calibrated saw, confidence intervals of its numbers, and residuals.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::Measurement;
use crate::model::scene::SceneFile;
use crate::page::text::shown_to;

/// Report of a fit (`fit.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The fitted scene.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Source of the measured frequencies.
    pub source: String,
    /// Probability that an interval contains the true value.
    pub confidence: f64,
    /// Fitted numbers.
    pub parameters: Vec<FittedParameter>,
    /// Freed numbers without effect on the measured frequencies; they keep their values.
    pub without_effect: Vec<String>,
    /// Correlation of the parameters, in their order.
    pub correlation: Vec<Vec<f64>>,
    /// Number of fitted frequencies.
    pub measured_frequencies: usize,
    /// Number of measured frequencies minus number of free numbers.
    pub degrees_of_freedom: usize,
    /// Root mean square of computed minus measured frequencies.
    pub rms_hz: f64,
    /// Root mean square of computed minus measured frequencies before the fit.
    pub rms_before_hz: f64,
    /// Measured and computed frequencies in pairs.
    pub residuals: Vec<Residual>,
    /// Lowest frequencies over speed, before and after the fit.
    pub curves: Curves,
    /// All starts and their results, on a coarser basis.
    pub starts: Vec<Start>,
    /// Largest number of nodal diameters of the basis.
    pub max_diameters: usize,
    /// Number of radial functions for each number of nodal diameters.
    pub radial_functions: usize,
    /// Estimated relative error of the critical speeds on this basis.
    pub estimated_relative_error: Option<f64>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A fitted number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ParameterEntry")]
pub struct FittedParameter {
    /// JSON path in the scene.
    pub path: String,
    /// Value before the fit.
    pub start: f64,
    /// Fitted value.
    pub value: f64,
    /// Lower end of the interval. Null at a bound, and if the data do not determine this number: they do not
    /// distinguish it from others, or the interval is wider than the distance between its bounds.
    pub interval_from: Option<f64>,
    /// Upper end of the interval.
    pub interval_to: Option<f64>,
    /// Lower bound.
    pub bound_from: f64,
    /// Upper bound.
    pub bound_to: f64,
    /// Whether the value is a bound.
    pub at_bound: bool,
}

/// A measured frequency and the corresponding computed one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ResidualEntry")]
pub struct Residual {
    /// Rotation speed.
    pub rpm: f64,
    /// Rank of the computed frequency at this speed, from 1, ascending.
    pub place: usize,
    /// Measured frequency.
    pub measured_hz: f64,
    /// Frequency computed before the fit.
    pub before_hz: f64,
    /// Frequency computed with the fitted numbers.
    pub fitted_hz: f64,
    /// Whether the fit includes this speed.
    pub fitted: bool,
}

/// Lowest frequencies, ascending, one row for each speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Curves {
    /// Speeds of the curves.
    pub rpm: Vec<f64>,
    /// Frequencies before the fit.
    pub before_hz: Vec<Vec<f64>>,
    /// Frequencies after the fit.
    pub fitted_hz: Vec<Vec<f64>>,
}

/// A start and its result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// Initial values.
    pub from: Vec<f64>,
    /// Final values; null for a start that is not a valid saw.
    pub to: Option<Vec<f64>>,
    /// Root mean square of the residuals at the final values; null without them.
    pub rms_hz: Option<f64>,
}

/// Two numbers of higher correlation cannot be determined separately.
const HIGH_CORRELATION: f64 = 0.95;
/// Limit of the root mean square of the residuals, relative to that of the measured frequencies. A
/// calibration of the paper's Table 5 leaves 4 %.
const MISFIT: f64 = 0.2;

/// Result of a start.
#[derive(Debug, PartialEq)]
struct Rival<'a> {
    values: &'a [f64],
    rms_hz: f64,
}

impl FitReport {
    /// Remarks on the validity of a fit to these frequencies.
    pub(super) fn remarks(&self, used: &Measurement) -> Vec<String> {
        let mut remarks: Vec<String> = self.misfit(used).into_iter().collect();
        remarks.extend(self.rival().map(|rival| self.rival_in_words(rival)));
        for path in &self.without_effect {
            remarks.push(format!("{path} changes no measured frequency and was kept"));
        }
        for found in &self.parameters {
            let path = &found.path;
            if found.at_bound {
                remarks.push(format!(
                    "{path} is at a bound; widen it if a saw may have other values"
                ));
            } else if found.interval_from.is_none() {
                remarks.push(format!(
                    "the data do not determine {path}: other values fit about as well"
                ));
            }
        }
        for (i, row) in self.correlation.iter().enumerate() {
            for (k, correlation) in row.iter().enumerate().take(i) {
                if correlation.abs() > HIGH_CORRELATION {
                    remarks.push(format!(
                        "the data hardly distinguish {} and {} (correlation {correlation:.2})",
                        self.parameters[k].path, self.parameters[i].path
                    ));
                }
            }
        }
        remarks
    }

    /// The best saw of another minimum that fits about as well: its sum of squares is within the
    /// region of confidence S ≤ S_min (1 + p/(m − p) F(p, m − p)) of the best one (Seber and Wild, *Nonlinear Regression*,
    /// 1989, §5.4), and a number is farther from that of the best start than the width of its interval. Starts are
    /// compared with each other, because all have the coarser basis.
    fn rival(&self) -> Option<Rival<'_>> {
        let reached = self.starts.iter().filter_map(|start| {
            Some(Rival {
                values: start.to.as_deref()?,
                rms_hz: start.rms_hz?,
            })
        });
        let in_order = |one: &Rival, other: &Rival| one.rms_hz.total_cmp(&other.rms_hz);
        let best = reached.clone().min_by(in_order)?;
        let (free, left) = (self.parameters.len() as f64, self.degrees_of_freedom as f64);
        let quantile = FisherSnedecor::new(free, left)
            .ok()?
            .inverse_cdf(self.confidence);
        let limit_hz = best.rms_hz * (1.0 + free / left * quantile).sqrt();
        let is_apart = |values: &[f64]| {
            let pairs = values.iter().zip(best.values).zip(&self.parameters);
            pairs.into_iter().any(|((value, best), parameter)| {
                let ends = parameter.interval_from.zip(parameter.interval_to);
                ends.is_some_and(|(from, to)| (value - best).abs() > to - from)
            })
        };
        reached
            .filter(|other| other.rms_hz <= limit_hz && is_apart(other.values))
            .min_by(in_order)
    }

    fn rival_in_words(&self, Rival { values, rms_hz }: Rival<'_>) -> String {
        let numbers: Vec<String> = self
            .parameters
            .iter()
            .zip(values)
            .map(|(parameter, value)| format!("{} = {}", parameter.path, shown_to(4, *value)))
            .collect();
        format!(
            "another saw fits about as well ({rms_hz:.3} Hz rms), with {}: the intervals hold for the best saw alone; a frequency at another speed tells them apart",
            numbers.join(", ")
        )
    }

    /// Remark on a saw whose frequencies differ considerably from the measured ones.
    fn misfit(&self, used: &Measurement) -> Option<String> {
        let frequencies = used.rows.iter().flat_map(|row| &row.pairs);
        let squares: f64 = frequencies.map(|(_, hz)| hz * hz).sum();
        let measured_hz = (squares / used.count() as f64).sqrt();
        (self.rms_hz > MISFIT * measured_hz).then(|| {
            format!(
                "the fitted saw does not have these frequencies: they differ by {:.3} Hz rms and are themselves {measured_hz:.3} Hz rms; are they in Hz, the speeds in rpm, and are blade and mount those of the measurement?",
                self.rms_hz
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With 22 degrees of freedom and two numbers the region of confidence of 95 % reaches to 1.15 times the least rms:
    /// F(2, 22) = 3.44.
    #[test]
    fn another_minimum_within_the_region_of_confidence_is_reported() {
        let json = include_str!("../../../tests/golden/reports/fit-paper.json");
        let report: FitReport = serde_json::from_str(json).unwrap();
        assert_eq!(report.rival(), None);
        let with = |radius_m: f64, ratio: f64| {
            let mut other = report.clone();
            other.starts[1].to = Some(vec![radius_m, 2.07e7]);
            other.starts[1].rms_hz = Some(ratio * report.rms_hz);
            other.rival().map(|rival| rival.values[0])
        };
        assert_eq!(with(0.3, 1.14), Some(0.3));
        assert_eq!(with(0.3, 1.16), None);
        // The interval is 0.163 to 0.225 m.
        assert_eq!(with(0.25, 1.0), None);
    }
}
