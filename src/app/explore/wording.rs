//! Messages about refused numbers, in the units of their fields and with usual ranges.

use serde_json::Value;

use super::fields::{Field, FieldUnit, Units};
use crate::model::scene::{Quantity, RefusedValue};
use crate::page::text::{capitalized, shown_to};

/// Number of significant digits of a bound.
const DIGITS: usize = 6;
/// Units whose fields have labels, such as "from" and "idle", that are not clear without the form around them.
const UNCLEAR: [&str; 4] = ["rpm", "s", "1/s", "N per tooth"];

/// Message about the number at a path. `typed` is the value in the scene. `None` if the path is not that of a number, or
/// nothing is known about its range.
pub fn in_field_units(
    path: &str,
    typed: Option<&Value>,
    allowed: Option<&str>,
    units: Units,
) -> Option<String> {
    let field = Field::of(path)?;
    let unit = field.unit(units);
    let of = match unit.unit {
        "" => String::new(),
        unit => format!(", in {unit}"),
    };
    let subject = subject(&field);
    if typed.is_some_and(Value::is_array) {
        return Some(format!(
            "{subject} must be {}",
            converted(path, allowed?, unit)
        ));
    }
    let number = typed.and_then(Value::as_f64);
    let is_count = |number: f64| number >= 0.0 && number.fract() == 0.0;
    if field.whole && !number.is_some_and(is_count) {
        return Some(format!("{subject} must be a whole number"));
    }
    if number.is_none() {
        return Some(format!("{subject} must be a number{of}"));
    }
    Some(format!("{subject} {}", range(path, allowed?, &field, unit)))
}

/// Message about the text of a field that is no number.
pub fn unread(field: &Field, refused: &RefusedValue) -> String {
    let RefusedValue {
        allowed, remedy, ..
    } = refused;
    format!("{} must be {allowed}; {remedy}", subject(field))
}

/// Name of a field at the beginning of a sentence.
fn subject(field: &Field) -> String {
    capitalized(if UNCLEAR.contains(&field.unit(Units::Metric).unit) {
        field.name
    } else {
        &field.label
    })
}

/// Description of an allowed range: "must be …", or "is too large" for a bound that only prevents overflow.
fn range(path: &str, allowed: &str, field: &Field, unit: FieldUnit) -> String {
    let with_unit = |text: String| format!("{text} {}", unit.unit).trim_end().to_owned();
    let between = |ends: [f64; 2], word, digits| {
        let [from, to] = ends.map(|value| shown_to(digits, value * unit.scale));
        with_unit(format!("{from} {word} {to}"))
    };
    if let Some(ends) = ends(allowed) {
        return format!("must be between {}", between(ends, "and", DIGITS));
    }
    let Some(bound) = bound(allowed) else {
        return format!("must be {}", converted(path, allowed, unit));
    };
    let usual = between(field.usual.into(), "to", 3);
    match (bound.word, bound.value == 0.0) {
        (word, true) => format!("must be {}; usual: {usual}", with_unit(format!("{word} 0"))),
        ("at most", _) => format!("is too large; usual: {usual}"),
        _ => format!("is too small; usual: {usual}"),
    }
}

/// Reads both ends from a text such as "between 0 and 600".
fn ends(allowed: &str) -> Option<[f64; 2]> {
    let (from, to) = allowed.strip_prefix("between ")?.split_once(" and ")?;
    Some([from.parse().ok()?, to.parse().ok()?])
}

/// A bound that a number must be above or below.
struct Bound {
    word: &'static str,
    value: f64,
}

/// Reads a bound from a text such as "above 0, usual range 0.0001 to 0.04 m".
fn bound(allowed: &str) -> Option<Bound> {
    let (bound, _) = allowed.split_once(',').unwrap_or((allowed, ""));
    ["above", "at least", "at most"]
        .into_iter()
        .find_map(|word| {
            let value = bound.strip_prefix(word)?.trim().parse().ok()?;
            Some(Bound { word, value })
        })
}

/// A word, separated from the brackets and punctuation around it.
struct Word<'a> {
    before: &'a str,
    core: &'a str,
    after: &'a str,
}

impl<'a> Word<'a> {
    fn new(word: &'a str) -> Self {
        let core = word.trim_start_matches('(');
        let before = &word[..word.len() - core.len()];
        let short = core.trim_end_matches([')', ',', ';', ':', '.']);
        Word {
            before,
            core: short,
            after: &core[short.len()..],
        }
    }

    fn number(&self) -> Option<f64> {
        let digits = self.core.trim_start_matches('-');
        let number = self.core.parse().ok();
        number.filter(|_| digits.starts_with(|c: char| c.is_ascii_digit()))
    }

    fn with(&self, core: &str) -> String {
        format!("{}{core}{}", self.before, self.after)
    }
}

/// Converts numbers in a text to the unit of the field and replaces paths by names. A number that is followed by a word
/// other than the unit of the key, "and", "to" or "or", as in "30 diameters", is not converted.
fn converted(path: &str, allowed: &str, unit: FieldUnit) -> String {
    let si = Quantity::of(path).map_or("", |quantity| quantity.unit);
    let mut words = allowed.split(' ').map(Word::new).peekable();
    let mut told: Vec<String> = Vec::new();
    // `last` contains the position of the last number without a unit, and its text with the unit.
    let mut last: Option<(usize, String)> = None;
    while let Some(word) = words.next() {
        let Some(given) = word.number() else {
            told.push(word.with(&named(path, word.core)));
            continue;
        };
        let number = shown_to(DIGITS, given * unit.scale);
        let is_end = |next: &&Word<'_>| word.after.is_empty() && next.core == si && !si.is_empty();
        if let Some(end) = words.peek().filter(is_end) {
            told.push(format!(
                "{}{number} {}{}",
                word.before, unit.unit, end.after
            ));
            last = None;
            words.next();
            continue;
        }
        let joins = |next: &Word<'_>| ["and", "to", "or"].contains(&next.core);
        if word.after.is_empty() && !words.peek().is_none_or(joins) {
            told.push(word.with(word.core));
            continue;
        }
        let with_unit = format!("{number} {}", unit.unit);
        last = Some((told.len(), word.with(with_unit.trim_end())));
        told.push(word.with(&number));
    }
    // The last of several numbers without a unit gets the unit.
    if let Some((at, number)) = last {
        told[at] = number;
    }
    told.join(" ")
}

