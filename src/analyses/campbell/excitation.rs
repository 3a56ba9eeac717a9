//! Excitation lines at multiples of the rotation speed, and their crossings with the branches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::branches::Numbered;
use crate::model::scene::{ExcitationLine, Scene, rpm};
use crate::stability::Crossing;

/// Excitation at multiples of the rotation speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ExcitationEntry")]
pub struct ExcitationLines {
    /// The lines, ascending.
    pub lines: Vec<NamedLine>,
    /// Crossings with branches of the diagram, by line and speed, for frequencies up to
    /// `campbell.complete_to_hz`.
    pub crossings: Vec<LineCrossing>,
}

/// A frequency that is a multiple of the rotation speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ExcitationLineEntry")]
pub struct NamedLine {
    /// Ratio of the frequency to the rotation speed.
    pub order: u32,
    /// Name: "1×", "tooth passing, 42×".
    pub name: String,
}

/// A speed at which a natural frequency equals a multiple of the rotation speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CrossingEntry")]
pub struct LineCrossing {
    /// Ratio of the frequency to the rotation speed.
    pub order: u32,
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency in the space-fixed frame.
    pub frequency_hz: f64,
    /// Number of the branch.
    pub branch: Option<usize>,
    /// Name of the branch.
    pub mode: String,
}

impl ExcitationLines {
    /// The lines of a scene; `None` if it has none.
    pub(super) fn new(
        scene: &Scene,
        crossings: &[Crossing],
        branches: &Numbered<'_>,
    ) -> Option<Self> {
        let lines = scene.excitation();
        (!lines.is_empty()).then(|| ExcitationLines {
            lines: lines.iter().map(NamedLine::from).collect(),
            crossings: crossings
                .iter()
                .map(|crossing| {
                    let branch = branches.at(crossing.point);
                    let speed_rpm = rpm(crossing.speed_rad_per_s);
                    LineCrossing {
                        order: crossing.line.order,
                        rpm: speed_rpm,
                        frequency_hz: f64::from(crossing.line.order) * speed_rpm / 60.0,
                        branch,
                        mode: branch.map_or_else(String::new, |number| branches.name(number)),
                    }
                })
                .collect(),
        })
    }
}

impl From<&ExcitationLine> for NamedLine {
    fn from(line: &ExcitationLine) -> Self {
        let order = line.order;
        NamedLine {
            order,
            name: match line.tooth_passing {
                None => format!("{order}×"),
                Some(1) => format!("tooth passing, {order}×"),
                Some(multiple) => format!("{multiple} × tooth passing, {order}×"),
            },
        }
    }
}
