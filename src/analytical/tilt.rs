//! The tilt of a blade as a rigid body, and what in-plane forces do to it.
//!
//! For w = x, w = y the geometric stiffness h ∫ σ_xx, h ∫ σ_xy, h ∫ σ_yy dA is, by equilibrium,
//! the symmetric part of Σ x ⊗ F over all forces at the edges, whatever the stress inside. A
//! traction that is the same all around an edge and a pure shear along it give nothing.
//!
//! Source: the theorem of the mean stress, M. E. Gurtin, *The Linear Theory of Elasticity*,
//! Encyclopedia of Physics VIa/2 (1972), section 18.

use std::f64::consts::PI;

/// A dead force in the plane of the blade: it keeps its direction in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneForce {
    /// Radius of its point, in m.
    pub radius_m: f64,
    /// Angle of its point, in rad.
    pub angle_rad: f64,
    /// Outwards, in N.
    pub radial_n: f64,
    /// In the direction of rotation, in N.
    pub tangential_n: f64,
}

/// Stiffness of the tilts w = x and w = y under forces in the plane: [xx, yy, xy] in N·m, the
/// symmetric part of Σ x ⊗ F.
pub fn stiffness_of_forces_n_m(forces: &[PlaneForce]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for force in forces {
        let (sin, cos) = force.angle_rad.sin_cos();
        let (x, y) = (force.radius_m * cos, force.radius_m * sin);
        let along_x = force.radial_n * cos - force.tangential_n * sin;
        let along_y = force.radial_n * sin + force.tangential_n * cos;
        sum[0] += x * along_x;
        sum[1] += y * along_y;
        sum[2] += 0.5 * (x * along_y + y * along_x);
    }
    sum
}

/// ∫ ρh x² dA = ρh π (b⁴ − a⁴)/4, in kg·m²: the inertia of the tilt w = x.
pub fn inertia_kg_m2(bore_radius_m: f64, rim_radius_m: f64, mass_per_area_kg_per_m2: f64) -> f64 {
    0.25 * PI * mass_per_area_kg_per_m2 * (rim_radius_m.powi(4) - bore_radius_m.powi(4))
}

/// ω² of the tilt of a resting blade under the tension p at its rim, in 1/s²:
/// 4 p b²/ρ(b⁴ − a⁴), as long as it hardly bends.
pub fn frequency_squared_under_rim_tension(
    bore_radius_m: f64,
    rim_radius_m: f64,
    density_kg_per_m3: f64,
    tension_pa: f64,
) -> f64 {
    let fourths = rim_radius_m.powi(4) - bore_radius_m.powi(4);
    4.0 * tension_pa * rim_radius_m.powi(2) / (density_kg_per_m3 * fourths)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many equal forces outwards are the tension.
    #[test]
    fn a_ring_of_forces_is_the_tension() {
        let (a, b, h, rho, tension) = (0.1, 0.3, 0.002, 7800.0, 3e5);
        let count = 24;
        let each = tension * 2.0 * PI * b * h / f64::from(count);
        let forces: Vec<PlaneForce> = (0..count)
            .map(|k| PlaneForce {
                radius_m: b,
                angle_rad: 2.0 * PI * f64::from(k) / f64::from(count) + 0.3,
                radial_n: each,
                tangential_n: 17.0,
            })
            .collect();
        let [xx, yy, xy] = stiffness_of_forces_n_m(&forces);
        let expected = frequency_squared_under_rim_tension(a, b, rho, tension);
        let inertia = inertia_kg_m2(a, b, rho * h);
        assert!((xx / inertia / expected - 1.0).abs() < 1e-12);
        assert!((yy / inertia / expected - 1.0).abs() < 1e-12);
        assert!(xy.abs() < 1e-12 * xx);
    }
}
