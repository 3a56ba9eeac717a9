//! Why a JSON text was refused, and where.

/// What a JSON text was refused for.
#[derive(Debug)]
pub(crate) struct KeyedError {
    /// JSON path of the key, or the whole.
    pub key: String,
    /// What is wrong with it, and the remedy.
    pub message: String,
    /// Whether a list of the known keys helps.
    pub of_keys: bool,
}

/// What the parser says, and where.
pub(super) struct Fault {
    /// JSON path as the parser has it; empty for the whole.
    pub path: String,
    pub error: serde_json::Error,
}

/// Offset in bytes at which the parser stopped, behind what it had read.
pub(super) fn offset(text: &str, error: &serde_json::Error) -> usize {
    let lines = text
        .split_inclusive('\n')
        .take(error.line().saturating_sub(1));
    let before: usize = lines.map(str::len).sum();
    (before + error.column()).min(text.len())
}
