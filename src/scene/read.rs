//! From bytes to a [`SceneFile`], with errors that point at the key.

use std::io::Read;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::{Scene, SceneFile};

/// No scene a person writes comes near this size; a file beyond it is something else.
pub const MAX_SCENE_BYTES: u64 = 1 << 20;

/// Why a scene was refused.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file could not be opened or read.
    #[error("cannot read the scene {}: {source}", path.display())]
    Read {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A directory or device was given.
    #[error("the scene {} is a directory; give the JSON file inside it", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
    },
    /// More bytes than a scene can have.
    #[error(
        "the scene {} is larger than {limit} bytes; a scene is a page of JSON, so this is probably another file",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// [`MAX_SCENE_BYTES`].
        limit: u64,
    },
    /// Nothing but white space.
    #[error(
        "the scene is empty; `sawflutter schema` prints what it may contain, and scenes/ has examples"
    )]
    Empty,
    /// Not JSON, or not a scene: wrong type, unknown or missing key.
    #[error("{key}: {message}; `sawflutter schema` prints the keys and types of a scene")]
    Syntax {
        /// JSON path of the key.
        key: String,
        /// What the parser said, with line and column.
        message: String,
    },
    /// A number that no saw has.
    #[error("{key} is {value}, but must be {allowed}; {remedy}")]
    Value {
        /// JSON path of the key.
        key: String,
        /// What was given.
        value: String,
        /// What is allowed.
        allowed: String,
        /// What to do about it.
        remedy: &'static str,
    },
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
        let path = path.as_ref();
        let unreadable = |source| SceneError::Read {
            path: path.to_owned(),
            source,
        };
        let file = std::fs::File::open(path).map_err(unreadable)?;
        if file.metadata().map_err(unreadable)?.is_dir() {
            return Err(SceneError::Directory {
                path: path.to_owned(),
            });
        }
        // The limit is on what is read, not on what the file system reports:
        // pipes and devices report nothing.
        let mut text = Vec::new();
        file.take(MAX_SCENE_BYTES + 1)
            .read_to_end(&mut text)
            .map_err(unreadable)?;
        if text.len() as u64 > MAX_SCENE_BYTES {
            return Err(SceneError::TooLarge {
                path: path.to_owned(),
                limit: MAX_SCENE_BYTES,
            });
        }
        let text = String::from_utf8(text).map_err(|_| SceneError::Syntax {
            key: "the scene".into(),
            message: "not UTF-8 text".into(),
        })?;
        Self::from_json(&text)
    }

    /// Reads and validates a scene from its JSON text.
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        if text.trim().is_empty() {
            return Err(SceneError::Empty);
        }
        let file: SceneFile = from_keyed_json(text, "the scene")
            .map_err(|KeyedError { key, message }| SceneError::Syntax { key, message })?;
        Scene::try_from(file)
    }
}

/// What a JSON text was refused for.
#[derive(Debug)]
pub(crate) struct KeyedError {
    /// JSON path of the key, or the whole.
    pub key: String,
    /// What the parser said, with line and column.
    pub message: String,
}

/// Reads JSON, and nothing after it; errors point at the key, or at the `whole` by its name.
pub(crate) fn from_keyed_json<T: DeserializeOwned>(
    text: &str,
    whole: &str,
) -> Result<T, KeyedError> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| KeyedError {
        key: match error.path().to_string().as_str() {
            "." => whole.to_owned(),
            path => path.to_owned(),
        },
        message: error.into_inner().to_string(),
    })?;
    json.end().map_err(|error| KeyedError {
        key: whole.to_owned(),
        message: error.to_string(),
    })?;
    Ok(value)
}

/// The JSON schema of a scene file, derived from [`SceneFile`].
pub fn json_schema() -> serde_json::Value {
    schemars::schema_for!(SceneFile).to_value()
}
