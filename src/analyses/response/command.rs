//! `sawflutter response` for every face.

use super::{Options, ResponseError, ResponseReport, response};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::Scene;

impl CommandOptions for Options {
    type Report = ResponseReport;
    const COMMAND: &str = "response";
    const METHOD: &str = "run_response";
    const SETS: &[SceneNumber] = &[SceneNumber::FORCE, SceneNumber::ANGLE];

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<ResponseReport, CommandError> {
        Ok(response(scene, self)?)
    }
}

impl From<ResponseError> for CommandError {
    fn from(error: ResponseError) -> Self {
        match error {
            ResponseError::Refused(source) => source.into(),
            ResponseError::Scene(source) => source.into(),
            ResponseError::Analysis(source) => source.into(),
            ResponseError::Spectrum(source) => source.into(),
        }
    }
}
