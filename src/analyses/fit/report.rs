//! `fit.json`: the calibrated saw, confidence intervals of its numbers, and residuals.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Columns, Measurement, Row};
use crate::model::scene::SceneFile;

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
    /// Other minima that fit about as well, best first: the measured frequencies do not tell their saws apart. The intervals
    /// of each hold if its own saw is the true one.
    #[serde(default)]
    pub other_minima: Vec<Minimum>,
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
    /// Lower end of the interval of this minimum. Null at a bound, and if the data do not determine this number: they do not
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

/// Another saw that fits about as well.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Minimum {
    /// Root mean square of computed minus measured frequencies.
    pub rms_hz: f64,
    /// Fitted numbers.
    pub parameters: Vec<FittedParameter>,
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
    /// Number of nodal diameters with the largest share in the fitted mode; null if the basis has no such mode.
    pub diameters: Option<usize>,
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
/// Usual error of a measured frequency, relative, and the multiple of it beyond which the fitted saw is not that of the
/// measurement. A calibration of the paper's Table 5 leaves 4 %.
const ERROR: f64 = 0.01;
const MISFIT: f64 = 10.0;

impl FitReport {
    /// Remarks on the validity of a fit to these frequencies.
    pub(super) fn remarks(&self, used: &Measurement) -> Vec<String> {
        let mut remarks: Vec<String> = self.misfit(used).into_iter().collect();
        remarks.extend(self.ambiguity());
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

    /// Remark on other minima.
    fn ambiguity(&self) -> Option<String> {
        let saws = match self.other_minima.len() {
            0 => return None,
            1 => "another saw fits".to_owned(),
            count => format!("{count} other saws fit"),
        };
        Some(format!(
            "{saws} about as well, and each interval holds if its own saw is the true one; bound the numbers to the saw that is yours. Other modes or speeds may tell them apart, but no saw from its mirror image"
        ))
    }

    /// Root mean square of the fitted frequencies, as measured.
    fn measured_hz(&self) -> f64 {
        let fitted = || self.residuals.iter().filter(|residual| residual.fitted);
        let squares: f64 = fitted().map(|residual| residual.measured_hz.powi(2)).sum();
        (squares / fitted().count().max(1) as f64).sqrt()
    }

    /// Whether the fitted saw has the measured frequencies, within several times the usual error of a measurement.
    pub fn is_met(&self) -> bool {
        self.rms_hz <= MISFIT * ERROR * self.measured_hz()
    }

    /// Remark on a saw whose frequencies differ considerably from the measured ones.
    fn misfit(&self, used: &Measurement) -> Option<String> {
        let is_tap = |row: &Row| row.rpm == 0.0 && row.columns == Columns::Ranks;
        let taps = if used.rows.iter().any(is_tap) {
            " At rest a pair of equal frequencies counts once or twice, and a mode that was not seen needs a blank column; if its place is not known, name the columns by nodal diameters (n0, n1, …)"
        } else {
            ""
        };
        (!self.is_met()).then(|| {
            format!(
                "the fitted saw does not have these frequencies, and no fitted scene is made of it: they differ by {:.3} Hz rms, more than {MISFIT:.0} times {} % of {:.3} Hz, a usual error of measured frequencies; are they in Hz, the speeds in rpm, and are blade and mount those of the measurement?{taps}",
                self.rms_hz,
                100.0 * ERROR,
                self.measured_hz()
            )
        })
    }
}
