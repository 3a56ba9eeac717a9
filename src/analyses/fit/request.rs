//! Table, free numbers and extent of a fit as options of the command.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{FitError, FitReport, Measurement, Options, fit};
use crate::analyses::door::{CommandError, CommandOptions, Progress, Step};
use crate::model::scene::{Freed, NamedBounds, Scene, SceneFile};

/// Fits guides, density or other numbers of the scene to measured frequencies.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// Table of measured frequencies; by default that of the scene.
    #[schemars(extend("x-kind" = "table"))]
    pub measured: Option<(String, String)>,
    /// Number to fit, or several, by its path in the scene, with or without bounds; by default radius and stiffness of every
    /// guide, and the angles between several guides.
    #[schemars(extend("x-kind" = "bounds"))]
    pub free: Vec<NamedBounds>,
    /// Leave out measurements above this speed.
    pub to_rpm: Option<f64>,
    /// Confidence level of the intervals.
    pub confidence: f64,
    /// Starting points: the numbers of the scene, and others between the bounds.
    pub starts: usize,
}

impl Default for Request {
    fn default() -> Self {
        let options = Options::default();
        Request {
            measured: None,
            free: Vec::new(),
            to_rpm: None,
            confidence: options.confidence,
            starts: options.starts,
        }
    }
}

impl CommandOptions for Request {
    type Report = FitReport;
    const COMMAND: &str = "fit";
    const METHOD: &str = "fit";

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<FitReport, CommandError> {
        let measurement = match &self.measured {
            Some((name, table)) => {
                Measurement::from_csv(name, table).map_err(|error| CommandError::Unanswered {
                    key: None,
                    message: format!("{name} was refused: {error}"),
                })?
            }
            None => Measurement::of_scene(scene.needed_measured()?),
        };
        let options = Options {
            confidence: self.confidence,
            starts: self.starts,
            to_rpm: self.to_rpm.unwrap_or(f64::INFINITY),
            ..Options::default()
        }
        .checked(&measurement)?;
        let freed = Freed::to_fit(scene, &self.free)?;
        let starts = |done, of| progress(Step::new("starts", done, of));
        Ok(fit(scene, &measurement, &freed, &options, &starts)?)
    }

    fn resulting_scene(report: &FitReport) -> Option<(&'static str, Option<&SceneFile>)> {
        Some((
            "fitted-scene.json",
            report.is_met().then_some(&report.scene),
        ))
    }
}

impl From<FitError> for CommandError {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Scene(source) => source.into(),
            FitError::Analysis(source) => source.into(),
            FitError::Spectrum(source) => source.into(),
            other => CommandError::unanswered(other),
        }
    }
}
