//! What the simulated reaction does to K_e.

use faer::{Mat, MatRef};

use crate::plate::{EdgeStress, Plate, RimForce, edge_stiffness};

use super::MeanReaction;

/// K_e of the same loads with either reaction at the bore.
#[derive(Debug, Clone)]
pub struct ReactionEffect {
    /// Reacted by a traction of constant direction and a uniform shear, in 1/s².
    pub assumed: Mat<f64>,
    /// Reacted by the mean contact forces of the spline teeth, in 1/s².
    pub simulated: Mat<f64>,
}

/// Assembles K_e of forces at the rim with the assumed and with the simulated reaction.
///
/// The contact forces act at the bore, r = a. The weight, and what a pitch radius other
/// than the bore's makes of the torque, is left to the assumed tractions: in K_e of the
/// tilts neither shows.
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
    /// ‖K_simulated − K_assumed‖ / ‖K_assumed‖ in the Frobenius norm; 0 without any load.
    ///
    /// In the full model steep functions, which feel the forces at the bore most, rule
    /// this norm: it grows with the basis. See [`ReactionEffect::relative_change_on`].
    pub fn relative_change(&self) -> f64 {
        relative(&(&self.simulated - &self.assumed), &self.assumed)
    }

    /// The same on the span of the columns of `modes`, orthonormal in the mass-normalised
    /// basis: the modes that decide a verdict.
    pub fn relative_change_on(&self, modes: MatRef<'_, f64>) -> f64 {
        let on_modes = |matrix: &Mat<f64>| modes.transpose() * matrix * modes;
        let (assumed, simulated) = (on_modes(&self.assumed), on_modes(&self.simulated));
        relative(&(&simulated - &assumed), &assumed)
    }
}

fn relative(change: &Mat<f64>, of: &Mat<f64>) -> f64 {
    let whole = of.norm_l2();
    if whole > 0.0 {
        change.norm_l2() / whole
    } else {
        0.0
    }
}
