//! Explains why a text is not the expected JSON.

use super::fault::{Fault, KeyedError, offset};
use super::token::{Part, Token, tokens};

/// A key, or nothing for the whole text, and what is wrong there.
struct Problem {
    key: String,
    message: String,
    allowed: Option<String>,
    remedy: Option<String>,
}

/// What may be given in place of a key or a value, and a remedy.
struct Advice {
    allowed: Option<String>,
    remedy: String,
}

impl Advice {
    fn give(allowed: &str) -> Self {
        Advice {
            allowed: Some(allowed.to_owned()),
            remedy: format!("give {allowed}"),
        }
    }

    fn only(remedy: impl Into<String>) -> Self {
        Advice {
            allowed: None,
            remedy: remedy.into(),
        }
    }
}

impl Problem {
    fn at(key: impl Into<String>, message: impl Into<String>) -> Self {
        Problem {
            key: key.into(),
            message: message.into(),
            allowed: None,
            remedy: None,
        }
    }
}

/// Finds the key and the cause of an error of the parser, and a remedy; `missing` lists all keys that are missing.
pub(super) fn explain(
    text: &str,
    fault: &Fault,
    whole: &str,
    missing: impl Fn() -> Vec<String>,
) -> KeyedError {
    let Fault { path, error } = fault;
    let words = error.to_string();
    let said = words.split(" at line ").next().unwrap_or_default();
    let line = error.line();
    let Problem {
        key,
        message,
        allowed,
        remedy,
    } = match error.classify() {
        _ if text.trim().is_empty() => Problem::at("", "it is empty; give its keys in JSON"),
        _ if !text.trim_start().starts_with('{') => Problem::at("", no_object(text)),
        serde_json::error::Category::Data => of_data(path, said, line),
        serde_json::error::Category::Eof => Problem::at("", unfinished(text)),
        _ => of_syntax(text, path, error)
            .unwrap_or_else(|| Problem::at(path, format!("it is no JSON: {said} (line {line})"))),
    };
    let is_missing = said.starts_with("missing field");
    let mut others = if is_missing { missing() } else { Vec::new() };
    others.retain(|other| *other != key);
    let also = if others.is_empty() {
        String::new()
    } else {
        format!(" (also missing: {})", others.join(", "))
    };
    KeyedError {
        key: if key.is_empty() { whole.into() } else { key },
        message: message + &also,
        allowed,
        remedy,
        of_keys: error.is_eof() || is_missing || said.starts_with("unknown field"),
    }
}

/// Message for a text that does not begin with a brace.
fn no_object(text: &str) -> String {
    if text.trim_start().starts_with('[') {
        "it must be an object in braces { } (you gave a list in brackets [ ])".into()
    } else {
        "it is no JSON, which begins with a brace, a key and a value, like {\"name\": …}".into()
    }
}

/// Message for a text that ends before its last bracket or quotation mark.
fn unfinished(text: &str) -> String {
    let mut open: Vec<Token> = Vec::new();
    for token in tokens(text) {
        match token.text {
            "{" | "[" => open.push(token),
            "}" | "]" => {
                open.pop();
            }
            _ => (),
        }
    }
    let Some(last) = open.last() else {
        return "it ends before it is complete: a quotation mark is not closed".into();
    };
    let closing = if last.text == "{" { '}' } else { ']' };
    format!(
        "it ends before it is complete: the {} of line {} is not closed; add the missing {closing}",
        last.text,
        line_of(text, last.start)
    )
}

/// Number of the line, from one on, of a byte.
fn line_of(text: &str, offset: usize) -> usize {
    1 + text[..offset].matches('\n').count()
}

/// The path of a key in the object with a given path, which may already end with the key.
fn below(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        _ if path == key || path.ends_with(&format!(".{key}")) => path.to_owned(),
        _ => format!("{path}.{key}"),
    }
}

