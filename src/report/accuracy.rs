//! Accuracy and work of an analysis.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::Accuracy;

/// Size of the basis and estimated errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AccuracyEntry {
    /// Named accuracy of the scene.
    pub name: Accuracy,
    /// Largest number of nodal diameters.
    pub max_diameters: usize,
    /// Speed up to which no wave with more nodal diameters can stand still in space: at least the end of the sweep and
    /// the lowest critical speed. Critical speeds, bands, errors and the certificate hold up to it.
    pub complete_to_rpm: f64,
    /// Number of radial functions for each number of nodal diameters, including those that steps and kinks of the
    /// thickness add.
    pub radial_functions: usize,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Relative error allowed for critical speeds, onsets and the lowest frequencies at rest.
    pub tolerance: f64,
    /// Whether the estimate is within the tolerance, which the largest basis may not achieve.
    pub reached: bool,
    /// Estimated relative error of the critical speeds within the sweep, from the change with a larger basis.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the lowest frequencies at rest, measured on a larger basis.
    #[serde(default)]
    pub estimated_resting_error: Option<f64>,
    /// Estimated relative error of the frequencies in the diagram, each relative to the frequency of its wave
    /// on the blade.
    #[serde(default)]
    pub estimated_drawn_error: Option<f64>,
}

/// Numbers of eigenproblems solved, by kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkEntry {
    /// Eigenproblems of the full model: Krylov iterations with a factorization each, or dense ones.
    pub full_solves: usize,
    /// Number of `full_solves` that used the block structure of the blade and the few columns of its guides, in a time
    /// linear in the number of basis functions; scenes with edge loads or dampers have no such structure.
    pub structured_solves: usize,
    /// Dense eigenproblems of the reduced model.
    pub reduced_solves: usize,
    /// Dense eigenproblems of the Hamiltonian reduction between two speeds.
    pub local_solves: usize,
    /// Pairs of modes (single modes of a damped blade or in divergence) refined by inverse iteration with a
    /// few factorizations each.
    pub refined_pairs: usize,
    /// Symmetric eigenproblems of the full model at other temperatures, for limits of heat.
    pub heat_solves: usize,
}
