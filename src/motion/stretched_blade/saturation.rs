//! Amplitude at which stretching limits flutter.
//!
//! In a flutter band two waves of opposite Krein sign have the same frequency ω: u grows with λ = σ + iω, v
//! decays with −σ + iω. With q = 2 Re[(αu + βv) e^{iωt}], v scaled so that vᴴ[2λ̂ + 2ΩG]u = i, λ̂ = σ + iω,
//! and the mean Ū(α, β) of U₄ over a period,
//!
//! α̇ = σα + i ∂Ū/∂β̄, β̇ = −σβ + i ∂Ū/∂ᾱ,
//!
//! for which H = Ū + 2σ Im(αβ̄) and Re(αβ̄) are conserved; both are zero for a motion that begins small. Then
//! β = iτα with τ > 0 at all times, up to a common phase, and Ū = 2σ|α||β|: the amplitude rises along a
//! closed loop and falls again. This is the normal form of a Hamiltonian Hopf bifurcation (J.-C. van der
//! Meer, *The Hamiltonian Hopf Bifurcation*, 1985), valid if the growth is slow compared with the distance to
//! other frequencies.

use std::f64::consts::{FRAC_PI_2, TAU};

use faer::{Col, c64};

use crate::modes::companion_eigenpairs;

use super::{StretchedBlade, StretchedError, finite};
use crate::model::scene::Polar;

/// Largest amplitude of undamped flutter that begins small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Saturation {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Growth rate σ.
    pub growth_per_s: f64,
    /// Angular frequency ω.
    pub frequency_rad_per_s: f64,
    /// Largest deflection of any point of the blade.
    pub amplitude_m: f64,
    /// Distance of this point from the axis.
    pub radius_m: f64,
    /// Angle of this point, fixed in space.
    pub angle_rad: f64,
}

/// Number of intervals along the loop, which resolve the maximum, where the amplitude is nearly a parabola.
const PLACES: usize = 64;
/// Number of phases of a period; five are exact for a quartic of sines.
const PHASES: usize = 8;

/// The growing and the decaying wave, with v scaled for the normal form.
struct Pair {
    lambda: c64,
    growing: Col<c64>,
    decaying: Col<c64>,
}

