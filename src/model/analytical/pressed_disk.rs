//! Stress of a full disk under two opposite forces.
//!
//! The stress of each force is that on a half-plane, −2P cos φ/πhs along the line from the force to a point
//! at the distance s, with the angle φ to the axis of the force. Together with a uniform tension P/πbh the
//! rim is free.
//!
//! Source: S. P. Timoshenko & J. N. Goodier, *Theory of Elasticity*, 3rd ed. (1970), section 41.

use std::f64::consts::PI;

/// Stresses [σ_rr, σ_θθ, σ_rθ] in Pa at r, θ of a disk of radius b and thickness h under two inward forces P at its
/// rim, at θ = 0 and π.
pub fn stress_pa(
    rim_radius_m: f64,
    thickness_m: f64,
    force_n: f64,
    radius_m: f64,
    angle_rad: f64,
) -> [f64; 3] {
    let uniform = force_n / (PI * rim_radius_m * thickness_m);
    let mut stress = [uniform, uniform, 0.0];
    for place_rad in [0.0, PI] {
        // In the radial and hoop directions at the point, the vector from the force to the point is (x, y).
        let (sin, cos) = (place_rad - angle_rad).sin_cos();
        let (x, y) = (radius_m - rim_radius_m * cos, -rim_radius_m * sin);
        let distance = x.hypot(y);
        let cos_off_axis = -(x * cos + y * sin) / distance;
        let along = -2.0 * force_n * cos_off_axis / (PI * thickness_m * distance);
        stress[0] += along * (x / distance).powi(2);
        stress[1] += along * (y / distance).powi(2);
        stress[2] += along * x * y / (distance * distance);
    }
    stress
}
