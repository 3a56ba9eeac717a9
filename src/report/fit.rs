//! `fit.json`: the calibrated saw, confidence intervals of its numbers, and residuals.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fit::{Curves, Fit, FittedParameter, Measurement, Row, Start};
use crate::scene::{SceneFile, unusual_number};

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
    pub parameters: Vec<ParameterEntry>,
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
    pub residuals: Vec<ResidualEntry>,
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
pub struct ParameterEntry {
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
pub struct ResidualEntry {
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

/// Two numbers of higher correlation cannot be determined separately.
const HIGH_CORRELATION: f64 = 0.95;

impl FitReport {
    /// The report of a fit.
    pub fn new(fit: &Fit) -> Self {
        FitReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: fit.scene.file().clone(),
            condition: fit.scene.condition(),
            unusual_numbers: unusual_numbers(fit),
            source: fit.measurement.source.clone(),
            confidence: fit.confidence,
            parameters: fit.parameters.iter().map(ParameterEntry::from).collect(),
            without_effect: fit
                .without_effect
                .iter()
                .map(|freed| freed.parameter.path().to_owned())
                .collect(),
            correlation: fit.correlation.clone(),
            measured_frequencies: fit.measurement.up_to(fit.to_rpm).count(),
            degrees_of_freedom: fit.degrees_of_freedom,
            rms_hz: fit.rms_hz,
            rms_before_hz: fit.rms_before_hz,
            residuals: residuals(fit),
            curves: fit.compared.curves.clone(),
            starts: fit.starts.clone(),
            max_diameters: fit.resolution.max_diameters,
            radial_functions: fit.resolution.radial_functions_on(fit.scene.blade()),
            estimated_relative_error: fit.estimated_relative_error,
            warnings: warnings(fit),
        }
    }
}

impl From<&FittedParameter> for ParameterEntry {
    fn from(found: &FittedParameter) -> Self {
        ParameterEntry {
            path: found.freed.parameter.path().to_owned(),
            start: found.start,
            value: found.value,
            interval_from: found.interval.map(|(from, _)| from),
            interval_to: found.interval.map(|(_, to)| to),
            bound_from: found.freed.from,
            bound_to: found.freed.to,
            at_bound: found.at_bound,
        }
    }
}

fn residuals(fit: &Fit) -> Vec<ResidualEntry> {
    let mut entries = Vec::new();
    let computed = &fit.compared.measured;
    let computed = computed.before_hz.iter().zip(&computed.fitted_hz);
    for (row, (before, after)) in fit.measurement.rows.iter().zip(computed) {
        let Row { rpm, pairs } = row;
        for (place, measured_hz) in pairs {
            let at = |computed: &[f64]| computed.get(*place).copied().unwrap_or(0.0);
            entries.push(ResidualEntry {
                rpm: *rpm,
                place: place + 1,
                measured_hz: *measured_hz,
                before_hz: at(before),
                fitted_hz: at(after),
                fitted: *rpm <= fit.to_rpm,
            });
        }
    }
    entries
}

/// Limit of the root mean square of the residuals, relative to that of the measured frequencies. A
/// calibration of the paper's Table 5 leaves 4 %.
const MISFIT: f64 = 0.2;

/// Warning for a saw whose frequencies differ considerably from the measured ones.
fn misfit(fit: &Fit, used: &Measurement) -> Option<String> {
    let frequencies = used.rows.iter().flat_map(|row| &row.pairs);
    let squares: f64 = frequencies.map(|(_, hz)| hz * hz).sum();
    let measured_hz = (squares / used.count() as f64).sqrt();
    (fit.rms_hz > MISFIT * measured_hz).then(|| {
        format!(
            "the fitted saw does not have these frequencies: they differ by {:.3} Hz rms and are themselves {measured_hz:.3} Hz rms; are they in Hz, the speeds in rpm, and are blade and mount those of the measurement?",
            fit.rms_hz
        )
    })
}

/// Unusual numbers of the scene, and the highest measured speed if it is unusual and the scene does not contain the
/// measurement.
fn unusual_numbers(fit: &Fit) -> Vec<String> {
    let scene = fit.scene.file();
    let mut unusual = scene.unusual_numbers();
    let of_measurement = |sentence: &String| sentence.contains("measured.rows");
    if !unusual.iter().any(of_measurement) {
        let top_rpm = fit.measurement.up_to(fit.to_rpm).top_rpm();
        let label = "the highest measured speed";
        unusual.extend(unusual_number(scene, label, "sweep.to_rpm", top_rpm));
    }
    unusual
}

fn warnings(fit: &Fit) -> Vec<String> {
    let used = fit.measurement.up_to(fit.to_rpm);
    let mut warnings: Vec<String> = misfit(fit, &used).into_iter().collect();
    for freed in &fit.without_effect {
        warnings.push(format!(
            "{} changes no measured frequency and was kept",
            freed.parameter.path()
        ));
    }
    for found in &fit.parameters {
        let path = found.freed.parameter.path();
        if found.at_bound {
            warnings.push(format!(
                "{path} is at a bound; widen it if a saw may have other values"
            ));
        } else if found.interval.is_none() {
            warnings.push(format!(
                "the data do not determine {path}: other values fit about as well"
            ));
        }
    }
    for (i, row) in fit.correlation.iter().enumerate() {
        for (k, correlation) in row.iter().enumerate().take(i) {
            if correlation.abs() > HIGH_CORRELATION {
                let path = |i: usize| fit.parameters[i].freed.parameter.path();
                warnings.push(format!(
                    "the data hardly distinguish {} and {} (correlation {correlation:.2})",
                    path(k),
                    path(i)
                ));
            }
        }
    }
    warnings
}
