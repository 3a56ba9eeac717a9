//! `sawflutter keys`.

use serde_json::Value;

use crate::analyses::study;
use crate::model::scene::{self, Key, Quantity};
use crate::page::outline::wrapped;
use crate::page::text::shown;
use clap::Args;

use super::common::say;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter keys             # every key of a scene
  sawflutter keys guides      # those with this word in their path or their text
  sawflutter keys feed speed  # those with both words
  sawflutter keys --study     # those of a study

Exit code: 0 some keys have these words, 1 none has.";

#[derive(Args)]
pub struct Arguments {
    /// Words in the path or the text of a key; all keys by default
    words: Vec<String>,
    /// Print the keys of a study instead
    #[arg(long)]
    study: bool,
}

/// Prints the keys of a scene, or of a study. Returns whether there are any with these words.
pub fn run(arguments: &Arguments) -> anyhow::Result<bool> {
    let words = arguments.words.join(" ");
    let found = listed(&words, arguments.study);
    if found.is_empty() {
        eprintln!("nothing found for {words:?}; `sawflutter keys` without a word prints all keys");
    }
    say(&found)?;
    Ok(!found.is_empty())
}

/// The keys of a scene, or of a study, with all these words in their path or their text, each with its unit, default, usual range and
/// meaning; those with the words in their path come first.
pub fn listed(words: &str, of_study: bool) -> String {
    let schema = if of_study {
        study::json_schema()
    } else {
        scene::json_schema()
    };
    let has_words = |text: &str| {
        let text = text.to_lowercase();
        let mut words = words.split_whitespace();
        words.all(|word| text.contains(&word.to_lowercase()))
    };
    // The entries of a list are described with the list.
    let mut keys = scene::keys(&schema);
    keys.retain(|key| !key.path.ends_with("[]"));
    let (by_path, others): (Vec<Key>, Vec<Key>) =
        keys.into_iter().partition(|key| has_words(&key.path));
    let by_path = by_path.iter().map(|key| printed(key, &schema));
    let others = others.iter().map(|key| printed(key, &schema));
    by_path
        .chain(others.filter(|text| has_words(text)))
        .collect()
}

/// A key with its meaning below.
fn printed(key: &Key, schema: &Value) -> String {
    let mut text = heading(key, schema) + "\n";
    for line in lines(key, schema) {
        let line: Vec<&str> = line.split_whitespace().collect();
        text += &wrapped(&format!("- {}", line.join(" ")));
        text += "\n";
    }
    text
}

/// The path of a key with its unit, what requires it, its default and its ranges.
fn heading(key: &Key, schema: &Value) -> String {
    let node = schema.pointer(&key.pointer).unwrap_or(&Value::Null);
    let mut parts = vec![key.path.clone()];
    let number = if node["items"].is_null() {
        node
    } else {
        &node["items"]
    };
    parts.extend(number["x-unit"].as_str().map(|unit| format!("[{unit}]")));
    let block = key.path.rsplit_once('.').map_or("", |(block, _)| block);
    let required = match block {
        "" => "required".to_owned(),
        block => format!("required in {block}"),
    };
    parts.extend(key.is_required.then_some(required));
    parts.extend(key.of_kind.as_ref().map(|kind| format!("of kind {kind:?}")));
    let default = node.get("default").filter(|value| !value.is_null());
    parts.extend(default.map(|value| format!("default {value}")));
    if let Some(quantity) = number["x-name"].as_str().and_then(|_| of_list(&key.path)) {
        let allowed = quantity.allowed;
        parts.extend((!allowed.is_far()).then(|| allowed.in_words()));
        let (from, to) = quantity.usual;
        parts.push(format!("usual range {} to {}", shown(from), shown(to)));
    }
    parts.join("  ")
}

/// The quantity of a key or of the entries of its list.
fn of_list(path: &str) -> Option<&'static Quantity> {
    Quantity::of(path).or_else(|| Quantity::of(&format!("{path}[]")))
}

