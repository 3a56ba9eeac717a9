//! Limits as options of the command.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{CheckError, CheckReport, Limits, LimitsFile, RIM_LIMIT_M_PER_S, check};
use crate::analyses::door::{CommandError, CommandOptions, Progress};
use crate::model::scene::Scene;
use crate::stability::OPERATING_LIMIT;

/// Checks the saw against limits. The result is true in a boolean context if every limit is kept: assert
/// saw.check(...).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Operating speed; by default that of the scene.
    #[schemars(extend("x-option" = "rpm"))]
    pub operating_rpm: Option<f64>,
    /// Largest allowed ratio of operating speed to first critical speed.
    pub margin: f64,
    /// Lowest allowed flutter speed.
    pub min_flutter_rpm: Option<f64>,
    /// Lowest allowed first critical speed.
    pub min_critical_rpm: Option<f64>,
    /// Largest allowed speed of the rim.
    pub max_rim_m_per_s: f64,
    /// Largest allowed amplitude of flutter in any band up to the operating speed, without damping.
    pub max_amplitude_m: Option<f64>,
    /// Let a saw with implausible numbers pass.
    pub accept_unusual: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            operating_rpm: None,
            margin: OPERATING_LIMIT,
            min_flutter_rpm: None,
            min_critical_rpm: None,
            max_rim_m_per_s: RIM_LIMIT_M_PER_S,
            max_amplitude_m: None,
            accept_unusual: false,
        }
    }
}

impl CommandOptions for Options {
    type Report = CheckReport;
    const COMMAND: &str = "check";
    const METHOD: &str = "check";

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<CheckReport, CommandError> {
        let asked = LimitsFile {
            operating_rpm: self.operating_rpm,
            margin: self.margin,
            min_flutter_rpm: self.min_flutter_rpm,
            min_critical_rpm: self.min_critical_rpm,
        };
        let limits = asked
            .limits(scene)?
            .with_rim_speed(self.max_rim_m_per_s)?
            .with_amplitude(self.max_amplitude_m)?;
        let limits = Limits {
            accept_unusual: self.accept_unusual,
            ..limits
        };
        Ok(check(scene, &limits)?)
    }

    fn is_kept(report: &CheckReport) -> bool {
        report.passed
    }
}

impl From<CheckError> for CommandError {
    fn from(error: CheckError) -> Self {
        match error {
            CheckError::Scene(source) => source.into(),
            CheckError::Spectrum(source) => source.into(),
            CheckError::Analysis(source) => source.into(),
            CheckError::Stretched(source) => source.into(),
        }
    }
}
