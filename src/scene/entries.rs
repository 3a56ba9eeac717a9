//! Keys of a scene with their values.

use serde_json::Value;

use super::SceneFile;

impl SceneFile {
    /// Every key with a value of its own, by its JSON path, in the order of the file.
    pub(crate) fn entries(&self) -> Vec<(String, Value)> {
        let mut found = Vec::new();
        if let Ok(json) = serde_json::to_value(self) {
            below(json, "", &mut found);
        }
        found
    }
}

fn below(value: Value, path: &str, found: &mut Vec<(String, Value)>) {
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
        Value::Null => (),
        single => found.push((path.to_owned(), single)),
    }
}