/// The problem of a text that is JSON, but has another structure than expected.
fn of_data(path: &str, said: &str, line: usize) -> Problem {
    let names: Vec<&str> = said.split('`').skip(1).step_by(2).collect();
    let (subject, known) = (
        names.first().copied().unwrap_or_default(),
        names.get(1..).unwrap_or_default(),
    );
    let begins = |kind: &str| said.starts_with(kind);
    let (wrong, advice) = if begins("missing field") {
        return Problem::at(below(path, subject), "it is missing");
    } else if begins("unknown field") {
        let moved = moved(&below(path, subject)).map(Advice::only);
        let advice = moved.unwrap_or_else(|| meant(subject, known));
        ("there is no such key".to_owned(), Some(advice))
    } else if begins("duplicate field") {
        let advice = Advice::only("remove one");
        ("it is given twice".to_owned(), Some(advice))
    } else if begins("unknown variant") {
        (
            format!("{subject:?} is not known"),
            Some(meant(subject, known)),
        )
    } else {
        let found = said
            .strip_prefix("invalid type: ")
            .or_else(|| said.strip_prefix("invalid value: "));
        match found.and_then(|rest| rest.split_once(", expected ")) {
            Some((found, expected)) => return of_type(path, line, found, expected),
            None => (said.to_owned(), None),
        }
    };
    let remedy = advice.as_ref().map(|advice| advice.remedy.clone());
    let beside = remedy.iter().map(|remedy| format!("; {remedy}"));
    let message = format!("{wrong}{} (line {line})", beside.collect::<String>());
    let of_key = begins("unknown field") || begins("duplicate field");
    let key = if of_key {
        below(path, subject)
    } else {
        path.to_owned()
    };
    Problem {
        allowed: advice.and_then(|advice| advice.allowed),
        remedy,
        ..Problem::at(key, message)
    }
}

/// The problem of a value of the wrong type.
fn of_type(path: &str, line: usize, found: &str, expected: &str) -> Problem {
    let (kind, value) = found.split_once(' ').unwrap_or((found, ""));
    let is = match kind {
        "string" => format!("the text {value}"),
        "sequence" => "a list in brackets [ ]".into(),
        "map" => "an object in braces { }".into(),
        "integer" | "floating" | "boolean" => value
            .rsplit("point ")
            .next()
            .unwrap_or(value)
            .replace('`', ""),
        _ => found.to_owned(),
    };
    let first = expected.split(' ').next().unwrap_or_default();
    let must = match first {
        "f64" | "f32" => "a number",
        "u8" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "struct" | "internally" => "an object in braces { }",
        _ if expected.starts_with("a string") => "a text in double quotation marks",
        _ if expected.starts_with("a sequence") => "a list in brackets [ ]",
        _ if expected.starts_with("a map") => "an object in braces { }",
        _ if expected.starts_with("a boolean") => "true or false",
        _ => expected,
    };
    let comma = kind == "string" && first == "f64" && value.contains(',');
    let (said, remedy) = if comma {
        let remedy = "write it with a decimal point and without quotation marks";
        (format!("; {remedy}"), remedy.to_owned())
    } else {
        (String::new(), format!("give {must}"))
    };
    let message = format!("must be {must} (you gave {is}){said} (line {line})");
    Problem {
        allowed: Some(must.to_owned()),
        remedy: Some(remedy),
        ..Problem::at(path, message)
    }
}

/// Units that users write at the end of a key, the unit of the true key, and the factor between them.
const UNITS: [(&str, &str, &str); 13] = [
    ("mm", "m", "0.001"),
    ("cm", "m", "0.01"),
    ("in", "m", "0.0254"),
    ("inch", "m", "0.0254"),
    ("gpa", "pa", "1e9"),
    ("mpa", "pa", "1e6"),
    ("n_per_mm", "n_per_m", "1000"),
    ("kn_per_m", "n_per_m", "1000"),
    ("g_per_cm3", "kg_per_m3", "1000"),
    ("n_per_mm2", "pa", "1e6"),
    ("kw", "w", "1000"),
    ("ms", "s", "0.001"),
    ("m_per_min", "m_per_s", "1/60"),
];

