//! Errors as the page shows them: at the field of the quantity that causes them, in its unit.

use serde::Serialize;
use serde_json::Value;

use super::fields::Units;
use super::wording::in_field_units;
use crate::analyses::door::CommandError;
use crate::model::scene::{RefusedValue, Scene, SceneError};
use crate::modes::SpectrumError;
use crate::stability::AnalysisError;

/// An error, with the quantity that causes it.
#[derive(Debug, Serialize)]
pub struct Refusal {
    /// JSON path of the quantity, if there is one.
    pub key: Option<String>,
    /// Message of the library, in the unit of the key.
    pub message: String,
    /// Message in the unit of the field of this quantity, if it has one.
    pub told: Option<String>,
    /// Unusual numbers of the scene beside the refused one, which may be the cause.
    pub unusual: Vec<String>,
    /// Allowed values of a number of the scene.
    #[serde(skip)]
    allowed: Option<String>,
}

impl From<RefusedValue> for Refusal {
    fn from(error: RefusedValue) -> Self {
        Refusal {
            allowed: Some(error.allowed.clone()),
            key: Some(error.key.clone()),
            ..Refusal::of(&error)
        }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Value(refused) => refused.into(),
            SceneError::Syntax { ref key, .. } => Refusal {
                key: Some(key.clone()),
                ..Refusal::of(&error)
            },
            _ => Refusal::of(&error),
        }
    }
}

impl From<CommandError> for Refusal {
    fn from(error: CommandError) -> Self {
        match error {
            CommandError::Refused(refused) => refused.into(),
            CommandError::Set { source, .. } | CommandError::Scene(source) => source.into(),
            CommandError::Unanswered { .. } | CommandError::Failed(_) => Refusal::of(&error),
        }
    }
}

impl From<AnalysisError> for Refusal {
    fn from(error: AnalysisError) -> Self {
        let key = match &error {
            AnalysisError::Unresolved { key, .. }
            | AnalysisError::Overstretched { key, .. }
            | AnalysisError::TooLong { key, .. } => Some((*key).to_owned()),
            AnalysisError::TooNarrow { .. } => Some("mount.diameter_m".to_owned()),
            _ => None,
        };
        Refusal {
            key,
            ..Refusal::of(&error)
        }
    }
}

impl From<SpectrumError> for Refusal {
    fn from(error: SpectrumError) -> Self {
        Refusal::of(&error)
    }
}

impl Refusal {
    /// Refusal of a request about a diagram that is no longer kept.
    pub fn gone(chart: usize) -> Self {
        Refusal::with_message(format!(
            "chart {chart} was replaced by later ones; compute it again"
        ))
    }

    /// Refusal with the message of an error that no quantity causes.
    pub fn of(error: &dyn std::error::Error) -> Self {
        Refusal::with_message(error.to_string())
    }

    /// Refusal with a message about no quantity of the scene.
    pub fn with_message(message: impl Into<String>) -> Self {
        Refusal {
            key: None,
            message: message.into(),
            told: None,
            unusual: Vec::new(),
            allowed: None,
        }
    }

    /// Adds a message in the unit of the field.
    pub fn telling(self, told: String) -> Self {
        let told = Some(told);
        Refusal { told, ..self }
    }

    /// Adds the message in the unit of the field, unless there is one, and the unusual numbers of the scene. `request` is the JSON of a
    /// scene, or contains one under `scene`.
    pub fn in_field(mut self, request: &str, units: Units) -> Self {
        let request: Value = serde_json::from_str(request).unwrap_or_default();
        let scene = request.get("scene").unwrap_or(&request);
        if let Ok(file) = Scene::file_from_json(&scene.to_string()) {
            self.unusual = file.unusual_numbers_beside(self.key.as_deref());
        }
        if let (Some(key), None) = (&self.key, &self.told) {
            self.told = in_field_units(key, at(scene, key), self.allowed.as_deref(), units);
        }
        self
    }
}

/// Returns the value at a path such as `guides[0].radius_m`.
fn at<'a>(scene: &'a Value, path: &str) -> Option<&'a Value> {
    let steps = path.split(['.', '[']);
    steps
        .map(|step| step.trim_end_matches(']'))
        .try_fold(scene, |part, step| match part {
            Value::Array(list) => list.get(step.parse::<usize>().ok()?),
            _ => part.get(step),
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A modulus in GPa makes the first critical speed 2 rpm, below a sweep that is refused for it: the page names the modulus, too, and
    /// not the refused number twice.
    #[test]
    fn a_refusal_names_the_other_unusual_numbers_of_the_scene() {
        let mut scene = Scene::paper().file().clone();
        scene.blade.material.youngs_modulus_pa = 203.0;
        let text = serde_json::json!({ "scene": scene }).to_string();
        let refused = |key: &str| {
            let refused = RefusedValue::new(key, 1e8, "at most 2", "give a lower speed");
            Refusal::from(refused)
                .in_field(&text, Units::default())
                .unusual
        };
        let [unusual] = &refused("sweep.to_rpm")[..] else {
            panic!("{:?}", refused("sweep.to_rpm"));
        };
        assert!(unusual.contains("203"), "{unusual}");
        assert!(refused("blade.material.youngs_modulus_pa").is_empty());
    }
}
