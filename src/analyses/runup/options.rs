//! Numbers of a run-up.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{RunUpReport, runup};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber, Step};
use crate::model::scene::{AssumedBlock, Scene};

/// Computes a run-up under the side force, from runup and side_force of the scene. If the scene has no runup but the call
/// one of its numbers, typical numbers are assumed for the others, and a ModelWarning names them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {}

impl CommandOptions for Options {
    type Report = RunUpReport;
    const COMMAND: &str = "runup";
    const METHOD: &str = "run_up";
    const SETS: &[SceneNumber] = &[
        SceneNumber::new("to_rpm", "to", "runup.to_rpm", "Last speed"),
        SceneNumber::new(
            "duration_s",
            "seconds",
            "runup.duration_s",
            "Time that the run-up takes",
        ),
        SceneNumber::FORCE,
        SceneNumber::stretching("runup.stretching"),
    ];
    const ASSUMED: Option<AssumedBlock> = Some(AssumedBlock::RunUp);

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<RunUpReport, CommandError> {
        scene.needed_runup()?;
        let steps = |done, of| progress(Step::new("steps", done, of));
        Ok(runup(scene, &steps)?)
    }
}
