//! Keys of a scene with their values.

use serde_json::Value;

use super::quantity::Quantity;
use super::{RefusedValue, SceneFile};

/// Keys that do not influence a computation.
const NO_INPUTS: [&str; 4] = ["$schema", "name", "notes", "measured"];

/// A value of a scene with its JSON path.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry<T = Value> {
    pub path: String,
    pub value: T,
}

impl SceneFile {
    /// Every value that may influence a computation, in the order of the file.
    pub(crate) fn inputs(&self) -> Vec<Entry> {
        let mut json = value(self);
        if let Some(keys) = json.as_object_mut() {
            keys.retain(|key, _| !NO_INPUTS.contains(&key.as_str()));
        }
        let mut found = Vec::new();
        below(json, "", &mut found);
        found.retain(|entry| !entry.value.is_null());
        found
    }

    /// Whether the key at a path has the value that the program takes for a scene without the key.
    pub(crate) fn is_default(&self, path: &str) -> bool {
        let pointer = format!("/{}", path.replace(['.', '['], "/").replace(']', ""));
        let (block, key) = pointer.rsplit_once('/').unwrap_or_default();
        let mut json = value(self);
        let block = json.pointer_mut(block).and_then(Value::as_object_mut);
        let Some(_) = block.and_then(|block| block.remove(key)) else {
            return false;
        };
        serde_json::from_value::<SceneFile>(json).is_ok_and(|without| without == *self)
    }

    /// Every value, in the order of the file. A number that is not finite is null.
    pub(super) fn values(&self) -> Vec<Entry> {
        let mut found = Vec::new();
        below(value(self), "", &mut found);
        found
    }

    /// Every number, in the order of the file.
    pub(super) fn numbers(&self) -> Vec<Entry<f64>> {
        let number = |Entry { path, value }: Entry| {
            let value = value.as_f64()?;
            Some(Entry { path, value })
        };
        self.values().into_iter().filter_map(number).collect()
    }

    /// Checks that every number of a scene is in its allowed range. Rules that join several keys remain to be checked.
    pub(super) fn check_numbers(&self) -> Result<(), RefusedValue> {
        for Entry { path, value } in self.values() {
            let Some(quantity) = Quantity::of(&path) else {
                continue;
            };
            match value {
                // An entry of a list may be null, a key is left out.
                Value::Null if path.ends_with(']') => (),
                Value::Null => return Err(quantity.refused(&path, f64::NAN, "no finite number")),
                value => {
                    let number = value.as_f64().unwrap_or(f64::NAN);
                    quantity.checked(&path, number)?;
                }
            }
        }
        Ok(())
    }
}

/// The scene as a JSON value.
pub(super) fn value(scene: &SceneFile) -> Value {
    serde_json::to_value(scene).expect("keys are strings and numbers of a scene finite")
}

/// Formats a value for a reader: a text without quotation marks.
pub(crate) fn in_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Appends every text, number, truth value and null below a JSON value, with its path.
fn below(value: Value, path: &str, found: &mut Vec<Entry>) {
    match value {
        Value::Object(json) => {
            let dot = if path.is_empty() { "" } else { "." };
            for (key, inner) in json {
                below(inner, &format!("{path}{dot}{key}"), found);
            }
        }
        Value::Array(list) => {
            for (k, inner) in list.into_iter().enumerate() {
                below(inner, &format!("{path}[{k}]"), found);
            }
        }
        value => found.push(Entry {
            path: path.to_owned(),
            value,
        }),
    }
}

#[cfg(test)]
mod tests {
    use crate::model::scene::Scene;

    #[test]
    fn a_default_is_what_a_scene_without_the_key_has() {
        let mut saw = Scene::paper().file().clone();
        assert!(!saw.is_default("blade.thickness_m") && !saw.is_default("guides[0].radius_m"));
        assert!(saw.is_default("flutter_threshold_per_s"));
        saw.flutter_threshold_per_s = 0.5;
        assert!(!saw.is_default("flutter_threshold_per_s"));
    }
}
