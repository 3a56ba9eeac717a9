//! The settings of a trade-off: `tradeoff.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Method for critical speeds and bands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The whole chart on the reduced model with its proof, as in `analyze` at `design`.
    Reduced,
    /// The whole chart on the reduced model without proof, as in `analyze` at `draft`.
    Searched,
    /// The whole chart from all eigenvalues of the full model at every speed.
    Dense,
    /// Critical speeds alone.
    CriticalSpeeds,
}

/// One method with one size of the basis: its run time and its error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// Method of the computation.
    pub method: Method,
    /// Largest number n_max of nodal diameters.
    pub max_diameters: usize,
    /// Number J of radial functions.
    pub radial_functions: usize,
    /// Number of basis functions.
    pub functions: usize,
    /// Number of even speeds of the chart; 0 without a chart.
    pub speeds: usize,
    /// Shortest measured run time, in seconds.
    pub seconds: f64,
    /// Largest relative error of critical speeds and, in a chart, of flutter onsets, by comparison with a larger
    /// basis.
    pub error: f64,
    /// Whether no other chart is faster and at least as accurate.
    pub on_front: bool,
}

impl Setting {
    /// Whether the method finds bands.
    pub fn is_chart(&self) -> bool {
        self.method != Method::CriticalSpeeds
    }
}
