//! Forces at the edges and their Fourier coefficients.

use std::f64::consts::PI;

use crate::model::scene::{Blade, CutRun, Tooth};

/// A force at a point of the rim r = b, fixed in place and direction in space.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RimForce {
    /// Angle θ, positive in the direction of rotation.
    pub angle_rad: f64,
    /// Component along the radius, positive outwards.
    pub radial_n: f64,
    /// Component along the rim, positive in the direction of rotation.
    pub tangential_n: f64,
}

impl RimForce {
    /// The mean forces of a cut on teeth, each at its place for a share of the time.
    pub fn of_teeth(teeth: &[Tooth], run: &CutRun) -> Vec<Self> {
        let of_tooth = |tooth: &Tooth| RimForce {
            angle_rad: tooth.angle_rad,
            radial_n: -tooth.share * run.radial_n,
            tangential_n: -tooth.share * run.tangential_n,
        };
        teeth.iter().map(of_tooth).collect()
    }
}

/// A force on the blade at a point of the bore r = a, fixed in place and direction in space.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BoreForce {
    /// Angle θ, positive in the direction of rotation.
    pub angle_rad: f64,
    /// Component along the radius, positive outwards.
    pub radial_n: f64,
    /// Component along the bore, positive in the direction of rotation.
    pub tangential_n: f64,
}

/// Order m of the stresses (σ_rr, σ_rθ) at an edge, in Pa: the amplitudes of the two fields that vary as
/// (cos mθ, sin mθ) and as (sin mθ, −cos mθ).
type Traction = [[f64; 2]; 2];

/// The traction of order m at the rim, where the outward normal is +r.
pub fn traction_at_rim(blade: &Blade, loads: &[RimForce], order: usize) -> Traction {
    let b = blade.outer_radius_m;
    traction(b * blade.thickness_at_m(b), loads.iter().copied(), order)
}

/// The traction of order m at the bore, where the outward normal is −r, so that an outward force causes
/// compression.
pub fn traction_at_bore(blade: &Blade, reaction: &[BoreForce], order: usize) -> Traction {
    let forces = reaction.iter().map(|force| RimForce {
        angle_rad: force.angle_rad,
        radial_n: -force.radial_n,
        tangential_n: -force.tangential_n,
    });
    let area_per_angle_m2 = blade.inner_radius_m * blade.thickness_at_bore_m();
    traction(area_per_angle_m2, forces, order)
}

/// Order m of the traction Σ F/(rh) δ(θ − θ_k): (1/π) ΣF cos mθ_k /(rh) and (1/π) ΣF sin mθ_k /(rh), half of
/// this for m = 0.
fn traction(
    area_per_angle_m2: f64,
    forces: impl Iterator<Item = RimForce>,
    order: usize,
) -> Traction {
    let mean = if order == 0 { 0.5 } else { 1.0 };
    let per_newton = mean / (PI * area_per_angle_m2);
    let mut fields = Traction::default();
    for force in forces {
        let RimForce {
            angle_rad,
            radial_n,
            tangential_n,
        } = force;
        let (sin, cos) = (order as f64 * angle_rad).sin_cos();
        fields[0][0] += per_newton * radial_n * cos;
        fields[0][1] += per_newton * tangential_n * sin;
        fields[1][0] += per_newton * radial_n * sin;
        fields[1][1] -= per_newton * tangential_n * cos;
    }
    fields
}
