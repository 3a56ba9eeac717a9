//! The rigid tilt of a blade under in-plane forces.
//!
//! For w = x and w = y the geometric stiffness h ∫ σ_xx dA, h ∫ σ_xy dA, h ∫ σ_yy dA is, by equilibrium, the
//! symmetric part of Σ x ⊗ F over all forces at the edges, independently of the stress inside. Uniform shear along
//! an edge and a traction of constant direction contribute nothing.
//!
//! Source: the theorem of the mean stress, M. E. Gurtin, *The Linear Theory of Elasticity*,
//! Encyclopedia of Physics VIa/2 (1972), section 18.

/// A dead force in the plane of the blade: it keeps its direction in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneForce {
    /// Distance of its point from the axis.
    pub radius_m: f64,
    /// Angle of its point.
    pub angle_rad: f64,
    /// Radial component, positive outwards.
    pub radial_n: f64,
    /// Tangential component, positive in the direction of rotation.
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

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::model::analytical::annulus::Annulus;

    /// Many equal outward forces are equivalent to a uniform tension.
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
        let annulus = Annulus {
            bore_radius_m: a,
            rim_radius_m: b,
        };
        let expected = annulus.tilt_frequency_squared_under_rim_tension(rho, tension);
        let inertia = annulus.tilt_inertia_kg_m2(rho * h);
        assert!((xx / inertia / expected - 1.0).abs() < 1e-12);
        assert!((yy / inertia / expected - 1.0).abs() < 1e-12);
        assert!(xy.abs() < 1e-12 * xx);
    }
}
