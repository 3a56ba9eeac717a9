//! Branches over speed, and eigenvalues in the complex plane.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::modes::Direction;

/// The Campbell diagram.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CampbellEntry")]
pub struct CampbellDiagram {
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Frequency up to which the branches are complete.
    pub complete_to_hz: f64,
    /// Branches, by frequency at their lowest speed.
    pub branches: Vec<BranchCurve>,
}

/// One mode followed over speed. All lists have one entry for each speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "BranchEntry")]
pub struct BranchCurve {
    /// Number: 1, 2, 3 … in the order of the list.
    pub branch: usize,
    /// Name of the branch in every output, by its mode at its first speed: for a blade without guides "2
    /// diameters, backward"; for a guided one at rest "2 diameters", or shares of harmonics if none
    /// dominates.
    pub name: String,
    /// Number and short name, for the end of a line: "3: 0 (54 %) + 1 (45 %)".
    pub label: String,
    /// Nodal diameters of the dominant harmonic at its first speed.
    pub nodal_diameters: usize,
    /// Nodal circles of that harmonic.
    pub nodal_circles: usize,
    /// Direction of the wave on the blade at each speed, where no wave is `reflected`.
    pub direction: Vec<Direction>,
    /// Rotation speeds, ascending.
    pub rpm: Vec<f64>,
    /// |Im λ|/2π in the space-fixed frame. Between computed speeds it is interpolated, within 5e-4 of `complete_to_hz`, besides
    /// the error of the basis.
    pub frequency_hz: Vec<f64>,
    /// Frequency of the dominant harmonic in the body frame.
    pub body_frequency_hz: Vec<f64>,
    /// Re λ. Between computed speeds it is interpolated, within 3 % of fast decay and of the fastest growth.
    pub growth_per_s: Vec<f64>,
    /// Krein sign: +1, −1 (reflected), or 0 where the mode is unstable or damped.
    pub krein_sign: Vec<i8>,
    /// Nodal diameters of the dominant and of the next harmonic at each speed.
    pub dominant_harmonics: Vec<[usize; 2]>,
}

impl BranchCurve {
    /// Whether the mode oscillates at any speed. One that never does has no line to be labelled in a diagram of frequencies.
    pub(super) fn oscillates(&self) -> bool {
        self.frequency_hz.iter().any(|hz| *hz > 0.0)
    }
}

/// Eigenvalues around a flutter onset, in the complex plane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "RootLociEntry")]
pub struct RootLoci {
    /// Onset of the band.
    pub onset_rpm: f64,
    /// End of the band.
    pub end_rpm: f64,
    /// Rotation speeds, ascending, from before the onset to after the end.
    pub rpm: Vec<f64>,
    /// The eigenvalues of both modes, which are the growing and the decaying one
    /// inside the band.
    pub paths: Vec<RootPath>,
}

/// One eigenvalue over the speeds of [`RootLoci`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(
    rename = "RootPathEntry",
    description = "One eigenvalue over the speeds of a [`RootLoci`]."
)]
pub struct RootPath {
    /// Waves of this mode.
    pub name: String,
    /// Re λ.
    pub growth_per_s: Vec<f64>,
    /// Im λ/2π.
    pub frequency_hz: Vec<f64>,
    /// Krein sign: +1, −1, or 0 inside the band.
    pub krein_sign: Vec<i8>,
}
