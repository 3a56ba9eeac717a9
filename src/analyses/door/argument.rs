//! An argument of a command: a field of its options, or a number of the scene.

use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::{Value, json};

use super::{CommandOptions, SceneNumber};
use crate::model::scene::{Quantity, RefusedValue};

/// An argument of a command.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Argument {
    /// Name in Python, which ends in the unit.
    pub name: String,
    /// Name on the command line, without dashes; empty if it has none there.
    pub option: String,
    /// Kind of the value, and its default.
    pub kind: ArgumentKind,
    /// Path of the number of the scene that it replaces; empty if it replaces none.
    pub sets: String,
    /// Meaning.
    pub about: String,
    /// Name of an argument without which this one has no effect.
    #[serde(skip)]
    pub requires: Option<String>,
    /// The default as the command line shows it.
    #[serde(skip)]
    pub default: Option<String>,
}

/// Kind of an argument.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ArgumentKind {
    /// A number in the unit of its name, with a default if it has one.
    Number(Option<f64>),
    /// A whole number, with its default.
    Count(u64),
    /// Yes or no; no by default.
    Flag,
    /// One of several words, the first by default.
    Word(Vec<String>),
    /// A speed, or several; those of the scene by default.
    Speeds,
    /// Paths of numbers of the scene, with or without bounds.
    Bounds,
    /// Paths of numbers of the scene, with values.
    Values,
    /// A table of measured frequencies.
    Table,
    /// Words.
    Text,
}

/// Extension of the schema: name on the command line, where it is not the name without its unit.
const OPTION: &str = "x-option";
/// Extension of the schema: `bounds`, `values` or `table`.
const KIND: &str = "x-kind";
/// Endings of names of arguments that are units, or say what kind of number it is.
const ENDINGS: [&str; 6] = ["_m_per_s", "_share", "_rpm", "_deg", "_hz", "_m"];

impl Argument {
    /// All arguments of a command: the fields of its options, then the numbers of the scene.
    pub fn all<C: CommandOptions>() -> Vec<Self> {
        let mut all = Argument::of_schema::<C>();
        all.extend(C::SETS.iter().map(Argument::from));
        all
    }

    /// The fields of the options of a command.
    pub(super) fn of_schema<C: JsonSchema>() -> Vec<Self> {
        let schema = schema_for!(C).to_value();
        let fields = schema["properties"].as_object();
        let fields = fields.into_iter().flatten();
        fields
            .map(|(name, field)| Argument::of_field(name, field, &schema))
            .collect()
    }

    fn of_field(name: &str, field: &Value, schema: &Value) -> Self {
        let kind = ArgumentKind::of_field(field, schema);
        let option = field[OPTION].as_str().map_or_else(
            || {
                let mut endings = ENDINGS.iter().filter_map(|end| name.strip_suffix(end));
                endings.next().unwrap_or(name).replace('_', "-")
            },
            str::to_owned,
        );
        let default = match &kind {
            ArgumentKind::Number(Some(number)) if Quantity::unit_of(name) == "m" => {
                Some(format!("{}mm", 1e3 * number))
            }
            ArgumentKind::Number(number) => number.map(|number| number.to_string()),
            ArgumentKind::Count(count) => Some(count.to_string()),
            ArgumentKind::Word(words) => words.first().cloned(),
            _ => None,
        };
        Argument {
            name: name.to_owned(),
            option,
            kind,
            sets: String::new(),
            about: described(field),
            requires: None,
            default,
        }
    }

    /// Unit of a number by the ending of its name.
    pub fn unit(&self) -> &'static str {
        Quantity::unit_of(&self.name)
    }

    /// Refuses a word that is none of those allowed.
    pub(super) fn check_word(&self, value: &Value) -> Result<(), RefusedValue> {
        match &self.kind {
            ArgumentKind::Word(words) if !words.iter().any(|word| *value == json!(word)) => {
                let quoted: Vec<String> = words.iter().map(|word| format!("{word:?}")).collect();
                Err(RefusedValue::new(
                    &self.name,
                    value.to_string(),
                    quoted.join(" or "),
                    "name one of them",
                ))
            }
            _ => Ok(()),
        }
    }
}

impl From<&SceneNumber> for Argument {
    fn from(number: &SceneNumber) -> Self {
        Argument {
            name: number.name.to_owned(),
            option: number.option.to_owned(),
            kind: match Quantity::of(number.path) {
                Some(_) => ArgumentKind::Number(None),
                None => ArgumentKind::Flag,
            },
            sets: number.path.to_owned(),
            about: number.about.to_owned(),
            requires: number.requires.map(str::to_owned),
            default: None,
        }
    }
}

impl ArgumentKind {
    /// The kind that the schema of a field has. A field of another type has no words, which a test of all commands finds.
    fn of_field(field: &Value, schema: &Value) -> Self {
        let default = &field["default"];
        let type_of = |field: &Value| match &field["type"] {
            Value::Array(types) => types[0].as_str().unwrap_or_default().to_owned(),
            one => one.as_str().unwrap_or_default().to_owned(),
        };
        match (field[KIND].as_str(), type_of(field).as_str()) {
            (Some("bounds"), _) => ArgumentKind::Bounds,
            (Some("values"), _) => ArgumentKind::Values,
            (Some("table"), _) => ArgumentKind::Table,
            (_, "number") => ArgumentKind::Number(default.as_f64()),
            (_, "integer") => ArgumentKind::Count(default.as_u64().unwrap_or_default()),
            (_, "boolean") => ArgumentKind::Flag,
            (_, "array") => ArgumentKind::Speeds,
            (_, "string") => ArgumentKind::Text,
            _ => ArgumentKind::Word(words(field, schema)),
        }
    }
}

/// The words of an enumeration to which a field refers.
fn words(field: &Value, schema: &Value) -> Vec<String> {
    let pointer = field["$ref"].as_str().unwrap_or_default();
    let definition = schema.pointer(pointer.trim_start_matches('#'));
    let variants = definition.and_then(|of| of["oneOf"].as_array());
    let constants = variants.into_iter().flatten();
    constants
        .filter_map(|of| of["const"].as_str().map(str::to_owned))
        .collect()
}

/// The doc comment of a part of a schema on one line, without the stop at its end.
pub(crate) fn described(of: &Value) -> String {
    let text = of["description"].as_str().unwrap_or_default();
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").trim_end_matches('.').to_owned()
}
