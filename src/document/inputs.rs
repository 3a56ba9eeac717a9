//! Numbers of a scene as rows of a table.

use serde_json::Value;

use super::Table;
use crate::scene::{Quantity, SceneFile};
use crate::text::shown;

/// Keys that another part of the page shows, or that hold data for comparison.
const ELSEWHERE: [&str; 3] = ["name", "notes", "measured"];

/// Key, meaning, value with its unit.
pub fn inputs(scene: &SceneFile) -> Table {
    let entries = scene.entries().into_iter();
    let entries = entries.filter(|(path, _)| {
        let first = path.split(['.', '[']).next().unwrap_or_default();
        !ELSEWHERE.contains(&first)
    });
    let rows = entries.map(|(path, value)| {
        let quantity = Quantity::of(&path);
        let meaning = quantity.map_or("", |quantity| quantity.name);
        let value = match (value.as_f64(), quantity.map(|quantity| quantity.unit)) {
            (Some(number), None | Some("")) => shown(number),
            (Some(number), Some(unit)) => format!("{} {unit}", shown(number)),
            (None, _) => in_words(&value),
        };
        vec![path, meaning.to_owned(), value]
    });
    Table {
        title: String::new(),
        columns: vec!["key", "meaning", "value"],
        rows: rows.collect(),
    }
}

fn in_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
