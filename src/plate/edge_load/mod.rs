//! Membrane stress of dead forces at the edges, and the stiffness it gives.
//!
//! The blade turns in a frame fixed in space, where it is axisymmetric and where the
//! forces stand still: their plane stress is steady, whatever the speed. It is found
//! exactly, harmonic by harmonic, by Michell's series rather than by a radial Ritz
//! method: four powers of r per harmonic meet equilibrium and compatibility term by
//! term, and the edges fix their amplitudes.
//!
//! A deflection of n₁ and one of n₂ nodal diameters meet in the harmonics
//! |n₁ ± n₂| of the stress only, so orders up to 2 n_max give the exact K_e of
//! point forces although their stress is singular at the rim.
//!
//! Where the thickness varies the harmonics are found by finite elements over the radius instead.
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

use crate::scene::Blade;

use force::HarmonicTraction;
use profile::Profile;

/// Factors of cos mθ and sin mθ of the three stresses at one radius, in Pa.
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
/// The bore takes the reaction: the net torque T as a uniform shear traction
/// T/(2πa²h), the net force F as the traction −F/(2πah), of one direction all around.
/// Forces given at the bore take their part of it, and the assumed tractions what is left.
/// The same holds at a collar, whose grip on the higher harmonics is left out.
#[derive(Debug, Clone)]
pub struct EdgeStress {
    /// Of each order m: the fields (cos, cos, sin) and (sin, sin, −cos) of
    /// (σ_rr, σ_θθ, σ_rθ). The second is the first, turned by a quarter wave.
    harmonics: Vec<[Profile; 2]>,
}

impl EdgeStress {
    /// Solves the orders 0 … `max_order`; 2 n_max of them make
    /// [`edge_stiffness`] exact. Forces that are not finite give stresses that are not.
    pub fn new(blade: &Blade, loads: &[RimForce], max_order: usize) -> Self {
        Self::with_reaction(blade, loads, &[], max_order)
    }

    /// The same with known forces at the bore, which replace the assumed reaction as far
    /// as they balance the loads: all of it, if they are in equilibrium with them.
    pub fn with_reaction(
        blade: &Blade,
        loads: &[RimForce],
        reaction: &[BoreForce],
        max_order: usize,
    ) -> Self {
        let harmonics = (0..=max_order)
            .map(|m| {
                let rim = HarmonicTraction::at_rim(blade, loads, m).fields();
                let bore = HarmonicTraction::at_bore(blade, reaction, m).fields();
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
        let Some([even, odd]) = self.harmonics.get(order) else {
            return HarmonicStress::default();
        };
        let (even, odd) = (even.at(radius_m), odd.at(radius_m));
        HarmonicStress {
            radial_pa: [even.radial_pa, odd.radial_pa],
            hoop_pa: [even.hoop_pa, odd.hoop_pa],
            shear_pa: [-odd.shear_pa, even.shear_pa],
        }
    }

    /// [σ_rr, σ_θθ, σ_rθ] at a point, in Pa: the sum of the series, which converges as
    /// (r/b)^m, and at the rim not at all.
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
