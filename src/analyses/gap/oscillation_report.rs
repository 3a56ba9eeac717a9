//! Oscillations of a blade between guides with a gap, in `gap.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Periodic motion of the blade under the steady side force of the map, with the gaps of the scene. Its causes are an
/// oscillating side force and `response.runout_m`, `flatness_m` and `imbalance_kg_m2` of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OscillationEntry")]
pub struct Oscillation {
    /// Steady side force.
    pub force_n: f64,
    /// Amplitude of the oscillating side force; 0 without one.
    pub oscillating_force_n: f64,
    /// Ratio of its frequency to that of rotation; 0 without one.
    pub oscillating_order: u32,
    /// The parts of the motion, by their order of the rotation speed.
    pub lines: Vec<OscillationLine>,
    /// The motion at the speed of the map; null if no periodic motion was found.
    pub at: Option<OscillationAt>,
    /// Deflection of the rim at the cut at the speed of the map without oscillation.
    pub still_deflection_m: f64,
    /// Amplitude at the cut, at the speed of the map, of the harmonics that the motion neglects, relative to its own; null if no motion
    /// was found.
    pub harmonics_error_share: Option<f64>,
    /// Relative change of this amplitude with 24 modes at rest instead of 16; null if no motion was found.
    pub basis_error_share: Option<f64>,
    /// Rotation speeds of the series below, ascending.
    pub rpm: Vec<f64>,
    /// Amplitude at the cut of the harmonics that the motion neglects, relative to its own; null where no motion was found, and where it
    /// needs more than 24 harmonics.
    #[serde(default)]
    pub neglected_share: Vec<Option<f64>>,
    /// Mean deflection at the probe, whose sign is the side to which the blade leans; null where no stable periodic motion was
    /// found, and where the blade deflects by more than its thickness.
    pub probe_mean_m: Vec<Option<f64>>,
    /// Half of the difference between the largest and the smallest deflection at the probe.
    pub probe_amplitude_m: Vec<Option<f64>>,
    /// Mean deflection of the rim at the cut.
    pub cut_mean_m: Vec<Option<f64>>,
    /// Half of the difference between the largest and the smallest deflection of the rim at the cut.
    pub cut_amplitude_m: Vec<Option<f64>>,
}

/// A part of the motion, with a multiple of the rotation frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OscillationLineEntry")]
pub struct OscillationLine {
    /// Ratio of its frequency to that of rotation.
    pub order: u32,
    /// Causes of this part, such as "run-out" or "flatness"; "contact" if only the contact of the pads has this order.
    pub name: String,
    /// Amplitude at the probe at the speeds of the series.
    pub probe_m: Vec<Option<f64>>,
}

/// The motion at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OscillationAtEntry")]
pub struct OscillationAt {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency of the motion.
    pub frequency_hz: f64,
    /// Deflection of the rim at the cut.
    pub cut: OscillationPlace,
    /// Deflection at the probe.
    pub probe: OscillationPlace,
    /// One-sided pads, in the order of the scene.
    pub pads: Vec<OscillationPad>,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_deflection_m: f64,
    /// Growth rate of the fastest small motion about this one, negative if all decay; null if it was not found.
    pub growth_per_s: Option<f64>,
    /// Frequency of that small motion, at most half of `frequency_hz`; a motion with exactly half has twice the period.
    pub growth_frequency_hz: Option<f64>,
    /// Whether no small motion about this one grows faster than the threshold of the scene.
    pub stable: bool,
}

/// A periodic deflection at a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OscillationPlaceEntry")]
pub struct OscillationPlace {
    /// Mean deflection.
    pub mean_m: f64,
    /// Half of the difference between the largest and the smallest deflection.
    pub amplitude_m: f64,
    /// Largest deflection, as an absolute value.
    pub largest_m: f64,
    /// Amplitude of each part of the motion, in the order of `lines`.
    pub lines_m: Vec<f64>,
    /// Phase of each part, −180 to 180: the angle by which it precedes the time at which the oscillating force, or the wave of a
    /// shape at the angle 0, is largest, in angles of this part.
    pub phase_deg: Vec<f64>,
}

/// Forces and contact of a pad over one period of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OscillationPadEntry")]
pub struct OscillationPad {
    /// Index among the guides of the scene.
    pub guide: usize,
    /// Mean force on the blade, by contact and film.
    pub mean_force_n: f64,
    /// Largest force, as an absolute value.
    pub largest_force_n: f64,
    /// Share of the period in which the pad touches the blade.
    pub contact_share: f64,
}
