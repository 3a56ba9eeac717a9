//! A controller that acts on a guide pad.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A controller, or any other element with a linear law, that presses on the blade at a pad beside the pad's spring and damper. Its
/// force is uniform over the pad, and opposes the mean deflection w of the blade over the pad, less that of the head of its arm, by the
/// transfer function κ(s) = numerator/denominator in N/m, where s is in 1/s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideControllerFile {
    /// Coefficients of the numerator, from the highest power of s to the constant. It has at most one degree more than the
    /// denominator.
    pub numerator: Vec<f64>,
    /// Coefficients of the denominator, from the highest power of s to the constant, of which neither is zero.
    pub denominator: Vec<f64>,
}
