//! Forces at the rim and their Fourier coefficients.

use std::f64::consts::PI;

use crate::scene::Blade;

/// A force at a point of the rim r = b, fixed in place and direction in space.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RimForce {
    /// Where: θ, positive in the direction of rotation.
    pub angle_rad: f64,
    /// Component along the radius, positive outwards.
    pub radial_n: f64,
    /// Component along the rim, positive in the direction of rotation.
    pub tangential_n: f64,
}

/// Factors of [cos mθ, sin mθ] of the traction on the rim.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HarmonicTraction {
    /// σ_rr(b).
    pub radial_pa: [f64; 2],
    /// σ_rθ(b).
    pub shear_pa: [f64; 2],
}

/// Order m of the traction Σ F/(bh) δ(θ − θ_k): (1/π) ΣF cos mθ_k /(bh) and the same
/// with sin, and half of it for m = 0.
pub fn harmonic_traction(blade: &Blade, loads: &[RimForce], order: usize) -> HarmonicTraction {
    let mean = if order == 0 { 0.5 } else { 1.0 };
    let per_newton = mean / (PI * blade.outer_radius_m * blade.thickness_m);
    let mut sum = HarmonicTraction::default();
    for load in loads {
        let (sin, cos) = (order as f64 * load.angle_rad).sin_cos();
        for (part, wave) in [cos, sin].into_iter().enumerate() {
            sum.radial_pa[part] += per_newton * load.radial_n * wave;
            sum.shear_pa[part] += per_newton * load.tangential_n * wave;
        }
    }
    sum
}
