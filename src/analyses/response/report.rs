//! `response.json`: steady-state amplitude and phase over the speed, and over the frequency at one speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::InstabilityBand;
use crate::model::scene::{ForceCause, SceneFile};
use crate::motion::steady::Cause;

/// Report of steady-state responses (`response.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Distance of the probe from the axis.
    pub probe_radius_m: f64,
    /// Angle of the probe.
    pub probe_angle_deg: f64,
    /// Angle of the cut, at whose place on the rim the deviation of the board is read.
    pub cut_angle_deg: f64,
    /// Whether any term of the equation of motion dissipates energy; without damping amplitudes grow without bound at a
    /// resonance.
    pub damped: bool,
    /// Largest amplitude that is reported: five times the smallest thickness.
    pub linear_limit_m: f64,
    /// Rotation speeds, ascending, the same for every line.
    pub rpm: Vec<f64>,
    /// Responses, one for each cause and order of the rotation speed.
    pub lines: Vec<ResponseLine>,
    /// Largest distance of the cut surface from the middle plane of the blade at rest, at each speed, with linear guides: the static
    /// deflection of the rim at the cut and all amplitudes there, as if their maxima coincided; null where one of them is null.
    pub board_deviation_m: Vec<Option<f64>>,
    /// The constant lateral force; zero without one.
    #[serde(default)]
    pub constant_force_n: f64,
    /// Where this force comes from; null without one.
    #[serde(default)]
    pub constant_force_cause: Option<ForceCause>,
    /// Deflections at the operating speed; null if it is not within the sweep.
    pub operating: Option<OperatingResponse>,
    /// Frequency response between two points at one speed; null if neither the scene nor the options have a speed.
    pub points: Option<FrequencyResponse>,
    /// Bands of instability, in which no steady state exists.
    pub instabilities: Vec<InstabilityBand>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Response to one cause with one order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ResponseLineEntry")]
pub struct ResponseLine {
    /// The cause.
    pub cause: Cause,
    /// Ratio of the frequency to the rotation speed; 0 for a static deflection.
    pub order: u32,
    /// Name: "run-out, 1×".
    pub name: String,
    /// Amplitude at the probe; null where the saw is unstable, and where the deflection exceeds the linear model anywhere on
    /// the rim.
    pub amplitude_m: Vec<Option<f64>>,
    /// Phase at the probe, −180 to 180: positive if the deflection precedes the excitation. The excitation is largest at the
    /// time at which its maximum passes the angle 0, or the force is largest.
    pub phase_deg: Vec<Option<f64>>,
    /// Amplitude at the rim at the cut.
    pub at_cut_m: Vec<Option<f64>>,
    /// Speeds of the sweep at which a natural frequency equals that of the excitation, and the excitation works on the mode.
    pub resonances: Vec<Resonance>,
    /// Largest relative change of these speeds on a larger basis; null for an excitation whose frequencies are those of the diagram,
    /// whose error the diagram has.
    #[serde(default)]
    pub resonance_error: Option<f64>,
}

/// A resonance of a line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ResonanceEntry")]
pub struct Resonance {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency of the force.
    pub frequency_hz: f64,
    /// Amplitude at the probe there; null unless it is bounded.
    pub amplitude_m: Option<f64>,
    /// Whether there is an amplitude, or why not.
    #[serde(default)]
    pub steady_state: SteadyState,
}

/// Whether a steady state exists.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SteadyState {
    /// The amplitude is known.
    Bounded,
    /// Nothing dissipates the energy of the mode: the amplitude grows without bound.
    Unbounded,
    /// The amplitude exceeds `linear_limit_m` somewhere on the rim.
    #[default]
    BeyondModel,
    /// The saw is unstable.
    None,
}

impl SteadyState {
    /// Words in place of an amplitude.
    pub fn said(self) -> &'static str {
        match self {
            SteadyState::Bounded => "bounded",
            SteadyState::Unbounded => "unbounded",
            SteadyState::BeyondModel => "beyond the model",
            SteadyState::None => "no steady state",
        }
    }
}

/// Deflections at the operating speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OperatingResponseEntry")]
pub struct OperatingResponse {
    /// The operating speed.
    pub rpm: f64,
    /// Amplitude of each line at the probe.
    pub amplitude_m: Vec<Option<f64>>,
    /// Deviation of the board: that under the constant force, `constant`, and all amplitudes at the cut.
    pub board_deviation_m: Option<f64>,
    /// Deflection under the constant lateral force, by the contact of guides that have a gap; null without such a force.
    #[serde(default)]
    pub constant: Option<BoardDeviation>,
    /// Whether there is a deviation, or why not.
    #[serde(default)]
    pub steady_state: SteadyState,
}

/// Deflection at the probe for a harmonic force of one newton at the place of the side force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FrequencyResponseEntry")]
pub struct FrequencyResponse {
    /// Rotation speed.
    pub rpm: f64,
    /// Distance of the force from the axis.
    pub force_radius_m: f64,
    /// Angle of the force.
    pub force_angle_deg: f64,
    /// Frequencies, ascending.
    pub frequency_hz: Vec<f64>,
    /// Amplitude for one newton; null where it grows without bound, and everywhere if the saw is unstable at the speed.
    pub receptance_m_per_n: Vec<Option<f64>>,
    /// Phase, −180 to 180: negative if the deflection follows the force.
    pub phase_deg: Vec<Option<f64>>,
    /// Frequencies at which the deflection grows without bound: the natural frequencies that the force excites, without damping.
    #[serde(default)]
    pub unbounded_hz: Vec<f64>,
}
