//! Words on the page, which influence no number.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{DesignError, DesignReport, report};
use crate::analyses::door::{CommandError, CommandOptions, Progress};
use crate::model::scene::Scene;

/// Joins what decides on a saw in one report: the answer idling and in the cut, the deviation of the board over speed,
/// margins with usual tolerances of production, and the changes that help most. Saved to a name that ends in .html it is
/// a page to print.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// For whom the report is.
    pub customer: Option<String>,
    /// Date of the report, as it is to be written.
    pub date: Option<String>,
}

impl CommandOptions for Options {
    type Report = DesignReport;
    const COMMAND: &str = "report";
    const METHOD: &str = "run_report";

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<DesignReport, CommandError> {
        Ok(report(scene, self)?)
    }
}

impl From<DesignError> for CommandError {
    fn from(error: DesignError) -> Self {
        match error {
            DesignError::Scene(source) => source.into(),
            DesignError::Response(source) => source.into(),
            DesignError::Gap(source) => source.into(),
            other => CommandError::failed(other),
        }
    }
}
