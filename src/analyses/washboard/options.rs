//! Speed of a cut that is examined for washboarding.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{WashboardError, WashboardReport, washboard};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber, Step};
use crate::model::scene::{AssumedBlock, Scene};
use crate::stability::check_speed;

/// Determines whether washboarding occurs under the cutting force of cut.washboarding in the scene. If the scene has none
/// but the call one of its numbers, typical numbers are assumed for the others, and a ModelWarning names them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Speed of the cut; by default the operating speed of the scene.
    pub rpm: Option<f64>,
}

impl CommandOptions for Options {
    type Report = WashboardReport;
    const COMMAND: &str = "washboard";
    const METHOD: &str = "run_washboard";
    const SETS: &[SceneNumber] = &[
        SceneNumber::new(
            "stiffness_n_per_m",
            "stiffness",
            "cut.washboarding.stiffness_n_per_m",
            "Lateral cutting stiffness, in place of cut.washboarding.stiffness_n_per_m of the scene",
        ),
        SceneNumber::new(
            "overlap",
            "overlap",
            "cut.washboarding.overlap",
            "Share of a tooth's cut on the surface left by the preceding one, in place of cut.washboarding.overlap of the scene",
        ),
        SceneNumber::POWER,
        SceneNumber::DEPTH,
    ];
    const ASSUMED: Option<AssumedBlock> = Some(AssumedBlock::Washboarding);

    fn compute(
        &self,
        scene: &Scene,
        progress: Progress<'_>,
    ) -> Result<WashboardReport, CommandError> {
        if let Some(rpm) = self.rpm {
            check_speed(scene.blade(), "rpm", rpm)?;
        }
        let cut = scene.needed_washboarding()?;
        let run = cut.at_rpm(scene.needed_operating_rpm(self.rpm)?)?;
        let speeds = |done, of| progress(Step::new("speeds", done, of));
        Ok(washboard(scene, &run, &speeds)?)
    }
}

impl From<WashboardError> for CommandError {
    fn from(error: WashboardError) -> Self {
        let key = match &error {
            WashboardError::Undamped { .. } => "damping",
            WashboardError::Incomplete { .. } => "blade.teeth",
            WashboardError::Loose => "guides",
            WashboardError::Scene(_)
            | WashboardError::Spectrum(_)
            | WashboardError::Analysis(_) => {
                return match error {
                    WashboardError::Scene(source) => source.into(),
                    other => CommandError::failed(other),
                };
            }
        };
        CommandError::Unanswered {
            key: Some(key),
            message: error.to_string(),
        }
    }
}
