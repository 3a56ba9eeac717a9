//! The modes at one speed.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::rpm;
use crate::spectrum::{DescribedMode, Direction, SpectrumError, in_words};
use crate::stability::{Analysis, StabilityState};

/// The modes at one speed, and the verdict on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WhirlEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Whether the saw is stable at this speed.
    pub verdict: StabilityState,
    /// Critical speed within 5 % of this speed; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Modes, ascending in frequency.
    pub modes: Vec<WhirlMode>,
}

/// A mode of a rotating saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WhirlMode {
    /// |Im λ|/2π in the space-fixed frame.
    pub frequency_hz: f64,
    /// Nodal diameters of the dominant harmonic.
    pub nodal_diameters: usize,
    /// Nodal circles of the dominant harmonic.
    pub nodal_circles: usize,
    /// Direction of the dominant harmonic, seen from space.
    pub direction: Direction,
    /// Nodal diameters, nodal circles and direction of the dominant harmonic in words.
    pub name: String,
    /// Re λ.
    pub growth_per_s: f64,
    /// ζ = −Re λ/|λ|; damped scenes only.
    pub damping_ratio: Option<f64>,
    /// −2π Re λ/|Im λ|; damped scenes only, if the mode oscillates.
    pub logarithmic_decrement: Option<f64>,
    /// Krein sign: +1, −1 (reflected), or 0 where the mode is unstable or damped.
    pub krein_sign: i8,
}

impl WhirlEntry {
    /// All modes of the diagram at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn new(analysis: &Analysis, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let model = &analysis.model;
        let modes = model.describe(speed_rad_per_s, model.modes(speed_rad_per_s)?);
        Ok(WhirlEntry {
            rpm: rpm(speed_rad_per_s),
            verdict: analysis.verdict(speed_rad_per_s).state,
            at_critical_rpm: analysis.critical_rpm_at(speed_rad_per_s),
            modes: modes.iter().map(WhirlMode::from).collect(),
        })
    }
}

impl From<&DescribedMode> for WhirlMode {
    fn from(described: &DescribedMode) -> Self {
        let (mode, name) = (&described.mode, &described.name);
        WhirlMode {
            frequency_hz: mode.frequency_rad_per_s() / TAU,
            nodal_diameters: name.diameters,
            nodal_circles: name.circles,
            direction: name.direction,
            name: in_words(name.diameters, name.circles, name.direction),
            growth_per_s: mode.growth_per_s(),
            damping_ratio: mode.damping_ratio(),
            logarithmic_decrement: mode.logarithmic_decrement(),
            krein_sign: mode.krein_sign(),
        }
    }
}
