//! Speeds of a cut.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{CutReport, cut};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber, Step};
use crate::model::scene::{AssumedBlock, Scene};
use crate::motion::transient::TransientError;
use crate::stability::check_speed;

/// Computes eigenvalues and a time history under the cutting forces of cut in the scene. If the scene has no cut but the
/// call a power or a depth, typical numbers are assumed for the others, and a ModelWarning names them.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Speed of the cut, or several, in place of those of the scene.
    pub rpm: Vec<f64>,
}

impl CommandOptions for Options {
    type Report = CutReport;
    const COMMAND: &str = "cut";
    const METHOD: &str = "run_cut";
    const SETS: &[SceneNumber] = &[
        SceneNumber::POWER,
        SceneNumber::DEPTH,
        SceneNumber::stretching("cut.stretching"),
    ];
    const ASSUMED: Option<AssumedBlock> = Some(AssumedBlock::Cut);

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<CutReport, CommandError> {
        for rpm in &self.rpm {
            check_speed(scene.blade(), "rpm", *rpm)?;
        }
        let runs = scene.needed_cut()?.runs_at(&self.rpm)?;
        let map = |done, of| progress(Step::new("points of the map", done, of));
        Ok(cut(scene, &runs, &map)?)
    }
}

impl From<TransientError> for CommandError {
    fn from(error: TransientError) -> Self {
        match error {
            TransientError::Scene(source) => source.into(),
            other => CommandError::failed(other),
        }
    }
}