/// Keys that users write for remarks; so are all that begin with an underscore.
const REMARKS: [&str; 5] = ["comment", "comments", "description", "remark", "//"];

/// Keys that scenes do not have, and what to give in their place.
const MOVED: [(&str, &str); 9] = [
    ("runup.force_n", "give it as side_force.force_n"),
    ("runup.angle_deg", "give it as side_force.angle_deg"),
    ("response.force_n", "give it as side_force.force_n"),
    ("response.radius_m", "give it as side_force.radius_m"),
    ("response.angle_deg", "give it as side_force.angle_deg"),
    (
        "response.tooth_force_n",
        "give it as side_force.oscillating_n, with the number of teeth as side_force.order",
    ),
    ("gap.force_n", "give it as side_force.force_n in the scene"),
    ("blade.kerf_m", OF_PLATE),
    ("blade.kerf_mm", OF_PLATE),
];

const OF_PLATE: &str = "the model takes the plate, not the kerf: give blade.thickness_m";

/// Smallest similarity, from 0 to 1, at which a known name is suggested for a misspelt one.
const LIKENESS: f64 = 0.75;

/// The remedy for a key of an earlier version.
fn moved(key: &str) -> Option<&'static str> {
    let found = MOVED.iter().find(|(old, _)| *old == key);
    found.map(|(_, remedy)| *remedy)
}

/// Suggests the known name that was probably meant, or lists all known names.
fn meant(subject: &str, known: &[&str]) -> Advice {
    for (unit, own, factor) in UNITS {
        let stem = subject
            .strip_suffix(unit)
            .filter(|stem| stem.ends_with('_'));
        let name = stem.map(|stem| format!("{stem}{own}"));
        if let Some(name) = name.filter(|name| known.contains(&name.as_str())) {
            return Advice {
                remedy: format!("did you mean {name}? One {unit} is {factor} {own}"),
                allowed: Some(name),
            };
        }
    }
    let small = subject.to_lowercase();
    if small.starts_with('_') || REMARKS.contains(&small.as_str()) {
        return Advice::only(
            "write remarks as texts of the list notes at the top, or as comments: // …",
        );
    }
    let likeness = |name: &str| {
        let whole =
            name.starts_with(&format!("{small}_")) || small.starts_with(&format!("{name}_"));
        let part = if whole { 1.0 } else { 0.0 };
        strsim::jaro_winkler(&small, name).max(part)
    };
    let nearest = known
        .iter()
        .map(|name| (likeness(name), *name))
        .max_by(|x, y| x.0.total_cmp(&y.0));
    match nearest.filter(|(likeness, _)| *likeness > LIKENESS) {
        Some((_, name)) => Advice {
            allowed: Some(name.to_owned()),
            remedy: format!("did you mean {name}?"),
        },
        None if known.is_empty() => Advice::only("leave it out: nothing can be given here"),
        None => Advice::give(&format!("one of: {}", known.join(", "))),
    }
}

/// The first common mistake before the place at which the parser stopped, for a text that is
/// not JSON.
fn of_syntax(text: &str, path: &str, error: &serde_json::Error) -> Option<Problem> {
    let stopped = offset(text, error);
    let all = tokens(text);
    let mut open = Vec::new();
    let mut key = "";
    for (place, token) in all.iter().enumerate() {
        if token.start > stopped {
            break;
        }
        let line = line_of(text, token.start);
        let next = |ahead: usize| all.get(place + ahead);
        let begins_key = next(1).is_some_and(|token| token.text == ":");
        match token.text {
            "{" | "[" => open.push(token.text),
            "}" | "]" => {
                open.pop();
            }
            _ if token.part == Part::Quoted && begins_key => key = token.text.trim_matches('"'),
            _ => (),
        }
        let in_object = open.last() == Some(&"{");
        if let Some(number) = decimal_comma(token, next(1), next(2), in_object) {
            let point = number.replace(',', ".");
            let message = format!("{number} has a decimal comma; write {point} (line {line})");
            let key = if in_object {
                below(path, key)
            } else {
                path.to_owned()
            };
            return Some(Problem::at(key, message));
        }
        if let Some(problem) = of_word(token, begins_key) {
            return Some(Problem::at(path, format!("{problem} (line {line})")));
        }
    }
    of_parser(error).map(|message| Problem::at(path, message))
}