/// The meaning of a key, and the texts that its value may be with the meaning of each.
fn lines(key: &Key, schema: &Value) -> Vec<String> {
    let node = schema.pointer(&key.pointer).unwrap_or(&Value::Null);
    let mut lines = vec![meaning(node).to_owned()];
    if let Some(block) = key.path.strip_suffix(".kind") {
        let of_block = scene::keys(schema)
            .into_iter()
            .find(|key| key.path == block);
        let block = of_block.and_then(|block| schema.pointer(&block.pointer));
        choices(
            schema,
            block.unwrap_or(&Value::Null),
            "/properties/kind",
            &mut lines,
        );
    } else {
        choices(schema, node, "", &mut lines);
    }
    lines.retain(|line| !line.is_empty());
    lines
}

/// Appends the constant texts at a pointer in the variants of a node, each with its meaning.
fn choices(schema: &Value, node: &Value, pointer: &str, lines: &mut Vec<String>) {
    if let Some(name) = node["$ref"].as_str() {
        let target = schema.pointer(name.trim_start_matches('#'));
        choices(schema, target.unwrap_or(&Value::Null), pointer, lines);
    }
    for word in ["oneOf", "anyOf"] {
        for variant in node[word].as_array().into_iter().flatten() {
            choices(schema, variant, pointer, lines);
        }
    }
    let text = node.pointer(pointer).and_then(|own| own.get("const"));
    lines.extend(text.map(|text| format!("{text}: {}", meaning(node))));
}

fn meaning(node: &Value) -> &str {
    node["description"].as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::QUANTITIES;

    #[test]
    fn keys_are_found_by_their_path_and_by_their_text() {
        let first = |words: &str| {
            let found = listed(words, false);
            found
                .split_whitespace()
                .next()
                .unwrap_or_default()
                .to_owned()
        };
        for (words, key) in [
            ("Kerf", "blade.thickness_m"),
            ("feed board", "cut.feed_m_per_s"),
            ("thickness", "blade.thickness_m"),
        ] {
            assert_eq!(first(words), key, "{words}");
        }
        assert_eq!(listed("foo", false), "");
    }

    /// The heading and the lines below of a key.
    fn parts(path: &str) -> [String; 2] {
        let schema = scene::json_schema();
        let key = scene::keys(&schema)
            .into_iter()
            .find(|key| key.path == path)
            .expect(path);
        [heading(&key, &schema), lines(&key, &schema).join("\n")]
    }

    /// Every quantity of a scene is printed, so that users can find it.
    #[test]
    fn every_number_of_a_scene_is_a_key_with_a_meaning() {
        for quantity in QUANTITIES {
            let path = quantity.path.trim_end_matches("[]");
            let [heading, meaning] = parts(path);
            assert!(!meaning.trim().is_empty(), "{path}");
            assert!(heading.contains("usual range "), "{heading}");
        }
        let [heading, _] = parts("blade.outer_diameter_m");
        assert_eq!(
            heading,
            "blade.outer_diameter_m  [m]  required in blade  usual range 0.04 to 5"
        );
        let [of_mount, _] = parts("mount.diameter_m");
        assert!(
            of_mount.contains("required in mount  of kind \"collar\""),
            "{of_mount}"
        );
    }

    #[test]
    fn a_key_that_is_no_number_names_what_it_may_be() {
        for (path, words) in [
            (
                "mount.kind",
                &["\"collar\": Clamped between", "flange", "\"spline\": Loose"][..],
            ),
            (
                "mount.in_plane",
                &["\"fixed\": No radial displacement", "\"free\": "],
            ),
            ("guides[].shape", &["\"rectangle\": ", "\"round\": "]),
            ("guides[].contact", &["\"linear\": ", "\"one_sided\": "]),
            (
                "guides[].side",
                &["\"both\": ", "\"left\": ", "\"right\": "],
            ),
            ("accuracy", &["\"draft\": 1 %"]),
        ] {
            let [_, lines] = parts(path);
            for word in words {
                assert!(lines.contains(word), "{path}: {lines}");
            }
        }
    }
}
