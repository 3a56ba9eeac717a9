//! One mode at one speed, with its shape.

use std::f64::consts::TAU;

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::plate::Plate;
use crate::scene::rpm;
use crate::spectrum::{DescribedMode, Direction};

/// A mode at one speed: w(r, θ, t) = Re Σ_n (c_n(r) cos nθ + s_n(r) sin nθ) e^{λt}.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeEntry {
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
    pub harmonics: Vec<WaveEntry>,
}

/// The part of a mode with n nodal diameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WaveEntry {
    /// Number n of nodal diameters.
    pub nodal_diameters: usize,
    /// Share in the name, between 0 and 1: of the kinetic energy of a mode; among the reflected or the other waves
    /// of a critical speed or band.
    pub share: f64,
    /// Coefficient of cos nθ at the radii.
    pub cosine: ComplexEntry,
    /// Coefficient of sin nθ at the radii.
    pub sine: ComplexEntry,
}

/// A list of complex numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComplexEntry {
    /// Real parts.
    pub re: Vec<f64>,
    /// Imaginary parts.
    pub im: Vec<f64>,
}

/// Smallest share of the kinetic energy of a listed harmonic; smaller ones are not visible.
const LEAST_SHARE: f64 = 1e-3;

impl ModeEntry {
    /// The entry of a mode at a speed.
    pub fn new(plate: &Plate, speed_rad_per_s: f64, described: &DescribedMode) -> Self {
        let (mode, name) = (&described.mode, &described.name);
        let seen = name.harmonics.iter().filter(|h| h.share >= LEAST_SHARE);
        ModeEntry {
            name: name.in_shares(),
            direction: name.direction,
            rpm: rpm(speed_rad_per_s),
            frequency_hz: mode.frequency_rad_per_s() / TAU,
            body_frequency_hz: name.body_frequency_rad_per_s / TAU,
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
pub(super) fn profile(plate: &Plate, shape: &Col<c64>, n: usize, share: f64) -> WaveEntry {
    let (first, size) = (plate.offset(n), plate.basis.count());
    let over_radii = |offset: usize| {
        let at = |radial: &Vec<f64>| -> c64 {
            let terms = radial.iter().zip(offset..);
            let sum: c64 = terms.map(|(r, i)| shape[i] * *r).sum();
            sum / plate.angular_norm(n)
        };
        let values: Vec<c64> = plate.sampled_functions(n).iter().map(at).collect();
        ComplexEntry {
            re: values.iter().map(|c| c.re).collect(),
            im: values.iter().map(|c| c.im).collect(),
        }
    };
    let cosine = over_radii(first);
    let none = vec![0.0; cosine.re.len()];
    WaveEntry {
        nodal_diameters: n,
        share,
        sine: match n {
            0 => ComplexEntry {
                re: none.clone(),
                im: none,
            },
            _ => over_radii(first + size),
        },
        cosine,
    }
}