/// Returns the name of the quantity to which `word` is the path, which may be relative to the block of `path`. A word
/// that is not a path is returned unchanged.
fn named(path: &str, word: &str) -> String {
    let is_path = word.contains(['.', '_'])
        && word.starts_with(|c: char| c.is_ascii_lowercase())
        && word
            .bytes()
            .all(|c| c.is_ascii_alphanumeric() || b"._[]".contains(&c));
    if !is_path {
        return word.to_owned();
    }
    let block = path.rfind('.').map_or("", |end| &path[..=end]);
    let quantity = Quantity::of(word).or_else(|| Quantity::of(&format!("{block}{word}")));
    quantity.map_or_else(
        || word.replace('_', " "),
        |found| format!("the {}", found.name),
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::app::explore::refusal::Refusal;
    use crate::model::scene::Scene;

    /// Returns the message about a scene in which one number is replaced.
    fn told(path: &str, typed: &Value, units: Units) -> String {
        let mut scene = serde_json::to_value(Scene::paper().file()).unwrap();
        let mut place = &mut scene;
        for step in path.split(['.', '[']).map(|s| s.trim_end_matches(']')) {
            place = match step.parse::<usize>() {
                Ok(index) => &mut place[index],
                Err(_) => &mut place[step],
            };
        }
        *place = typed.clone();
        let text = scene.to_string();
        let raw = Refusal::from(Scene::from_json(&text).unwrap_err());
        assert_eq!(raw.key.as_deref(), Some(path));
        let refusal = raw.in_field(&text, units);
        refusal
            .told
            .unwrap_or_else(|| panic!("{path}: {}", refusal.message))
    }

    #[test]
    fn numbers_are_refused_in_the_unit_of_their_field() {
        let cases = [
            (
                "blade.outer_diameter_m",
                json!(1e25),
                "Outer diameter is too large; usual: 40 to 5000 mm",
            ),
            (
                "blade.thickness_m",
                json!(-1.0),
                "Thickness must be above 0 mm; usual: 0.1 to 40 mm",
            ),
            ("blade.teeth", json!(2.5), "Teeth must be a whole number"),
            (
                "blade.material.poisson_ratio",
                json!(0.7),
                "Poisson ratio must be above -1 and below 0.5",
            ),
            (
                "guides[0].radius_m",
                json!(0.9),
                "Radius must be such that the pad lies on the blade, which reaches from r = 100 to 355 mm",
            ),
            (
                "guides[0].stiffness_n_per_m",
                json!("stiff"),
                "Stiffness must be a number, in MN/m",
            ),
            (
                "guides[0].tangential_length_m",
                json!(0.0),
                "Tangential length must be zero exactly when the radial length of the guide is",
            ),
            (
                "cut.depth_m",
                json!(0.8),
                "Depth must be at most the blade's diameter (710 mm)",
            ),
            (
                "cut.idle_s",
                json!(601.0),
                "Time before and after the cut must be between 0 and 600 s",
            ),
        ];
        for (path, typed, wanted) in cases {
            assert_eq!(told(path, &typed, Units::Metric), wanted);
        }
        let mut scene = serde_json::to_value(Scene::paper().file()).unwrap();
        scene["guides"][0]["controller"] = json!({ "numerator": [1, 1, 1, 1], "denominator": [1] });
        let text = scene.to_string();
        let refusal = Refusal::from(Scene::from_json(&text).unwrap_err());
        assert_eq!(
            refusal.in_field(&text, Units::Metric).told.as_deref(),
            Some("Numerator must be 1 to 2 numbers, with this denominator")
        );
        assert_eq!(
            told("guides[0].radius_m", &json!(0.9), Units::Inches),
            "Radius must be such that the pad lies on the blade, which reaches from r = 3.93701 to 13.9764 in"
        );
    }

    #[test]
    fn texts_of_fields_are_read_in_their_unit_or_refused_in_it() {
        for (path, text, units, value) in [
            ("blade.thickness_m", "2.6", Units::Metric, 0.0026),
            ("blade.thickness_m", "1/8", Units::Inches, 0.003_175),
            ("blade.thickness_m", "2.6mm", Units::Inches, 0.0026),
            ("guides[0].stiffness_n_per_m", "20", Units::Metric, 2e7),
            ("cut.radial_n_per_tooth", "75", Units::Metric, 75.0),
        ] {
            let read = Field::read(path, text, units).unwrap();
            assert_eq!(read, value, "{path} {text}");
        }
        for (path, text, wanted) in [
            (
                "guides[0].stiffness_n_per_m",
                "stiff",
                "Stiffness must be a number in MN/m, or with a unit of the same kind; write it like 20 or 2e1, with or without a unit",
            ),
            (
                "operating_rpm",
                "1,800",
                "Operating speed must be 1800 or 1.8; write one of these",
            ),
        ] {
            let refusal = Field::read(path, text, Units::Metric).unwrap_err();
            assert_eq!(refusal.told.as_deref(), Some(wanted));
            assert_eq!(refusal.key.as_deref(), Some(path));
        }
    }
}
