//! Whether a vibration grows.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whether a vibration grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// No vibration grows as fast as the threshold.
    Stable,
    /// Some vibration grows as fast.
    Unstable,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
        })
    }
}
