//! Critical speeds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A speed at which a wave stands still in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalSpeedEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Number of the branch that stands still, if the diagram shows it.
    pub branch: Option<usize>,
    /// The wave that stands still: "2 diameters", or the shares of waves if none dominates, "3 (52 %) + 2 (41
    /// %)". The branch is named by its mode at rest, which may differ.
    pub name: String,
    /// Nodal diameters of that wave, or of the one with the largest share.
    pub nodal_diameters: usize,
    /// Nodal circles of that wave.
    pub nodal_circles: usize,
    /// Estimated relative error of the speed.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
}
