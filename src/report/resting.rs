//! The modes of the blade at rest.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A mode of the blade that does not spin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RestMode {
    /// |Im λ|/2π, the natural frequency.
    pub frequency_hz: f64,
    /// Nodal diameters of the dominant harmonic.
    pub nodal_diameters: usize,
    /// Nodal circles of the dominant harmonic.
    pub nodal_circles: usize,
    /// Name of its branch, or the shares of its harmonics if none dominates: "0 (54 %) + 1 (45 %)".
    pub name: String,
    /// Number of the branch of the Campbell diagram that begins with this mode, if the sweep begins at rest.
    pub branch: Option<usize>,
    /// ζ = −Re λ/|λ|; damped scenes only.
    pub damping_ratio: Option<f64>,
    /// −2π Re λ/|Im λ|; damped scenes only.
    pub logarithmic_decrement: Option<f64>,
    /// Estimated relative error of the frequency.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Backward error: ‖L(λ)q‖ relative to the size of its terms.
    pub backward_error: f64,
    /// Share of each harmonic of the kinetic energy, largest first.
    pub harmonics: Vec<HarmonicEntry>,
    /// Deflection, scaled to a largest value of one.
    pub shape: Vec<ShapeEntry>,
}

/// Share of n nodal diameters in a mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HarmonicEntry {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Share, between 0 and 1.
    pub share: f64,
}

/// w(r, θ) = Σ_n cosine_n(r) cos nθ + sine_n(r) sin nθ at a few radii.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapeEntry {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Radii of the shape.
    pub radius_m: Vec<f64>,
    /// Coefficient of cos nθ at these radii.
    pub cosine: Vec<f64>,
    /// Coefficient of sin nθ at these radii.
    pub sine: Vec<f64>,
}
