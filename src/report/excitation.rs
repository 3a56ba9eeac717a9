//! Excitation lines at multiples of the rotation speed, and their crossings with the branches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::branches::Numbered;
use crate::scene::{ExcitationLine, Scene, rpm};
use crate::stability::Crossing;

/// Excitation at multiples of the rotation speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExcitationEntry {
    /// The lines, ascending.
    pub lines: Vec<ExcitationLineEntry>,
    /// Where they cross branches of the chart, by line and speed. Frequencies above
    /// `campbell.complete_to_hz` are not looked at.
    pub crossings: Vec<CrossingEntry>,
}

/// A frequency that is a multiple of the rotation speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExcitationLineEntry {
    /// The multiple.
    pub order: u32,
    /// "1×", "tooth passing, 42×".
    pub name: String,
}

/// A speed at which a natural frequency is a multiple of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CrossingEntry {
    /// The multiple.
    pub order: u32,
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency in space, the multiple of that speed.
    pub frequency_hz: f64,
    /// Number of the branch.
    pub branch: Option<usize>,
    /// Its name.
    pub mode: String,
}

impl ExcitationEntry {
    /// The lines of a scene; `None` if it has none.
    pub(super) fn new(
        scene: &Scene,
        crossings: &[Crossing],
        branches: &Numbered<'_>,
    ) -> Option<Self> {
        let lines = scene.excitation();
        (!lines.is_empty()).then(|| ExcitationEntry {
            lines: lines.iter().map(ExcitationLineEntry::from).collect(),
            crossings: crossings
                .iter()
                .map(|crossing| {
                    let branch = branches.at(crossing.point);
                    let speed_rpm = rpm(crossing.speed_rad_per_s);
                    CrossingEntry {
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

impl From<&ExcitationLine> for ExcitationLineEntry {
    fn from(line: &ExcitationLine) -> Self {
        let order = line.order;
        ExcitationLineEntry {
            order,
            name: match line.tooth_passing {
                None => format!("{order}×"),
                Some(1) => format!("tooth passing, {order}×"),
                Some(multiple) => format!("{multiple} × tooth passing, {order}×"),
            },
        }
    }
}
