//! The inputs of a study, which its log repeats in its first line.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::file::StudyFile;
use super::plan::Study;
use crate::model::scene::SceneFile;

/// The scene, the study and the version of the program, on which the result of a saw depends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inputs {
    /// Version of the program.
    pub sawflutter: String,
    /// The scene.
    pub scene: SceneFile,
    /// The study.
    pub study: StudyFile,
}

impl Inputs {
    /// The inputs of a study.
    pub fn of(study: &Study) -> Self {
        Inputs {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: study.scene().file().clone(),
            study: study.file().clone(),
        }
    }

    /// Describes the first difference to other inputs: "`scene.guides[0].radius_m` is 0.2 there and 0.25
    /// here".
    pub fn difference(&self, here: &Inputs) -> Option<String> {
        let value = |inputs: &Inputs| serde_json::to_value(inputs).unwrap_or_default();
        difference("", &value(self), &value(here))
    }
}

fn difference(path: &str, there: &Value, here: &Value) -> Option<String> {
    match (there, here) {
        (Value::Object(there), Value::Object(here)) => {
            let mut keys: Vec<&String> = there.keys().chain(here.keys()).collect();
            keys.dedup();
            let dot = if path.is_empty() { "" } else { "." };
            keys.into_iter().find_map(|key| {
                let none = &Value::Null;
                let (there, here) = (there.get(key), here.get(key));
                let path = format!("{path}{dot}{key}");
                difference(&path, there.unwrap_or(none), here.unwrap_or(none))
            })
        }
        (Value::Array(there), Value::Array(here)) if there.len() == here.len() => {
            let mut pairs = there.iter().zip(here).enumerate();
            pairs.find_map(|(k, (there, here))| difference(&format!("{path}[{k}]"), there, here))
        }
        _ if there == here => None,
        _ => Some(format!(
            "{path} is {} there and {} here",
            brief(there),
            brief(here)
        )),
    }
}

fn brief(value: &Value) -> String {
    match value {
        Value::Null => "missing".into(),
        Value::Array(items) => format!("a list of {}", items.len()),
        Value::Object(_) => "a block".into(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;

    #[test]
    fn the_number_that_differs_is_named() {
        let text = r#"{"name": "x", "parameters": []}"#;
        let one = Inputs {
            sawflutter: "1".into(),
            scene: Scene::paper().file().clone(),
            study: StudyFile::from_json(text).unwrap(),
        };
        let mut other = one.clone();
        assert_eq!(one.difference(&other), None);
        other.scene.guides[0].radius_m = 0.25;
        let words = "scene.guides[0].radius_m is 0.2 there and 0.25 here";
        assert_eq!(one.difference(&other).unwrap(), words);
        other = one.clone();
        other.study.saws = Some(3);
        let missing = "study.saws is missing there and 3 here";
        assert_eq!(one.difference(&other).unwrap(), missing);
    }
}
