//! Stress of a flat ring under loads that are the same all around its rim.
//!
//! Source: S. P. Timoshenko & J. N. Goodier, *Theory of Elasticity*, 3rd ed. (1970), section 28
//! (Lamé 1852) and section 43 for the torque.

use super::RadialAndHoop;

/// Stress at a radius under the tension p at the rim, the bore free: A ∓ B/r² with
/// A = p b²/(b² − a²) and B = A a². A pressure is a negative tension.
pub fn stress_under_rim_tension(
    bore_radius_m: f64,
    rim_radius_m: f64,
    tension_pa: f64,
    radius_m: f64,
) -> RadialAndHoop {
    let (aa, bb) = (bore_radius_m.powi(2), rim_radius_m.powi(2));
    let uniform = tension_pa * bb / (bb - aa);
    let share = aa / radius_m.powi(2);
    RadialAndHoop {
        radial_pa: uniform * (1.0 - share),
        hoop_pa: uniform * (1.0 + share),
    }
}

/// σ_rθ in Pa at a radius under a torque T at the rim that is held at the bore: T/(2πr²h), and no
/// other stress.
pub fn shear_under_torque_pa(torque_n_m: f64, thickness_m: f64, radius_m: f64) -> f64 {
    torque_n_m / (std::f64::consts::TAU * radius_m.powi(2) * thickness_m)
}
