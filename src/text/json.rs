//! Reads JSON with comments and with other deviations from the standard that are unambiguous.

use serde::de::DeserializeOwned;

use super::fault::{Fault, KeyedError, offset};
use super::problem;
use super::token::{Part, tokens, without_comments};

/// Reads JSON. Comments, commas before a closing bracket, and quoted numbers where only a number is allowed are
/// accepted; text after the last bracket is refused. `whole` is the name of the text in errors without a key.
///
/// # Errors
/// [`KeyedError`] if the text is not JSON, or not that of a `T`.
pub(crate) fn from_keyed_json<T: DeserializeOwned>(
    text: &str,
    whole: &str,
) -> Result<T, KeyedError> {
    let mut text = without_comments(text.trim_start_matches('\u{feff}'));
    loop {
        match strict(&text) {
            Ok(value) => return Ok(value),
            Err(fault) => match unquoted(&text, &fault.error) {
                Some(next) => text = next,
                None => return Err(problem::explain(&text, &fault, whole)),
            },
        }
    }
}

fn strict<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| Fault {
        path: known_path(&error.path().to_string()),
        error: error.into_inner(),
    })?;
    json.end().map_err(|error| Fault {
        path: String::new(),
        error,
    })?;
    Ok(value)
}

/// The path of a key without its last part if the parser marks that as unknown.
fn known_path(path: &str) -> String {
    let path = path.trim_end_matches('?').trim_end_matches('.');
    path.trim_end_matches("[?]").to_owned()
}

/// The text without the quotation marks around the number to which an error refers.
fn unquoted(text: &str, error: &serde_json::Error) -> Option<String> {
    let message = error.to_string();
    let (found, expected) = message
        .strip_prefix("invalid type: string ")?
        .split_once(", ")?;
    let number = found.trim_matches('"');
    let wanted = ["f64", "u32", "u64", "usize"];
    let wanted = wanted
        .iter()
        .any(|t| expected.starts_with(&format!("expected {t}")));
    if !wanted || !serde_json::from_str::<f64>(number).is_ok_and(f64::is_finite) {
        return None;
    }
    let end = offset(text, error);
    let mut same: Vec<_> = tokens(text)
        .into_iter()
        .filter(|token| token.part == Part::Quoted && token.text == found)
        .collect();
    // The parser stops at the end of the token that it refuses, except in an enum with data, which it reads
    // completely first. There the token is known only if no other token has the same text.
    if let Some(place) = same.iter().position(|token| token.end() == end) {
        same = vec![same[place]];
    }
    let [token] = same[..] else { return None };
    let mut next = text.to_owned();
    next.replace_range(token.start..token.end(), &format!(" {number} "));
    Some(next)
}
