//! Errors of a scene, and the four parts of a message about a value that cannot be used.

use crate::page::text::{FileError, shown};

/// A value of a scene, a study or an argument that cannot be used. Program, live page and Python package show
/// this message and add only the name of their option.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}; {remedy}", self.in_words())]
pub struct RefusedValue {
    /// JSON path of the key, or name of the argument.
    pub key: String,
    /// The value that was given.
    pub value: String,
    /// Allowed values.
    pub allowed: String,
    /// Remedy for the user.
    pub remedy: Box<str>,
}

impl RefusedValue {
    /// Refuses a given value.
    pub(crate) fn new(
        key: impl Into<String>,
        value: impl Given,
        allowed: impl Into<String>,
        remedy: impl Into<Box<str>>,
    ) -> Self {
        RefusedValue {
            key: key.into(),
            value: value.in_words(),
            allowed: allowed.into(),
            remedy: remedy.into(),
        }
    }

    /// Refuses a missing value.
    pub(crate) fn missing(key: &str, allowed: &str, remedy: &'static str) -> Self {
        RefusedValue::new(key, "missing", allowed, remedy)
    }

    /// Whether the value is missing.
    pub fn is_missing(&self) -> bool {
        self.value == "missing"
    }

    fn in_words(&self) -> String {
        let RefusedValue {
            key,
            value,
            allowed,
            ..
        } = self;
        if self.is_missing() {
            format!("{key} is missing; it must be {allowed}")
        } else {
            format!("{key} must be {allowed} (you gave {value})")
        }
    }
}

/// A value that a message can contain.
pub(crate) trait Given {
    /// Formats the value for a message.
    fn in_words(&self) -> String;
}

impl Given for f64 {
    fn in_words(&self) -> String {
        shown(*self)
    }
}

impl Given for str {
    fn in_words(&self) -> String {
        self.to_owned()
    }
}

impl Given for String {
    fn in_words(&self) -> String {
        self.clone()
    }
}

impl Given for usize {
    fn in_words(&self) -> String {
        self.to_string()
    }
}

impl Given for u32 {
    fn in_words(&self) -> String {
        self.to_string()
    }
}

impl<T: Given + ?Sized> Given for &T {
    fn in_words(&self) -> String {
        (*self).in_words()
    }
}

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
        /// What may be given there, if a key or a value is another.
        allowed: Option<String>,
        /// The remedy, if a key or a value is another or missing.
        remedy: Option<String>,
    },
    /// A value is outside its range.
    #[error(transparent)]
    Value(#[from] RefusedValue),
}
