//! Replies to the page other than diagrams: initial data, files and errors.

use std::sync::Arc;

use serde::Serialize;

use super::examples::examples;
use crate::figure::{self, FigureError};
use crate::report::Report;
use crate::scene::{QUANTITIES, Quantity, RefusedValue, Scene, SceneError, SceneFile, json_schema};
use crate::spectrum::SpectrumError;
use crate::stability::{Analysis, AnalysisError};

/// Initial data of the page.
#[derive(Serialize)]
pub struct Start {
    scene: SceneFile,
    schema: serde_json::Value,
    /// Example saws.
    examples: Vec<SceneFile>,
    /// Usual ranges of the numbers of scenes, for sliders.
    quantities: &'static [Quantity],
    colours: figure::Palette,
    version: &'static str,
}

impl Start {
    /// The initial data for a scene.
    pub fn new(scene: &Scene) -> Self {
        Start {
            scene: scene.file().clone(),
            schema: json_schema(),
            examples: examples(),
            quantities: &QUANTITIES,
            colours: figure::PALETTE,
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}

/// An error, with the quantity that causes it.
#[derive(Debug, Serialize)]
pub struct Refusal {
    /// JSON path of the quantity, if there is one.
    pub key: Option<String>,
    /// Message of the library.
    pub message: String,
    /// Allowed values of a number of the scene, which the page converts to the unit of its field.
    pub allowed: Option<String>,
}

impl From<RefusedValue> for Refusal {
    fn from(error: RefusedValue) -> Self {
        Refusal {
            message: error.to_string(),
            key: Some(error.key),
            allowed: Some(error.allowed),
        }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Value(refused) => refused.into(),
            SceneError::Syntax { ref key, .. } => Refusal {
                key: Some(key.clone()),
                ..Refusal::of(&error)
            },
            _ => Refusal::of(&error),
        }
    }
}

impl From<AnalysisError> for Refusal {
    fn from(error: AnalysisError) -> Self {
        let key = match &error {
            AnalysisError::Unresolved { .. } | AnalysisError::Overstretched { .. } => {
                Some("sweep.to_rpm".to_owned())
            }
            _ => None,
        };
        Refusal {
            key,
            message: error.to_string(),
            allowed: None,
        }
    }
}

impl From<SpectrumError> for Refusal {
    fn from(error: SpectrumError) -> Self {
        Refusal::of(&error)
    }
}

impl Refusal {
    /// The diagram has been replaced by later ones.
    pub fn gone(chart: usize) -> Self {
        Refusal {
            key: None,
            message: format!("chart {chart} is not kept any more"),
            allowed: None,
        }
    }

    /// An error that no quantity causes.
    pub fn of(error: &dyn std::error::Error) -> Self {
        Refusal {
            key: None,
            message: error.to_string(),
            allowed: None,
        }
    }
}

/// A file that the page can save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SavedFile {
    /// The scene as the library understands it.
    Scene,
    /// `report.json`.
    Report,
    /// `campbell.csv`.
    Table,
    /// `campbell.png`.
    Png,
    /// `campbell.svg`.
    Svg,
}

impl SavedFile {
    /// The file with a name, as on the command line.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "scene.json" => SavedFile::Scene,
            "report.json" => SavedFile::Report,
            "campbell.csv" => SavedFile::Table,
            "campbell.png" => SavedFile::Png,
            "campbell.svg" => SavedFile::Svg,
            _ => return None,
        })
    }

    /// Media type.
    pub fn media_type(self) -> &'static str {
        match self {
            SavedFile::Scene | SavedFile::Report => "application/json",
            SavedFile::Table => "text/csv",
            SavedFile::Png => "image/png",
            SavedFile::Svg => "image/svg+xml",
        }
    }

    /// The bytes of the file for a scene, from its report if it is known.
    ///
    /// # Errors
    /// [`Refusal`] if a computation fails or is cancelled.
    pub fn content(self, scene: &Scene, known: Option<Arc<Report>>) -> Result<Vec<u8>, Refusal> {
        if self == SavedFile::Scene {
            return pretty(scene.file());
        }
        let report = match known {
            Some(report) => report,
            None => Arc::new(Analysis::new(scene)?.report()),
        };
        let undrawn = |error: FigureError| Refusal::of(&error);
        match self {
            SavedFile::Scene | SavedFile::Report => pretty(&*report),
            SavedFile::Table => report.campbell_csv().map_err(|error| Refusal::of(&error)),
            SavedFile::Png => report.campbell_png().map_err(undrawn),
            SavedFile::Svg => {
                let svg = report.campbell_svg().map_err(undrawn)?;
                Ok(svg.into_bytes())
            }
        }
    }
}

fn pretty(value: &impl Serialize) -> Result<Vec<u8>, Refusal> {
    serde_json::to_vec_pretty(value).map_err(|error| Refusal::of(&error))
}
