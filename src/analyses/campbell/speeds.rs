//! Critical speeds, bands of instability, and the operating speed between them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::board_deviation::BoardDeviation;
use crate::stability::{InstabilityKind, StabilityState};

/// A speed at which a wave stands still in space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CriticalSpeedEntry")]
pub struct CriticalSpeed {
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

/// A band of unstable speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "InstabilityEntry")]
pub struct InstabilityBand {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// Speed at which the band begins.
    pub from_rpm: f64,
    /// Speed at which the band ends, or the end of the sweep.
    pub to_rpm: f64,
    /// False if the sweep begins or ends inside the band.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak_rpm: f64,
    /// Largest growth rate.
    pub peak_growth_per_s: f64,
    /// Frequency at the peak.
    pub frequency_hz: f64,
    /// Waves of the band at its own speed: "2 diameters" for divergence, "4 reflected with 2 forward" for
    /// flutter; null without a diagram. The branches are named by their modes at rest, which may differ.
    #[serde(default)]
    pub name: Option<String>,
    /// Numbers of the branches that become unstable; empty without a diagram.
    pub branches: Vec<usize>,
    /// Waves of the band one by one, reflected ones first: "4 diameters, reflected".
    pub modes: Vec<String>,
    /// Intervals [from, to] in which the band counts as an instability: divergence as a whole; flutter of an
    /// undamped blade as a whole if its largest growth reaches the threshold, of a damped one where its
    /// growth does.
    pub counted_rpm: Vec<[f64; 2]>,
    /// The same for a hundredth of the threshold: outside these intervals a growth is not felt.
    #[serde(default)]
    pub felt_rpm: Vec<[f64; 2]>,
    /// Amplitude to which flutter rises from a small motion at the speed of largest growth, limited by
    /// stretching, without damping; up to 1.41 times as large near one edge of the band. Null unless
    /// requested, for divergence, if only damping makes the blade flutter, and if it was not computed.
    #[serde(default)]
    pub saturated_amplitude_m: Option<f64>,
    /// Reason for which the amplitude was not computed, although it was requested; null if there is none.
    #[serde(default)]
    pub amplitude_not_computed: Option<String>,
    /// Estimated relative error of the onset and the end, the larger of both; null if it is unknown.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of the largest growth rate. As a small difference of large numbers it may
    /// exceed the tolerance.
    #[serde(default)]
    pub estimated_relative_growth_error: Option<f64>,
}

/// Motions at the operating speed; `verdict` judges them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OperatingEntry")]
pub struct OperatingPoint {
    /// The scene's operating speed.
    pub rpm: f64,
    /// Ratio of operating speed to first critical speed; null if the blade has no critical speed.
    pub of_first_critical: Option<f64>,
    /// Whether a motion grows at that speed.
    pub stability: StabilityState,
    /// Index into `instabilities` of the band that makes it unstable.
    pub inside_instability: Option<usize>,
    /// Speed at which a band begins or ends, if it is so close to the operating speed that its estimated error leaves open on which side
    /// that is; else null.
    #[serde(default)]
    pub undecided_edge_rpm: Option<f64>,
    /// Critical speed within 5 % of the operating speed; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Deflection of the rim at the cut under a constant side force there, relative to that at rest; negative if the
    /// blade moves against the force. Null unless the saw is stable, if nothing holds the blade's rigid motions, and so
    /// close to a critical speed that its error decides.
    #[serde(default)]
    pub side_force_factor: Option<f64>,
    /// Deflection of the rim at the cut under the constant lateral force of the scene at the operating speed.
    #[serde(default)]
    pub deviation: Option<BoardDeviation>,
    /// The window without instability: speeds of the sweep around the operating speed at which no instability
    /// counts, and which are at least 5 % from critical speeds; null if the saw is unstable or at a critical
    /// speed.
    pub safe_window_rpm: Option<[f64; 2]>,
    /// Re λ of the mode that grows fastest, or decays most slowly; null outside the sweep.
    pub growth_per_s: Option<f64>,
    /// Im λ/2π of this mode.
    pub frequency_hz: Option<f64>,
}
