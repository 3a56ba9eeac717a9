//! Reads a [`SceneFile`] from bytes; errors name the key.

use std::path::Path;

use super::{RefusedValue, Scene, SceneFile};
use crate::text::{FileError, KeyedError, Kind, OtherEncodings, from_keyed_json, read_path};

/// Largest size of a scene file; a larger file is not a scene.
#[doc(hidden)]
pub const MAX_SCENE_BYTES: u64 = 1 << 20;

/// Options for reading scene and study files.
pub(crate) const SCENE_TEXT: Kind = Kind {
    limit: MAX_SCENE_BYTES,
    other_encodings: OtherEncodings::Refused,
};

/// Reason for which a scene was refused.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file could not be read as text.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is empty or contains only white space.
    #[error(
        "the scene is empty; `sawflutter schema` prints what it may contain, and scenes/ has examples"
    )]
    Empty,
    /// The text is not JSON or not a scene: wrong type, unknown or missing key.
    #[error("{key}: {message}")]
    Syntax {
        /// JSON path of the key.
        key: String,
        /// Description of the error, with remedy and line.
        message: String,
    },
    /// A value is outside its range.
    #[error(transparent)]
    Value(#[from] RefusedValue),
}

impl Scene {
    /// The paper's guided spline saw, as in `scenes/paper.json`.
    pub fn paper() -> Self {
        Self::from_json(include_str!("../../scenes/paper.json"))
            .expect("the embedded scene is checked by the tests")
    }

    /// Reads and validates a scene file.
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        Self::from_json(&read_path(path.as_ref(), SCENE_TEXT)?)
    }

    /// Reads and validates a scene from its JSON text.
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        Scene::try_from(Self::file_from_json(text)?)
    }

    /// Reads a scene file without validating its numbers.
    pub(crate) fn file_from_json(text: &str) -> Result<SceneFile, SceneError> {
        if text.trim().is_empty() {
            return Err(SceneError::Empty);
        }
        from_keyed_json(text, "the scene").map_err(syntax)
    }
}

fn syntax(error: KeyedError) -> SceneError {
    let KeyedError {
        key, mut message, ..
    } = error;
    if error.of_keys {
        message += "; `sawflutter schema` prints the keys and types of a scene";
    }
    SceneError::Syntax { key, message }
}
