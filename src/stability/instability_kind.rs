//! The two ways in which a mode grows.

use std::fmt;

use faer::c64;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Kind of an instability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum InstabilityKind {
    /// Exponential growth without oscillation.
    Divergence,
    /// Growing oscillation.
    Flutter,
}

/// Writes "divergence" or "flutter".
impl fmt::Display for InstabilityKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            InstabilityKind::Divergence => "divergence",
            InstabilityKind::Flutter => "flutter",
        })
    }
}

impl InstabilityKind {
    /// The way in which a mode of an undamped saw with λ² grows; `None` for a wave, and for the conjugate of a growing one.
    pub fn of_square(square: c64) -> Option<Self> {
        if square.im > 0.0 {
            Some(InstabilityKind::Flutter)
        } else if square.im == 0.0 && square.re > 0.0 {
            Some(InstabilityKind::Divergence)
        } else {
            None
        }
    }

    /// Size by which numbers λ² that grow in this way are ordered: 2σω for flutter, σ² for divergence.
    pub fn size(self, square: c64) -> f64 {
        match self {
            InstabilityKind::Flutter => square.im,
            InstabilityKind::Divergence => square.re,
        }
    }
}
