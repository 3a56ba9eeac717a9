//! Limits as options of the command.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{CheckError, CheckReport, Limits, check};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::Scene;

/// Checks the saw against limits. The result is true in a boolean context if every limit is kept: assert
/// saw.check(...).
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Operating speed; by default that of the scene.
    #[schemars(extend("x-option" = "rpm"))]
    pub operating_rpm: Option<f64>,
    /// Let a saw with implausible numbers pass.
    pub accept_unusual: bool,
}

pub(crate) const MARGIN: SceneNumber = SceneNumber::new(
    "margin",
    "margin",
    "limits.margin",
    "Largest allowed ratio of operating speed to first critical speed; 0.85 in a scene without one",
);
pub(crate) const MIN_FLUTTER: SceneNumber = SceneNumber::new(
    "min_flutter_rpm",
    "min-flutter",
    "limits.min_flutter_rpm",
    "Lowest allowed flutter speed",
);
pub(crate) const MAX_RIM: SceneNumber = SceneNumber::new(
    "max_rim_m_per_s",
    "max-rim",
    "limits.max_rim_m_per_s",
    "Largest allowed speed of the rim; 100 m/s in a scene without one",
);
pub(crate) const MAX_AMPLITUDE: SceneNumber = SceneNumber::new(
    "max_amplitude_m",
    "max-amplitude",
    "limits.max_amplitude_m",
    "Largest allowed amplitude of flutter in any band up to the operating speed, without damping",
);

impl CommandOptions for Options {
    type Report = CheckReport;
    const COMMAND: &str = "check";
    const METHOD: &str = "check";
    const SETS: &[SceneNumber] = &[
        MARGIN,
        MIN_FLUTTER,
        SceneNumber::MIN_CRITICAL,
        MAX_RIM,
        MAX_AMPLITUDE,
        SceneNumber::MAX_DEVIATION,
    ];

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<CheckReport, CommandError> {
        let operating_rpm = scene.needed_operating_rpm(self.operating_rpm)?;
        let limits = Limits {
            accept_unusual: self.accept_unusual,
            ..Limits::of(scene, operating_rpm)?
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
