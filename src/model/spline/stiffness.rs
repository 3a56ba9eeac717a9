//! Effect of the simulated reaction on K_e.

use faer::{Mat, MatRef};

use crate::model::plate::{EdgeStress, Plate, RimForce, edge_stiffness};

use super::MeanReaction;
use super::reaction::share;

/// K_e of the same loads at the rim with two reactions at the bore.
#[derive(Debug, Clone)]
pub struct ReactionEffect {
    /// K_e with a traction of constant direction and a uniform shear as reaction, in 1/s².
    pub assumed: Mat<f64>,
    /// K_e with the mean contact forces of the spline teeth as reaction, in 1/s².
    pub simulated: Mat<f64>,
}

/// Assembles K_e of forces at the rim with the assumed and with the simulated reaction.
///
/// The contact forces act at the bore, r = a. The assumed tractions carry the weight, and the difference of
/// torque if the pitch radius is not that of the bore; neither affects K_e of the tilts.
pub fn reaction_effect(
    plate: &Plate,
    loads: &[RimForce],
    reaction: &MeanReaction,
) -> ReactionEffect {
    let max_order = 2 * plate.max_diameters();
    let stiffness = |stations| {
        let stress = EdgeStress::with_reaction(&plate.blade, loads, stations, max_order);
        edge_stiffness(plate, &stress)
    };
    ReactionEffect {
        assumed: stiffness(&[]),
        simulated: stiffness(&reaction.stations),
    }
}

impl ReactionEffect {
    /// ‖K_simulated − K_assumed‖ / ‖K_assumed‖ in the Frobenius norm, on the span of the columns of `modes`,
    /// orthonormal in the mass-normalised basis: the modes that decide a verdict. It is 0 without any load. On the
    /// full model, functions that vary strongly near the bore would dominate this norm, so that it would grow
    /// with the basis.
    pub fn relative_change_on(&self, modes: MatRef<'_, f64>) -> f64 {
        let on_modes = |matrix: &Mat<f64>| modes.transpose() * matrix * modes;
        let (assumed, simulated) = (on_modes(&self.assumed), on_modes(&self.simulated));
        share((&simulated - &assumed).norm_l2(), assumed.norm_l2())
    }
}
