//! Errors as the page shows them: at the field of the quantity that causes them, in its unit.

use serde::Serialize;
use serde_json::Value;

use super::fields::Units;
use super::wording::in_field_units;
use crate::analyses::door::CommandError;
use crate::model::scene::{RefusedValue, SceneError};
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
            allowed: None,
        }
    }

    /// Adds a message in the unit of the field.
    pub fn telling(self, told: String) -> Self {
        let told = Some(told);
        Refusal { told, ..self }
    }

    /// Adds the message in the unit of the field, unless there is one. `request` is the JSON of a scene, or contains one under `scene`.
    pub fn in_field(mut self, request: &str, units: Units) -> Self {
        let request: Value = serde_json::from_str(request).unwrap_or_default();
        let scene = request.get("scene").unwrap_or(&request);
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