/// A number with a decimal comma, like `0,0028`. In a list, where two whole numbers may follow each other, the part
/// after the comma must begin with 0.
fn decimal_comma(
    token: &Token,
    comma: Option<&Token>,
    after: Option<&Token>,
    in_object: bool,
) -> Option<String> {
    let digits = |text: &str| text.chars().all(|c| c.is_ascii_digit());
    let (comma, after) = (comma?, after?);
    let adjacent = token.end() == comma.start && comma.end() == after.start;
    let whole = token.text.trim_start_matches('-');
    let first = after.text.chars().next()?;
    let zero = after.text.len() > 1 && after.text.starts_with('0') && digits(after.text);
    let found = token.part == Part::Word
        && comma.text == ","
        && after.part == Part::Word
        && adjacent
        && !whole.is_empty()
        && digits(whole)
        && first.is_ascii_digit()
        && (in_object || zero);
    found.then(|| format!("{},{}", token.text, after.text))
}

/// Message for a word that is not a number, `true`, `false` or `null`.
fn of_word(token: &Token, begins_key: bool) -> Option<String> {
    let text = token.text;
    if token.part != Part::Word || serde_json::from_str::<serde_json::Value>(text).is_ok() {
        return None;
    }
    let bare = text.trim_start_matches(['-', '+']).to_lowercase();
    let quotes = text.starts_with(['\'', '\u{2018}', '\u{201c}', '\u{201e}', '\u{ab}']);
    Some(match bare.as_str() {
        "nan" | "inf" | "infinity" => {
            format!("{text} is not a number; give one, or leave the key out if there is none")
        }
        "true" | "false" => format!("write {bare} in small letters, not {text}"),
        "none" | "nil" => "leave the key out where there is no value".into(),
        _ if quotes => {
            format!("{text} must be in straight double quotation marks, like \"this\"")
        }
        _ if begins_key => {
            format!("the key {text} must be in double quotation marks: \"{text}\"")
        }
        _ if text.starts_with('#') => "a comment begins with //, not with #".into(),
        _ if bare.parse::<f64>().is_ok_and(f64::is_infinite) => {
            format!("{text} is larger than any number")
        }
        _ if bare.parse::<f64>().is_ok() => {
            format!(
                "{text} is not a number of JSON; write it with a digit on both sides of the point, without + or leading zeros"
            )
        }
        _ if bare.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            format!(
                "{text} is not a number; write digits and a decimal point alone, like 0.0028, without unit"
            )
        }
        _ => format!(
            "{text} is no value of JSON; write a number, true, false, or a text in double quotation marks"
        ),
    })
}

/// Message for an error of the parser that has a common cause.
fn of_parser(error: &serde_json::Error) -> Option<String> {
    let (said, line) = (error.to_string(), error.line());
    let message = [
        (
            "expected `,` or",
            "a comma is missing before this, or a bracket was closed too early",
        ),
        (
            "trailing characters",
            "trailing characters: more follows after its last bracket; remove it",
        ),
        (
            "invalid escape",
            "a backslash in a text must be doubled: \\\\",
        ),
        (
            "control character",
            "a text must end on its line; write \\n for a line break and \\t for a tab",
        ),
        (
            "expected `:`",
            "a colon is missing between the key and its value",
        ),
        ("recursion limit", "too many brackets within each other"),
    ];
    let known = message.iter().find(|(words, _)| said.starts_with(words));
    known.map(|(_, message)| format!("{message} (line {line})"))
}
