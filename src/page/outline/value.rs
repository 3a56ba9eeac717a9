//! A number with its unit and digits, or a word in its place.

use crate::page::text::{fixed, shown_to};

/// Kind of a number: the unit in which it is shown, and the factor to it from the unit of reports.
#[derive(Debug, PartialEq)]
pub struct Measure {
    pub unit: &'static str,
    factor: f64,
    unit_of: Option<&'static str>,
}

const fn measure(unit: &'static str, factor: f64, unit_of: Option<&'static str>) -> Measure {
    Measure {
        unit,
        factor,
        unit_of,
    }
}

pub static SPEED: Measure = measure("rpm", 1.0, Some("operating_rpm"));
pub static FREQUENCY: Measure = measure("Hz", 1.0, Some("measured.rows[].frequencies_hz[]"));
pub static GROWTH: Measure = measure("1/s", 1.0, None);
/// A length from metres, shown in millimetres.
pub static LENGTH: Measure = measure("mm", 1e3, Some("blade.thickness_m"));
/// A length shown in metres.
pub static METRES: Measure = measure("m", 1.0, None);
pub static FORCE: Measure = measure("N", 1.0, None);
pub static STIFFNESS: Measure = measure("N/m", 1.0, Some("cut.washboarding.stiffness_n_per_m"));
pub static TIME: Measure = measure("s", 1.0, None);
pub static KELVIN: Measure = measure("K", 1.0, None);
/// A share, shown in percent.
pub static PERCENT: Measure = measure("%", 1e2, None);
pub static PLAIN: Measure = measure("", 1.0, None);

/// What stands in a table or after the name of a fact.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Number {
        /// The value in the unit of reports.
        value: f64,
        words: String,
        /// The unit of the words.
        unit: &'static str,
        /// Path of a number of scenes in the unit of reports; the live page shows it in the unit of its form.
        unit_of: Option<&'static str>,
    },
    Word(String),
    Missing,
}

impl Measure {
    /// A number with a number of decimals.
    pub fn fixed(&'static self, decimals: usize, value: impl Into<Option<f64>>) -> Value {
        self.value(value, |shown| fixed(decimals, shown))
    }

    /// A number with a number of significant digits.
    pub fn digits(&'static self, digits: usize, value: impl Into<Option<f64>>) -> Value {
        self.value(value, |shown| shown_to(digits, shown))
    }

    /// A change with its sign and a number of decimals.
    pub fn change(&'static self, decimals: usize, value: impl Into<Option<f64>>) -> Value {
        self.value(value, |shown| format!("{shown:+.decimals$}"))
    }

    fn value(
        &'static self,
        value: impl Into<Option<f64>>,
        in_words: impl FnOnce(f64) -> String,
    ) -> Value {
        match value.into() {
            None => Value::Missing,
            Some(value) => Value::Number {
                value,
                words: in_words(self.factor * value),
                unit: self.unit,
                unit_of: self.unit_of,
            },
        }
    }
}

impl Value {
    /// Replaces a missing number by a word.
    pub fn or(self, word: &str) -> Self {
        match self {
            Value::Missing => word.into(),
            known => known,
        }
    }

    /// The number without its unit, or the word.
    pub fn in_words(&self) -> String {
        match self {
            Value::Number { words, .. } | Value::Word(words) => words.clone(),
            Value::Missing => "–".to_owned(),
        }
    }

    /// The number with its unit, or the word.
    pub fn with_unit(&self) -> String {
        match self {
            Value::Number { words, unit, .. } => {
                format!("{words} {unit}").trim_end().replace(" °", "°")
            }
            other => other.in_words(),
        }
    }

    pub fn is_number(&self) -> bool {
        matches!(self, Value::Number { .. })
    }
}

impl From<&str> for Value {
    fn from(word: &str) -> Self {
        Value::Word(word.to_owned())
    }
}

impl From<String> for Value {
    fn from(word: String) -> Self {
        Value::Word(word)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        PLAIN.fixed(0, count as f64)
    }
}

#[cfg(feature = "page")]
impl serde::Serialize for Value {
    /// The words and their unit; for numbers whose unit is one of the form, also the value and the path that has it.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeMap;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("words", &self.in_words())?;
        if let Value::Number {
            value,
            unit,
            unit_of,
            ..
        } = self
        {
            map.serialize_entry("unit", unit)?;
            if let Some(path) = unit_of {
                map.serialize_entry("value", value)?;
                map.serialize_entry("unit_of", path)?;
            }
        }
        map.end()
    }
}
