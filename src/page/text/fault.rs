//! Errors of reading JSON.

/// Error of reading a JSON text, for the user.
#[derive(Debug)]
pub(crate) struct KeyedError {
    /// JSON path of the key with the error, or the name of the whole text.
    pub key: String,
    /// Description of the error, and remedy.
    pub message: String,
    /// Whether a list of the known keys helps to correct the error: a key is missing or unknown, or the text
    /// ends too early.
    pub of_keys: bool,
}

/// Error of the parser.
pub(super) struct Fault {
    /// JSON path of the value at which the parser stopped; empty for the whole text.
    pub path: String,
    /// Message of the parser, with line and column.
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
