//! Modes: of the blade at rest, all at one speed, and one with its shape.

use std::f64::consts::TAU;

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::plate::Plate;
use crate::model::scene::rpm;
use crate::modes::{DescribedMode, Direction, SpectrumError, in_words};
use crate::stability::{Analysis, StabilityState};

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
    pub harmonics: Vec<HarmonicShare>,
    /// Deflection, scaled to a largest value of one.
    pub shape: Vec<HarmonicShape>,
}

/// Share of n nodal diameters in a mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HarmonicEntry")]
pub struct HarmonicShare {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Share, between 0 and 1.
    pub share: f64,
}

/// w(r, θ) = Σ_n cosine_n(r) cos nθ + sine_n(r) sin nθ at a few radii.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ShapeEntry")]
pub struct HarmonicShape {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Radii of the shape.
    pub radius_m: Vec<f64>,
    /// Coefficient of cos nθ at these radii.
    pub cosine: Vec<f64>,
    /// Coefficient of sin nθ at these radii.
    pub sine: Vec<f64>,
}

/// The modes at one speed, and the verdict on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "WhirlEntry")]
pub struct Whirl {
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

impl Whirl {
    /// All modes of the diagram at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn new(analysis: &Analysis, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let model = &analysis.model;
        let modes = model.describe(speed_rad_per_s, model.modes(speed_rad_per_s)?);
        Ok(Whirl {
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

/// A mode at one speed: w(r, θ, t) = Re Σ_n (c_n(r) cos nθ + s_n(r) sin nθ) e^{λt}.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ModeEntry")]
pub struct ModeShape {
    /// Harmonics of the mode, with shares if none dominates.
    pub name: String,
    /// Direction of the wave, seen from space.
    pub direction: Direction,
    /// Rotation speed.
    pub rpm: f64,
    /// |Im λ|/2π in the space-fixed frame.
    pub frequency_hz: f64,
    /// Frequency of the dominant harmonic on the blade.
    pub body_frequency_hz: f64,
    /// Re λ.
    pub growth_per_s: f64,
    /// Krein sign: +1, −1 (reflected), or 0 where the mode is unstable or damped.
    pub krein_sign: i8,
    /// Radii of the profiles.
    pub radius_m: Vec<f64>,
    /// Harmonics whose share of the energy is visible, the largest first.
    pub harmonics: Vec<ModeHarmonic>,
}

/// The part of a mode with n nodal diameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "WaveEntry")]
pub struct ModeHarmonic {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Share in the name, between 0 and 1: of the kinetic energy of a mode; among the reflected or the other waves
    /// of a critical speed or band.
    pub share: f64,
    /// Coefficient of cos nθ at the radii.
    pub cosine: ComplexNumbers,
    /// Coefficient of sin nθ at the radii.
    pub sine: ComplexNumbers,
}

/// A list of complex numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ComplexEntry")]
pub struct ComplexNumbers {
    /// Real parts.
    pub re: Vec<f64>,
    /// Imaginary parts.
    pub im: Vec<f64>,
}

/// Smallest share of the kinetic energy of a listed harmonic; smaller ones are not visible.
const LEAST_SHARE: f64 = 1e-3;

impl ModeShape {
    /// The entry of a mode at a speed.
    pub fn new(plate: &Plate, speed_rad_per_s: f64, described: &DescribedMode) -> Self {
        let (mode, name) = (&described.mode, &described.name);
        let seen = name.harmonics.iter().filter(|h| h.share >= LEAST_SHARE);
        ModeShape {
            name: name.in_shares(),
            direction: name.direction,
            rpm: rpm(speed_rad_per_s),
            frequency_hz: mode.frequency_rad_per_s() / TAU,
            body_frequency_hz: name.body_frequency_rad_per_s(mode, speed_rad_per_s) / TAU,
            growth_per_s: mode.growth_per_s(),
            krein_sign: mode.krein_sign(),
            radius_m: plate.sampled_radii_m().collect(),
            harmonics: seen
                .map(|h| profile(plate, &described.shape, h.diameters, h.share))
                .collect(),
        }
    }
}

/// The harmonic of n nodal diameters of a shape, which is given in the basis of the plate.
pub(super) fn profile(plate: &Plate, shape: &Col<c64>, n: usize, share: f64) -> ModeHarmonic {
    let (first, size) = (plate.offset(n), plate.basis.count());
    let over_radii = |offset: usize| {
        let at = |radial: &Vec<f64>| -> c64 {
            let terms = radial.iter().zip(offset..);
            let sum: c64 = terms.map(|(r, i)| shape[i] * *r).sum();
            sum / plate.angular_norm(n)
        };
        let values: Vec<c64> = plate.sampled_functions(n).iter().map(at).collect();
        ComplexNumbers {
            re: values.iter().map(|c| c.re).collect(),
            im: values.iter().map(|c| c.im).collect(),
        }
    };
    let cosine = over_radii(first);
    let none = vec![0.0; cosine.re.len()];
    ModeHarmonic {
        nodal_diameters: n,
        share,
        sine: match n {
            0 => ComplexNumbers {
                re: none.clone(),
                im: none,
            },
            _ => over_radii(first + size),
        },
        cosine,
    }
}
