//! The text of an option, as typed on the command line or in the live page.

use serde_json::{Value, json};

use super::{Argument, ArgumentKind};
use crate::model::scene::{
    NamedBounds, NamedValues, Reading, RefusedValue, number_in, number_of, numbers_of,
};

/// The number of a scene whose usual range decides how the text of a speed is read.
const SPEED: &str = "operating_rpm";
/// Name of the number in messages; the face puts the name of the option before them.
const IT: &str = "it";

impl Argument {
    /// Reads the text of a value.
    ///
    /// # Errors
    /// What the text must be, in words.
    pub fn read(&self, text: &str) -> Result<Value, String> {
        let number = |read: Result<f64, RefusedValue>| {
            let value = read.map_err(|refused| refused.to_string())?;
            if value.is_finite() {
                Ok(json!(value))
            } else {
                Err("it must be a finite number".to_owned())
            }
        };
        match &self.kind {
            // A bare number could be in metres, as in a scene, or in millimetres.
            ArgumentKind::Number(_)
                if self.unit() == "m" && text.trim().ends_with(|c: char| c.is_ascii_digit()) =>
            {
                Err("it must be a length with its unit; write it like 0.1mm".to_owned())
            }
            ArgumentKind::Number(_) if !self.sets.is_empty() => {
                number(Reading::of(&self.sets).and_then(|reading| reading.named(IT).number(text)))
            }
            ArgumentKind::Number(_) => match self.unit() {
                "rpm" => {
                    number(Reading::of(SPEED).and_then(|reading| reading.named(IT).number(text)))
                }
                unit => number(number_in(IT, unit, text)),
            },
            ArgumentKind::Count(_) => match text.trim().parse::<u64>() {
                Ok(count) => Ok(json!(count)),
                Err(_) => Err("it must be a whole number, 0 or more".to_owned()),
            },
            ArgumentKind::Speeds => match numbers_of(IT, SPEED, text) {
                Ok(speeds) => Ok(json!(speeds)),
                Err(refused) => Err(refused.to_string()),
            },
            ArgumentKind::Bounds => Ok(json!([named_bounds(text)?])),
            ArgumentKind::Values => Ok(json!([named_values(text)?])),
            ArgumentKind::Flag
            | ArgumentKind::Word(_)
            | ArgumentKind::Table
            | ArgumentKind::Text => Ok(json!(text)),
        }
    }
}

/// Reads a path of the scene with or without bounds: `guides[0].radius_m=0.15..0.3`.
///
/// # Errors
/// What the text must be, in words.
pub fn named_bounds(text: &str) -> Result<NamedBounds, String> {
    let Some((name, range)) = text.split_once('=') else {
        return Ok((text.trim().to_owned(), None));
    };
    let Some((from, to)) = range.split_once("..") else {
        return Err(format!(
            "the range must be two numbers (you gave {range:?}); write it like 0.15..0.3"
        ));
    };
    let path = name.trim();
    let bound = |bound: &str| number_of(path, bound).map_err(|refused| refused.to_string());
    let from = with_unit_of(to, from);
    Ok((path.to_owned(), Some((bound(&from)?, bound(to)?))))
}

/// A number with the unit that stands behind another one, if it has none of its own: 2 of `2..3mm` is 2 mm.
fn with_unit_of(other: &str, number: &str) -> String {
    let behind = |text: &str| {
        let digits = text.rfind(|c: char| c.is_ascii_digit());
        digits.map_or(0, |last| last + 1)
    };
    let is_bare = number.trim().parse::<f64>().is_ok();
    let unit = &other[behind(other)..];
    format!("{number}{}", if is_bare { unit } else { "" })
}

/// Reads a path of the scene with values: `blade.thickness_m=2.0mm,2.2mm,2.4mm`.
fn named_values(text: &str) -> Result<NamedValues, String> {
    let Some((name, values)) = text.split_once('=') else {
        return Err(format!(
            "it must have values (you gave {text:?}); write it like blade.thickness_m=2.0mm,2.2mm"
        ));
    };
    let path = name.trim();
    let read = numbers_of(path, path, values).map_err(|refused| refused.to_string())?;
    Ok((path.to_owned(), read))
}
