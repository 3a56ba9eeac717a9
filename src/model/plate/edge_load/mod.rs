//! Membrane stress of dead forces at the edges, and its geometric stiffness.
//!
//! In the frame fixed in space the blade is axisymmetric and the forces are fixed, so their plane stress is
//! steady at every speed. It is computed exactly for each harmonic by Michell's series rather than by a
//! radial Ritz method: four powers of r satisfy equilibrium and compatibility, and the conditions at the
//! edges determine their amplitudes.
//!
//! Deflections of n₁ and n₂ nodal diameters couple only through the harmonics |n₁ ± n₂| of the stress. Orders
//! up to 2 n_max therefore give the exact K_e of point forces, although their stress is singular at the rim.
//!
//! For a blade of varying thickness the harmonics are computed by finite elements over the radius.
//!
//! References: J. H. Michell, *On the direct determination of stress in an elastic
//! solid*, Proc. London Math. Soc. 31 (1899) 100–124; Timoshenko & Goodier, *Theory of
//! Elasticity*, 3rd ed., sections 28, 42 and 43.

mod angular;
mod force;
mod michell;
mod profile;
mod stiffness;

pub use force::{BoreForce, RimForce};
pub use stiffness::edge_stiffness;

use crate::model::scene::Blade;

use force::{traction_at_bore, traction_at_rim};
use profile::Profile;

/// Harmonic m of the three stresses at one radius, in Pa.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HarmonicStress {
    /// σ_rr: [factor of cos mθ, factor of sin mθ].
    pub radial_pa: [f64; 2],
    /// σ_θθ: [factor of cos mθ, factor of sin mθ].
    pub hoop_pa: [f64; 2],
    /// σ_rθ: [factor of cos mθ, factor of sin mθ].
    pub shear_pa: [f64; 2],
}

/// Plane stress of an annulus under dead forces at its rim, as a Fourier series in θ.
///
/// The bore carries the reaction: the net torque T as a uniform shear traction T/(2πa²h), the net force F as
/// the traction −F/(2πah) of constant direction. Forces given at the bore carry part of it, and the assumed
/// tractions the remainder. A collar has these reactions, too; its constraint on the higher harmonics is
/// neglected.
#[derive(Debug, Clone)]
pub struct EdgeStress {
    /// For each order m, the stresses (σ_rr, σ_θθ, σ_rθ) that vary as (cos mθ, cos mθ, sin mθ) and those that
    /// vary as (sin mθ, sin mθ, −cos mθ), which are fields of the first form rotated by a quarter wave.
    harmonics: Vec<[Profile; 2]>,
}

impl EdgeStress {
    /// Computes the orders 0 … `max_order`; with 2 n_max [`edge_stiffness`] is exact. Non-finite forces give
    /// non-finite stresses.
    pub fn new(blade: &Blade, loads: &[RimForce], max_order: usize) -> Self {
        Self::with_reaction(blade, loads, &[], max_order)
    }

    /// Computes the orders 0 … `max_order` with known forces at the bore. These replace the part of the assumed
    /// reaction that they balance: all of it if they are in equilibrium with the loads.
    pub fn with_reaction(
        blade: &Blade,
        loads: &[RimForce],
        reaction: &[BoreForce],
        max_order: usize,
    ) -> Self {
        let harmonics = (0..=max_order)
            .map(|m| {
                let rim = traction_at_rim(blade, loads, m);
                let bore = traction_at_bore(blade, reaction, m);
                [0, 1].map(|field| Profile::new(blade, m, rim[field], bore[field]))
            })
            .collect();
        EdgeStress { harmonics }
    }

    /// Largest order m.
    pub fn max_order(&self) -> usize {
        self.harmonics.len().saturating_sub(1)
    }

    /// The harmonic of order m at radius r; zero beyond [`EdgeStress::max_order`].
    pub fn harmonic(&self, order: usize, radius_m: f64) -> HarmonicStress {
        let Some(parts) = self.harmonics.get(order) else {
            return HarmonicStress::default();
        };
        let [even, odd] = parts.each_ref().map(|part| part.at(radius_m));
        HarmonicStress {
            radial_pa: [even.radial_pa, odd.radial_pa],
            hoop_pa: [even.hoop_pa, odd.hoop_pa],
            shear_pa: [-odd.shear_pa, even.shear_pa],
        }
    }

    /// Stresses [σ_rr, σ_θθ, σ_rθ] at a point, in Pa: the sum of the series, which converges as (r/b)^m inside
    /// the rim and not at the rim.
    pub fn at(&self, radius_m: f64, angle_rad: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for m in 0..self.harmonics.len() {
            let stress = self.harmonic(m, radius_m);
            let (sin, cos) = (m as f64 * angle_rad).sin_cos();
            let parts = [stress.radial_pa, stress.hoop_pa, stress.shear_pa];
            for (sum, [of_cos, of_sin]) in sum.iter_mut().zip(parts) {
                *sum += of_cos * cos + of_sin * sin;
            }
        }
        sum
    }
}

#[cfg(test)]
mod ring_tests;
#[cfg(test)]
mod tests;
