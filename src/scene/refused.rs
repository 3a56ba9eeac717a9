//! A value that cannot be used, in the four parts that every message of one has.

use crate::text::shown;

/// A value of a scene, a study or an argument that cannot be used. Its words are those of every
/// face: the program, the page and the Python package add nothing but the name of their option.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key} is {value}, but must be {allowed}; {remedy}")]
pub struct RefusedValue {
    /// JSON path of the key, or name of the argument.
    pub key: String,
    /// What was given.
    pub value: String,
    /// What is allowed.
    pub allowed: String,
    /// What to do about it.
    pub remedy: &'static str,
}

impl RefusedValue {
    /// Of a value that was given.
    pub(crate) fn new(
        key: impl Into<String>,
        value: impl Given,
        allowed: impl Into<String>,
        remedy: &'static str,
    ) -> Self {
        RefusedValue {
            key: key.into(),
            value: value.in_words(),
            allowed: allowed.into(),
            remedy,
        }
    }

    /// Of a key that has no value and needs one.
    pub(crate) fn missing(key: &str, allowed: &str, remedy: &'static str) -> Self {
        RefusedValue::new(key, "missing", allowed, remedy)
    }

    /// Whether the key has no value at all.
    pub fn is_missing(&self) -> bool {
        self.value == "missing"
    }
}

/// A value as messages show it.
pub(crate) trait Given {
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
