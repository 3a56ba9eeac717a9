//! Replies to the page other than diagrams: initial data and files.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use super::examples::examples;
use super::fields::Field;
use super::glossary::glossary;
use super::needs::{NEEDS, Need};
use super::refusal::Refusal;
use super::tolerances::{USUAL, UsualTolerance};
use crate::analyses::campbell::Report;
use crate::model::scene::{Scene, SceneFile, json_schema};
use crate::page::figure::{self, FigureError};
use crate::stability::Analysis;

/// A file that the page can save to.
#[derive(Debug, Clone, Serialize)]
pub struct FileNote {
    /// Name of the file without folders.
    pub name: String,
    /// Whether the file is JSON without comments, which would be lost when the page saves it.
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
    /// Conditions of parts and tasks.
    needs: &'static [Need],
    /// Usual tolerances, which a study of the page starts with.
    tolerances: &'static [UsualTolerance],
    /// Terms and their definitions.
    glossary: BTreeMap<String, String>,
    colours: figure::Palette,
    version: &'static str,
}

impl Start {
    /// Creates the initial data for a scene.
    pub fn new(scene: &Scene) -> Self {
        Start {
            scene: scene.file().clone(),
            file: None,
            schema: json_schema(),
            examples: examples(),
            fields: Field::all(),
            needs: NEEDS,
            tolerances: &USUAL,
            glossary: glossary(),
            colours: figure::PALETTE,
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}

/// A file that the page can save.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SavedFile {
    /// `scene.json`: the scene as the library reads it.
    Scene,
    /// `report.json`: the report of the analysis.
    Report,
    /// `campbell.csv`: the points of the diagram.
    Table,
    /// `campbell.png`: the diagram in pixels.
    Png,
    /// `campbell.svg`: the diagram as a vector graphic.
    Svg,
}

impl SavedFile {
    /// Returns the file with this name, which is that of the command line.
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

    /// Returns the media type of the file.
    pub fn media_type(self) -> &'static str {
        match self {
            SavedFile::Scene | SavedFile::Report => "application/json",
            SavedFile::Table => "text/csv",
            SavedFile::Png => "image/png",
            SavedFile::Svg => "image/svg+xml",
        }
    }

    /// Returns the content of the file for a scene. It computes the report unless it is known.
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
