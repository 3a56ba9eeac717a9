//! A command of one saw.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{CommandError, SceneNumber};
use crate::model::scene::{AssumedBlock, Scene, SceneFile};

/// Options of a command, with what it computes of a scene. The doc comment of the struct says what the command does.
pub trait CommandOptions: DeserializeOwned + JsonSchema {
    /// The result.
    type Report: Serialize;

    /// Name of the command, such as `gap`.
    const COMMAND: &'static str;
    /// Name of the method of a scene in Python, such as `run_gap`.
    const METHOD: &'static str;
    /// Options beside those of the struct: numbers of the scene that they replace.
    const SETS: &'static [SceneNumber] = &[];
    /// Block of the scene for which typical numbers are assumed beside those given.
    const ASSUMED: Option<AssumedBlock> = None;

    /// Computes the report.
    ///
    /// # Errors
    /// [`CommandError`].
    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<Self::Report, CommandError>;

    /// Keeps what is found on the way in a folder, so that a stopped run goes on with it. Few commands are that long.
    fn keep_in(&mut self, _folder: &Path) {}

    /// What the options assume of the scene, in words.
    fn assumptions(&self, _scene: &Scene) -> Option<String> {
        None
    }

    /// File name of the scene that results, and this scene, unless it keeps not all limits.
    fn resulting_scene(_report: &Self::Report) -> Option<(&'static str, Option<&SceneFile>)> {
        None
    }

    /// Whether the saw keeps all limits of the command.
    fn is_kept(_report: &Self::Report) -> bool {
        true
    }
}

/// Progress callback of a command.
pub type Progress<'a> = &'a (dyn Fn(Step) + Sync);

/// Progress of a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Name of the counted items.
    pub what: &'static str,
    /// Number of finished items.
    pub done: usize,
    /// Number of all items.
    pub of: usize,
    /// Highest speed found so far, of a search for one.
    pub best_rpm: Option<f64>,
}

impl Step {
    /// A step that searches no best speed.
    pub(crate) fn new(what: &'static str, done: usize, of: usize) -> Self {
        Step {
            what,
            done,
            of,
            best_rpm: None,
        }
    }
}
