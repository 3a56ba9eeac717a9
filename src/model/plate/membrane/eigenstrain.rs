//! Axisymmetric eigenstrains: the strains of the metal if nothing constrained it.

use crate::model::scene::{Blade, Profile, RollBand, Temperature, TemperatureShape};

/// In-plane eigenstrain ε(r), isotropic, with its moment ∫ ε r dr in closed form, so that the stress is exact
/// to rounding.
#[derive(Debug, Clone, PartialEq)]
pub enum Eigenstrain {
    /// Strain ε_b ((r − r₀)/(b − r₀))^p beyond r₀, zero inside it.
    Power {
        /// Strain ε_b at the rim.
        at_rim: f64,
        /// Radius r₀ at which the strain begins.
        from_radius_m: f64,
        /// Radius b of the rim.
        to_radius_m: f64,
        /// Exponent p.
        exponent: f64,
    },
    /// Strain linear between the rows of a table.
    Table {
        /// Strain where the profile is one.
        factor: f64,
        /// Shape of the strain over the radius.
        profile: Profile,
    },
    /// Strain constant within a band and zero outside it.
    Band(RollBand),
}

/// Ratio of the widths of successive panels towards r₀, if the exponent is not an integer.
const SHRINK: f64 = 0.15;
/// Number of these panels: the integral of r^½ over the remainder is below 1e-11 of the whole.
const SHRUNK_PANELS: i32 = 9;

impl Eigenstrain {
    /// Thermal strain α T(r) of a temperature with the given peak.
    pub fn of_heat(blade: &Blade, temperature: &Temperature, peak_rise_k: f64) -> Self {
        let peak = temperature.expansion_per_k * peak_rise_k;
        match &temperature.shape {
            TemperatureShape::Rim {
                from_radius_m,
                exponent,
            } => Eigenstrain::Power {
                at_rim: peak,
                from_radius_m: *from_radius_m,
                to_radius_m: blade.outer_radius_m,
                exponent: *exponent,
            },
            TemperatureShape::Table(profile) => Eigenstrain::Table {
                factor: peak,
                profile: profile.clone(),
            },
        }
    }

    /// Eigenstrain ε at radius r.
    pub fn at(&self, r: f64) -> f64 {
        match self {
            Eigenstrain::Power {
                at_rim,
                from_radius_m,
                to_radius_m,
                exponent,
            } => {
                let share = (r - from_radius_m) / (to_radius_m - from_radius_m);
                if share < 0.0 {
                    0.0
                } else {
                    at_rim * share.powf(*exponent)
                }
            }
            Eigenstrain::Table { factor, profile } => factor * profile.at(r),
            Eigenstrain::Band(band) => {
                let inside = (band.from_radius_m..=band.to_radius_m).contains(&r);
                if inside { band.eigenstrain } else { 0.0 }
            }
        }
    }

    /// ∫ ε ρ dρ from `from` to `to`, in m².
    pub fn moment_m2(&self, from: f64, to: f64) -> f64 {
        match self {
            Eigenstrain::Power {
                at_rim,
                from_radius_m,
                to_radius_m,
                exponent: p,
            } => {
                let width = to_radius_m - from_radius_m;
                // With ρ = r₀ + s w, r₀ = `from_radius_m` and w = `width`, the integral is
                // ∫ s^p (r₀ + s w) w ds.
                let primitive = |r: f64| {
                    let s = ((r - from_radius_m) / width).max(0.0);
                    width * s.powf(p + 1.0) * (from_radius_m / (p + 1.0) + width * s / (p + 2.0))
                };
                at_rim * (primitive(to) - primitive(from))
            }
            Eigenstrain::Table { factor, profile } => factor * profile.moment(from, to),
            Eigenstrain::Band(band) => {
                let low = band.from_radius_m.clamp(from, to);
                let high = band.to_radius_m.clamp(from, to);
                0.5 * band.eigenstrain * (high - low) * (high + low)
            }
        }
    }

    /// Whether the strain is zero everywhere.
    pub fn is_zero(&self) -> bool {
        match self {
            Eigenstrain::Power { at_rim, .. } => *at_rim == 0.0,
            Eigenstrain::Table { factor, .. } => *factor == 0.0,
            Eigenstrain::Band(band) => band.eigenstrain == 0.0,
        }
    }

    /// Radii at which the eigenstrain or one of its derivatives jumps, or near which it is not smooth.
    pub fn knots_m(&self) -> Vec<f64> {
        match self {
            Eigenstrain::Power {
                from_radius_m,
                to_radius_m,
                exponent,
                ..
            } => {
                let width = to_radius_m - from_radius_m;
                let panels = if exponent.fract() == 0.0 {
                    0
                } else {
                    SHRUNK_PANELS
                };
                let shrunk = (1..=panels).map(|k| from_radius_m + width * SHRINK.powi(k));
                std::iter::once(*from_radius_m).chain(shrunk).collect()
            }
            Eigenstrain::Table { profile, .. } => profile.knots_m().to_vec(),
            Eigenstrain::Band(band) => vec![band.from_radius_m, band.to_radius_m],
        }
    }

    /// Degree of the polynomial between knots; for a power that is no polynomial, its exponent rounded up.
    pub fn degree(&self) -> usize {
        match self {
            Eigenstrain::Power { exponent, .. } => exponent.ceil() as usize,
            Eigenstrain::Table { .. } => 1,
            Eigenstrain::Band(_) => 0,
        }
    }
}
