//! What the page is sent: charts, files, and why a scene was refused.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::examples::examples;
use crate::figure::{self, FigureError};
use crate::report::{Report, SensitivityEntry};
use crate::scene::{
    Accuracy, QUANTITIES, Quantity, RefusedValue, Scene, SceneError, SceneFile, json_schema,
};
use crate::spectrum::SpectrumError;
use crate::stability::{Analysis, AnalysisError, AnalysisOptions, Detail, sensitivities};

/// What the page begins with.
#[derive(Serialize)]
pub struct Start {
    scene: SceneFile,
    schema: serde_json::Value,
    /// Saws to begin with.
    examples: Vec<SceneFile>,
    /// Between which values the numbers of saws lie, for the sliders.
    quantities: &'static [Quantity],
    colours: figure::Palette,
    version: &'static str,
}

impl Start {
    /// For a scene.
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

/// Which accuracy a chart is asked for at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fidelity {
    /// Draft, whatever the scene says, and drawn at fewer speeds: for a saw that is just being
    /// changed.
    Draft,
    /// The scene's own.
    Scene,
}

/// Why there is no chart, and which quantity is to blame.
#[derive(Debug, Serialize)]
pub struct Refusal {
    /// JSON path of the quantity, where there is one.
    pub key: Option<String>,
    /// The library's own words.
    pub message: String,
    /// What is allowed, where a number of the scene is to blame: for the page to say in the unit
    /// of its field.
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
    /// Of a chart that has been replaced by later ones.
    pub fn gone(chart: usize) -> Self {
        Refusal {
            key: None,
            message: format!("chart {chart} is not kept any more"),
            allowed: None,
        }
    }

    /// A refusal that no quantity is to blame for.
    pub fn of(error: &dyn std::error::Error) -> Self {
        Refusal {
            key: None,
            message: error.to_string(),
            allowed: None,
        }
    }
}

#[derive(Serialize)]
struct Chart<'a> {
    /// Name of the chart when its modes are asked for.
    chart: usize,
    milliseconds: f64,
    report: &'a Report,
}

/// The latest charts, for the modes on them.
#[derive(Default)]
pub struct Charts(Mutex<Kept>);

#[derive(Default)]
struct Kept {
    made: usize,
    latest: VecDeque<(usize, Arc<Analysis>)>,
}

/// The chart shown and those that are just being replaced.
const KEPT: usize = 3;

impl Charts {
    /// Computes a chart and keeps it for its modes; the answer as JSON.
    ///
    /// # Errors
    /// [`Refusal`] of a scene or of a computation that fails or is stopped.
    pub fn chart(&self, scene: &str, fidelity: Fidelity) -> Result<String, Refusal> {
        let started = Instant::now();
        let mut scene = Scene::from_json(scene)?;
        let detail = match fidelity {
            Fidelity::Draft => {
                scene = scene
                    .edited(|file| (file.accuracy, file.tolerance) = (Accuracy::Draft, None))?;
                Detail::Sketch
            }
            Fidelity::Scene => Detail::Full,
        };
        let analysis = Analysis::with_options(
            &scene,
            AnalysisOptions {
                detail,
                ..AnalysisOptions::default()
            },
        )?;
        let report = analysis.report();
        let chart = self.keep(analysis);
        let milliseconds = 1e3 * started.elapsed().as_secs_f64();
        serde_json::to_string(&Chart {
            chart,
            milliseconds,
            report: &report,
        })
        .map_err(|error| Refusal::of(&error))
    }

    /// How the speeds of a chart move with the numbers of its scene.
    ///
    /// # Errors
    /// [`Refusal`] of a chart that is not kept any more, or of a computation that fails.
    pub fn influence(&self, asked: &str) -> Result<Vec<SensitivityEntry>, Refusal> {
        let chart: usize = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let analysis = self.named(chart).ok_or_else(|| Refusal::gone(chart))?;
        let start = analysis.range_rad_per_s.0;
        let at = analysis.scene.operating_rad_per_s().unwrap_or(start);
        let found = sensitivities(&analysis, at).map_err(|error| Refusal::of(&error))?;
        Ok(found.iter().map(SensitivityEntry::from).collect())
    }

    fn keep(&self, analysis: Analysis) -> usize {
        let mut kept = self.0.lock().unwrap_or_else(|e| e.into_inner());
        kept.made += 1;
        let name = kept.made;
        kept.latest.push_back((name, Arc::new(analysis)));
        while kept.latest.len() > KEPT {
            kept.latest.pop_front();
        }
        name
    }

    /// A chart by its name, while it is kept.
    pub fn named(&self, name: usize) -> Option<Arc<Analysis>> {
        let kept = self.0.lock().unwrap_or_else(|e| e.into_inner());
        let found = kept.latest.iter().find(|(known, _)| *known == name);
        found.map(|(_, analysis)| analysis.clone())
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
    /// By the name it has on the command line.
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

    /// What a browser calls it.
    pub fn media_type(self) -> &'static str {
        match self {
            SavedFile::Scene | SavedFile::Report => "application/json",
            SavedFile::Table => "text/csv",
            SavedFile::Png => "image/png",
            SavedFile::Svg => "image/svg+xml",
        }
    }

    /// Its bytes for a scene.
    ///
    /// # Errors
    /// [`Refusal`] of a scene or of a computation that fails or is stopped.
    pub fn content(self, scene: &str) -> Result<Vec<u8>, Refusal> {
        let scene = Scene::from_json(scene)?;
        if self == SavedFile::Scene {
            return pretty(scene.file());
        }
        let report = Analysis::new(&scene)?.report();
        let undrawn = |error: FigureError| Refusal::of(&error);
        match self {
            SavedFile::Scene | SavedFile::Report => pretty(&report),
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
