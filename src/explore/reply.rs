//! Replies to the page other than diagrams: initial data and files.

use std::sync::Arc;

use serde::Serialize;

use super::examples::examples;
use super::fields::Field;
use super::needs::{NEEDS, Need};
use super::refusal::Refusal;
use super::tolerances::{USUAL, UsualTolerance};
use crate::figure::{self, FigureError};
use crate::report::Report;
use crate::scene::{Scene, SceneFile, json_schema};
use crate::stability::Analysis;

/// A file that the page can save to.
#[derive(Debug, Clone, Serialize)]
pub struct FileNote {
    /// Its name without folders.
    pub name: String,
    /// Whether it is plain JSON. Comments are lost when it is saved.
    pub plain: bool,
}

/// Initial data of the page.
#[derive(Serialize)]
pub struct Start {
    scene: SceneFile,
    /// The file of the scene, if the page can save to it.
    pub file: Option<FileNote>,
    schema: serde_json::Value,
    /// Example saws.
    examples: Vec<SceneFile>,
    /// Names, units and usual ranges of the numbers of scenes.
    fields: Vec<Field>,
    /// What parts and tasks need.
    needs: &'static [Need],
    /// Tolerances of a study.
    tolerances: &'static [UsualTolerance],
    colours: figure::Palette,
    version: &'static str,
}

impl Start {
    /// The initial data for a scene.
    pub fn new(scene: &Scene) -> Self {
        Start {
            scene: scene.file().clone(),
            file: None,
            schema: json_schema(),
            examples: examples(),
            fields: Field::all(),
            needs: NEEDS,
            tolerances: &USUAL,
            colours: figure::PALETTE,
            version: env!("CARGO_PKG_VERSION"),
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
