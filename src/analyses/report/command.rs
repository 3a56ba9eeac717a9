//! `sawflutter report` for every face.

use super::{DesignError, DesignReport, Options, report};
use crate::analyses::door::{CommandError, CommandOptions, Progress};
use crate::model::scene::Scene;

impl CommandOptions for Options {
    type Report = DesignReport;
    const COMMAND: &str = "report";
    const METHOD: &str = "run_report";

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<DesignReport, CommandError> {
        Ok(report(scene, self, progress)?)
    }
}

impl From<DesignError> for CommandError {
    fn from(error: DesignError) -> Self {
        match error {
            DesignError::Scene(source) => source.into(),
            DesignError::Response(source) => source.into(),
            DesignError::Gap(source) => source.into(),
            DesignError::Size(source) => source.into(),
            other => CommandError::failed(other),
        }
    }
}
