//! Resultant of the in-plane loads on the blade.

use crate::model::plate::RimForce;
use crate::model::scene::{Blade, GRAVITY_M_PER_S2};

/// Resultant of the loads at the centre of the blade, fixed in space.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaneLoad {
    /// Force (F_x, F_y); x points to the cut, θ = 0.
    pub force_n: [f64; 2],
    /// Torque about the axis, positive in the direction of rotation.
    pub torque_n_m: f64,
}

impl PlaneLoad {
    /// Resultant of forces at the rim, and of the weight of the blade in the direction `weight_angle_rad`.
    pub fn new(blade: &Blade, loads: &[RimForce], weight_angle_rad: Option<f64>) -> Self {
        let mut sum = PlaneLoad::default();
        if let Some(angle) = weight_angle_rad {
            let weight = blade.mass_kg() * GRAVITY_M_PER_S2;
            sum.force_n = [weight * angle.cos(), weight * angle.sin()];
        }
        for load in loads {
            let (sin, cos) = load.angle_rad.sin_cos();
            sum.force_n[0] += load.radial_n * cos - load.tangential_n * sin;
            sum.force_n[1] += load.radial_n * sin + load.tangential_n * cos;
            sum.torque_n_m += blade.outer_radius_m * load.tangential_n;
        }
        sum
    }
}
