//! Errors of reading JSON.

/// Error of reading a JSON text, for the user.
#[derive(Debug)]
pub(crate) struct KeyedError {
    /// JSON path of the key with the error, or the name of the whole text.
    pub key: String,
    /// Description of the error, and remedy.
    pub message: String,
    /// What may be given there, if a key or a value is another.
    pub allowed: Option<String>,
    /// The remedy within the message, if a key or a value is another.
    pub remedy: Option<String>,
    /// Whether a list of the known keys helps to correct the error: a key is missing or unknown, or the text
    /// ends too early.
    pub of_keys: bool,
}

impl KeyedError {
    /// The error with a sentence that points to a list of the keys, if that helps.
    pub fn pointing_to(mut self, list: &str) -> Self {
        if self.of_keys {
            self.message += &format!("; {list}");
            self.remedy = Some(match self.remedy {
                Some(remedy) => format!("{remedy}; {list}"),
                None => list.to_owned(),
            });
        }
        self
    }
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
