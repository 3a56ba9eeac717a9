//! `sawflutter keys`.

use std::fmt::Write;

use serde_json::Value;

use crate::analyses::study;
use crate::scene::{self, Quantity};
use crate::summary::wrapped;
use crate::text::shown;
use clap::Args;

use super::common::say;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter keys          # every key of a scene
  sawflutter keys guides   # those whose path contains this word
  sawflutter keys --study  # those of a study";

#[derive(Args)]
pub struct Arguments {
    /// Keys whose path contains this; all by default
    word: Option<String>,
    /// Print the keys of a study instead
    #[arg(long)]
    study: bool,
}

/// Prints the keys of a scene, or of a study, each with its unit, default, usual range and meaning.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let schema = match arguments.study {
        true => study::json_schema(),
        false => scene::json_schema(),
    };
    let mut keys = Vec::new();
    below(&schema, &schema, "", &mut keys);
    let word = arguments.word.as_deref().unwrap_or_default();
    let mut text = String::new();
    for key in keys.iter().filter(|key| key.path.contains(word)) {
        let meaning = wrapped(&format!("- {}", key.meaning));
        writeln!(text, "{}\n{meaning}", key.heading())?;
    }
    Ok(say(&text)?)
}

/// A key of a schema.
struct Key {
    path: String,
    meaning: String,
    is_required: bool,
    default: Option<Value>,
}

impl Key {
    fn heading(&self) -> String {
        let quantity = Quantity::of(&self.path);
        let unit = quantity.map_or("", |quantity| quantity.unit);
        let mut parts = vec![self.path.clone()];
        parts.extend((!unit.is_empty()).then(|| format!("[{unit}]")));
        parts.extend(self.is_required.then(|| "required".to_owned()));
        let default = self.default.as_ref().filter(|value| !value.is_null());
        parts.extend(default.map(|value| format!("default {value}")));
        parts.extend(quantity.map(|quantity| {
            let (from, to) = quantity.usual;
            format!("saws have {} to {}", shown(from), shown(to))
        }));
        parts.join("  ")
    }
}

/// Collects the keys below a node of a schema in their order, each before the keys that it contains.
fn below(schema: &Value, node: &Value, path: &str, found: &mut Vec<Key>) {
    if let Some(name) = node["$ref"].as_str()
        && let Some(target) = schema.pointer(name.trim_start_matches('#'))
    {
        below(schema, target, path, found);
    }
    for word in ["anyOf", "oneOf", "allOf"] {
        for one in node[word].as_array().into_iter().flatten() {
            below(schema, one, path, found);
        }
    }
    if !node["items"].is_null() {
        below(schema, &node["items"], &format!("{path}[]"), found);
    }
    let required = node["required"].as_array();
    for (name, inner) in node["properties"].as_object().into_iter().flatten() {
        let dot = if path.is_empty() { "" } else { "." };
        let path = format!("{path}{dot}{name}");
        let is_known = found.iter().any(|key| key.path == path);
        if !is_known {
            let meaning = inner["description"].as_str().unwrap_or_default();
            found.push(Key {
                path: path.clone(),
                meaning: meaning.split_whitespace().collect::<Vec<_>>().join(" "),
                is_required: required.is_some_and(|all| all.iter().any(|own| own == name)),
                default: inner.get("default").cloned(),
            });
        }
        below(schema, inner, &path, found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::QUANTITIES;

    /// Every quantity of a scene is printed, so that users can find it.
    #[test]
    fn every_number_of_a_scene_is_a_key_with_a_meaning() {
        let schema = scene::json_schema();
        let mut keys = Vec::new();
        below(&schema, &schema, "", &mut keys);
        for quantity in QUANTITIES {
            let path = quantity.path.trim_end_matches("[]");
            let key = keys.iter().find(|key| key.path == path);
            let key = key.unwrap_or_else(|| panic!("{path}"));
            assert!(!key.meaning.is_empty(), "{path}");
        }
        let diameter = keys.iter().find(|key| key.path == "blade.outer_diameter_m");
        let heading = diameter.unwrap().heading();
        assert_eq!(
            heading,
            "blade.outer_diameter_m  [m]  required  saws have 0.04 to 5"
        );
    }
}
