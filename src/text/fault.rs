//! Error of reading a JSON text, and its position.

/// Error of reading a JSON text.
#[derive(Debug)]
pub(crate) struct KeyedError {
    /// JSON path of the key, or the name of the whole.
    pub key: String,
    /// Description of the error, with remedy.
    pub message: String,
    /// Whether a list of the known keys is helpful.
    pub of_keys: bool,
}

/// Message and position of the parser.
pub(super) struct Fault {
    /// JSON path given by the parser; empty for the whole text.
    pub path: String,
    pub error: serde_json::Error,
}

/// Offset in bytes at which the parser stopped.
pub(super) fn offset(text: &str, error: &serde_json::Error) -> usize {
    let lines = text
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1));
    let before: usize = lines.map(str::len).sum();
    (before + error.column()).min(text.len())
}
