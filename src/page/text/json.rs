//! Reads JSON with comments and with other deviations from the standard that are unambiguous.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;

use super::fault::{Fault, KeyedError, offset};
use super::missing::missing_keys;
use super::problem;
use super::token::{Part, Token, tokens, without_comments};

/// Reads JSON. Comments, commas before a closing bracket, quoted numbers where only a number is allowed, and whole numbers
/// with a decimal point are accepted; text after the last bracket is refused. `whole` is the name of the text in errors without a key.
///
/// # Errors
/// [`KeyedError`] if the text is not JSON, or not that of a `T`.
pub(crate) fn from_keyed_json<T: DeserializeOwned + JsonSchema>(
    text: &str,
    whole: &str,
) -> Result<T, KeyedError> {
    let mut text = without_comments(text.trim_start_matches('\u{feff}'));
    loop {
        match strict(&text) {
            Ok(value) => return Ok(value),
            Err(fault) => match meant(&text, &fault.error) {
                Some(next) => text = next,
                None => {
                    let missing = || missing_keys::<T>(&strict(&text).unwrap_or_default());
                    return Err(problem::explain(&text, &fault, whole, missing));
                }
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

/// Largest whole number that is accepted with a decimal point. Beyond it not all whole numbers are exact, and from 2⁶⁴ on the
/// parser reads them as floating point numbers again.
const MOST_WHOLE: f64 = 9e15;

/// The text with the number to which an error refers as it was meant: without quotation marks, and without a decimal
/// point where it is whole and a whole number is expected.
fn meant(text: &str, error: &serde_json::Error) -> Option<String> {
    let message = error.to_string();
    let (found, expected) = message
        .strip_prefix("invalid type: ")?
        .split_once(", expected ")?;
    let is_count = ["u32", "u64", "usize"]
        .iter()
        .any(|kind| expected.starts_with(kind));
    let is_number = is_count || expected.starts_with("f64");
    let is_refused = |token: &Token| match token.part {
        Part::Quoted => is_number && found.strip_prefix("string ") == Some(token.text),
        Part::Word => is_count && found.starts_with("floating point"),
        _ => false,
    };
    let mut refused = tokens(text);
    refused.retain(is_refused);
    // The parser stops at the end of the token that it refuses, except in an enum with data, which it reads
    // completely first. There the token is known only if no other token has the same text.
    let end = offset(text, error);
    let place = refused.iter().position(|token| token.end() == end);
    let token = match (place, &refused[..]) {
        (Some(place), all) => all[place],
        (None, [only]) if only.part == Part::Quoted => *only,
        _ => return None,
    };
    let digits = token.text.trim_matches('"');
    let value: f64 = serde_json::from_str(digits).ok()?;
    let number = match token.part {
        Part::Word if value.fract() != 0.0 || value.abs() > MOST_WHOLE => return None,
        // The sum has no negative zero, which the parser would read as a floating point number again.
        Part::Word => format!("{:.0}", value + 0.0),
        _ => digits.to_owned(),
    };
    let mut next = text.to_owned();
    next.replace_range(token.start..token.end(), &format!(" {number} "));
    Some(next)
}
