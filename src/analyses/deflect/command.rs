//! `sawflutter deflect` for every face.

use super::{DeflectError, DeflectReport, Options, deflect};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::Scene;

impl CommandOptions for Options {
    type Report = DeflectReport;
    const COMMAND: &str = "deflect";
    const METHOD: &str = "run_deflect";
    const SETS: &[SceneNumber] = &[SceneNumber::FORCE, SceneNumber::ANGLE];

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<DeflectReport, CommandError> {
        Ok(deflect(scene, self)?)
    }
}

impl From<DeflectError> for CommandError {
    fn from(error: DeflectError) -> Self {
        match error {
            DeflectError::Refused(source) => source.into(),
            DeflectError::Scene(source) => source.into(),
            DeflectError::Analysis(source) => source.into(),
            DeflectError::Stretched(source) => source.into(),
        }
    }
}
