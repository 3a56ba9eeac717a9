//! Excitation whose frequency is a multiple of the rotation speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::rule::{is_default, needed_teeth};

/// Lines of the Campbell diagram at multiples of the rotation speed, and their crossings with the natural
/// frequencies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExcitationFile {
    /// Lines 1×, 2×, … up to this multiple of the rotation speed: frequencies at which a warped or unbalanced
    /// blade excites itself at the guides. None by default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub orders: u32,
    /// Lines at the tooth passing frequency, which is the number of teeth times the rotation speed,
    /// and at its multiples up to this one. None by default.
    #[serde(default, skip_serializing_if = "is_default")]
    pub tooth_passing: u32,
}

/// A validated line: a frequency that is a multiple of the rotation speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExcitationLine {
    /// Ratio of the frequency to the rotation speed.
    pub order: u32,
    /// Multiple of the tooth passing frequency, if the line was given as one.
    pub tooth_passing: Option<u32>,
}

impl ExcitationLine {
    /// The lines of a scene, ascending and without duplicates.
    pub(super) fn of(
        typed: Option<ExcitationFile>,
        teeth: Option<u32>,
    ) -> Result<Vec<Self>, SceneError> {
        let Some(typed) = typed else {
            return Ok(Vec::new());
        };
        let mut lines: Vec<Self> = (1..=typed.orders)
            .map(|order| ExcitationLine {
                order,
                tooth_passing: None,
            })
            .collect();
        if typed.tooth_passing > 0 {
            let reason = "where excitation.tooth_passing is given";
            let teeth = needed_teeth(teeth, reason, "give the number of teeth")?;
            let multiples: Vec<Self> = (1..=typed.tooth_passing)
                .map(|multiple| ExcitationLine {
                    order: multiple.saturating_mul(teeth),
                    tooth_passing: Some(multiple),
                })
                .collect();
            // A line whose order is also a multiple of tooth passing is listed only as this multiple.
            lines.retain(|line| multiples.iter().all(|other| other.order != line.order));
            lines.extend(multiples);
        }
        lines.sort_by_key(|line| line.order);
        Ok(lines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;

    fn lines(orders: u32, tooth_passing: u32, teeth: Option<u32>) -> Result<Vec<u32>, String> {
        let scene = Scene::paper()
            .edited(|saw| {
                saw.cut = None;
                saw.blade.teeth = teeth;
                saw.excitation = Some(ExcitationFile {
                    orders,
                    tooth_passing,
                });
            })
            .map_err(|error| error.to_string())?;
        Ok(scene.excitation().iter().map(|line| line.order).collect())
    }

    #[test]
    fn lines_are_multiples_of_the_speed_and_of_the_teeth() {
        assert_eq!(lines(3, 0, None).unwrap(), [1, 2, 3]);
        assert_eq!(lines(2, 2, Some(42)).unwrap(), [1, 2, 42, 84]);
        assert_eq!(lines(4, 2, Some(2)).unwrap(), [1, 2, 3, 4]);
        assert!(
            lines(0, 1, None)
                .unwrap_err()
                .contains("blade.teeth is missing")
        );
    }
}