impl StretchedBlade {
    /// Amplitude of the fastest flutter at a speed, without damping and side force; `None` if nothing grows.
    /// Over a band the square of the amplitude rises from zero at one edge, over its value at the speed of fastest
    /// growth, to twice this value at the other edge, where the rise takes ever longer.
    ///
    /// Time histories with the same shapes, in six bands of the paper's saw with growth rates of 0.4 to 3 1/s and
    /// amplitudes of 0.7 to 1.7 mm, differ from this amplitude by 0.2 to 4.3 % at the same point. Where the two waves
    /// have small deflections other waves contribute.
    ///
    /// # Errors
    /// [`StretchedError::Value`], [`StretchedError::Spectrum`].
    pub fn saturation(&self, speed_rad_per_s: f64) -> Result<Option<Saturation>, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        self.rise(speed_rad_per_s, None)
    }

    /// Amplitude of the fastest flutter, or of the flutter whose eigenvalue is nearest to a given one; `None` if
    /// nothing grows.
    pub(super) fn rise(
        &self,
        speed_rad_per_s: f64,
        near: Option<c64>,
    ) -> Result<Option<Saturation>, StretchedError> {
        let Some(pair) = self.flutter_pair(speed_rad_per_s, near)? else {
            return Ok(None);
        };
        let sites = self.sites();
        let readings: Vec<(c64, c64)> = sites
            .iter()
            .map(|(_, site)| {
                let read = |x: &Col<c64>| (0..site.nrows()).map(|i| x[i] * site[i]).sum::<c64>();
                (read(&pair.growing), read(&pair.decaying))
            })
            .collect();
        let mut largest = (0.0, Polar::new(0.0, 0.0));
        for place in 1..PLACES {
            let turn = FRAC_PI_2 * place as f64 / PLACES as f64;
            let (sin, cos) = turn.sin_cos();
            let second = c64::new(0.0, sin);
            let mean = self.mean_potential_j(&pair, (cos, second))?;
            // With σ = Re λ, α = r cos φ and β = i r sin φ, where φ is `turn`, the condition Ū = 2σ|α||β| for
            // the mean potential Ū becomes r⁴ Ū(cos φ, i sin φ) = σ r² sin 2φ, which gives the size r.
            let size = (pair.lambda.re * (2.0 * turn).sin() / mean).sqrt();
            for ((u, v), (place, _)) in readings.iter().zip(sites.iter()) {
                let amplitude = 2.0 * size * (u * cos + v * second).norm();
                if amplitude > largest.0 {
                    largest = (amplitude, *place);
                }
            }
        }
        let (amplitude_m, at) = largest;
        Ok(
            (amplitude_m > 0.0 && amplitude_m.is_finite()).then_some(Saturation {
                speed_rad_per_s,
                growth_per_s: pair.lambda.re,
                frequency_rad_per_s: pair.lambda.im,
                amplitude_m,
                radius_m: at.radius_m,
                angle_rad: at.angle_rad,
            }),
        )
    }

    /// The fastest growing oscillation, or the growing one with the eigenvalue nearest to a given one, and its
    /// decaying counterpart; `None` if nothing grows.
    fn flutter_pair(
        &self,
        speed_rad_per_s: f64,
        near: Option<c64>,
    ) -> Result<Option<Pair>, StretchedError> {
        let pairs = companion_eigenpairs(&self.system, speed_rad_per_s)?;
        let preference = |lambda: &c64| match near {
            None => lambda.re,
            Some(near) => -(lambda - near).norm(),
        };
        let fastest = pairs
            .iter()
            .filter(|(lambda, _)| lambda.im > 0.0 && lambda.re > GROWTH * lambda.norm())
            .max_by(|x, y| preference(&x.0).total_cmp(&preference(&y.0)));
        let Some((lambda, growing)) = fastest else {
            return Ok(None);
        };
        let distance = |other: &c64| (other + lambda.conj()).norm();
        let mirrored = pairs
            .iter()
            .min_by(|x, y| distance(&x.0).total_cmp(&distance(&y.0)));
        let Some((_, decaying)) = mirrored else {
            return Ok(None);
        };
        // The product of the growing vector u and the decaying vector v is vᴴ(2λ + 2ΩG)u, because v belongs
        // to the eigenvalue −λ̄, and λ minus the conjugate of −λ̄ is 2λ.
        let order = growing.nrows();
        let turned = Col::from_fn(order, |i| {
            let gyroscopic: c64 = (0..order)
                .map(|k| growing[k] * self.system.gyroscopic[(i, k)])
                .sum();
            growing[i] * *lambda * 2.0 + gyroscopic * (2.0 * speed_rad_per_s)
        });
        let product: c64 = (0..order).map(|i| decaying[i].conj() * turned[i]).sum();
        // Both vectors are multiplied by factors of the same magnitude, so that evenly spaced values of
        // `turn` in `rise` give points that are evenly distributed along the loop of the amplitudes α and β.
        let factor = (c64::new(0.0, 1.0) / product).conj();
        let length = factor.norm().sqrt();
        Ok(Some(Pair {
            lambda: *lambda,
            growing: Col::from_fn(order, |i| growing[i] * length),
            decaying: Col::from_fn(order, |i| decaying[i] * factor / length),
        }))
    }

    /// Mean Ū(α, β) of the potential over a period, in J.
    fn mean_potential_j(
        &self,
        pair: &Pair,
        (first, second): (f64, c64),
    ) -> Result<f64, StretchedError> {
        let mut sum = 0.0;
        for phase in 0..PHASES {
            let turn = c64::cis(TAU * phase as f64 / PHASES as f64);
            let p = Col::from_fn(pair.growing.nrows(), |i| {
                2.0 * ((pair.growing[i] * first + pair.decaying[i] * second) * turn).re
            });
            sum += self.stretching.energy_j(&p)?;
        }
        Ok(sum / PHASES as f64)
    }
}

/// Growth below this share of the frequency is rounding.
const GROWTH: f64 = 1e-8;
