//! The saw whose collar holds the blade in its plane the other way.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::DesignError;
use crate::analyses::check::{Limits, check};
use crate::analyses::verdict::Verdict;
use crate::model::scene::{InPlane, Mount, Scene};

/// The verdict with the other condition in the plane of the blade at the edge of the collar. A flange lies between both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OtherClampEntry")]
pub struct OtherClamp {
    /// The other condition.
    pub in_plane: InPlane,
    /// First critical speed with it; null if there is none.
    pub first_critical_rpm: Option<f64>,
    /// Whether the saw can run with it.
    pub verdict: Verdict,
}

impl OtherClamp {
    /// The other case of a saw; `None` without a collar or an operating speed.
    ///
    /// # Errors
    /// [`DesignError`] if the other saw cannot be checked.
    pub(super) fn of(scene: &Scene) -> Result<Option<Self>, DesignError> {
        let Mount::Collar { in_plane, .. } = scene.file().mount else {
            return Ok(None);
        };
        let Some(operating_rpm) = scene.file().operating_rpm else {
            return Ok(None);
        };
        let other = match in_plane {
            InPlane::Fixed => InPlane::Free,
            InPlane::Free => InPlane::Fixed,
        };
        let changed = scene.edited(|file| {
            if let Mount::Collar { in_plane, .. } = &mut file.mount {
                *in_plane = other;
            }
        })?;
        let limits = Limits::of(&changed, operating_rpm)
            .map_err(|error| DesignError::Scene(error.into()))?;
        let found = check(&changed, &limits)?;
        Ok(Some(OtherClamp {
            in_plane: other,
            first_critical_rpm: found.first_critical_rpm,
            verdict: found.verdict,
        }))
    }

    /// Both cases in a sentence.
    pub(super) fn in_words(&self) -> String {
        let (condition, word) = match self.in_plane {
            InPlane::Fixed => ("holds the blade in its plane", "fixed"),
            InPlane::Free => ("lets the blade expand", "free"),
        };
        let answer = self.verdict.answer.map_or(String::new(), |answer| {
            format!("{}: ", answer.in_words().to_uppercase())
        });
        format!(
            "If the collar {condition} (mount.in_plane {word}): {answer}{}",
            self.verdict.in_one_line()
        )
    }
}
