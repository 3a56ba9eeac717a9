//! Motion of the blade in its plane, loose on a splined arbor.
//!
//! The blade is a rigid disk with three degrees of freedom: its centre (x, y) in the space-fixed frame and
//! the angle ψ by which it leads the arbor, which turns at a constant Ω:
//!
//!   m ẍ = F_load + Σ F_k n_k,   J ψ̈ = T_load + r_p Σ F_k n_k·t_k
//!
//! Every spline tooth has two flanks at the pitch radius r_p, rotated by ±α (the pressure angle) from the
//! tangent t_k: n_k = ±cos α t_k + sin α r_k is the direction in which the arbor's flank pushes the blade.
//! The approach of a flank is x_k = −u_k·n_k − c, where u_k = (x, y) + r_p ψ t_k is the displacement of the
//! blade there and c the gap of the centred blade. The force of the flank is F = K x^{3/2} + C ẋ^{3/2} (the
//! paper's equation 1), where the term of C has the sign of ẋ. F is not negative, and zero without contact.
//!
//! Displacements are small compared with the pitch of the teeth, so that the normals are those of the centred
//! blade. Friction, unbalance and in-plane elasticity of the blade are neglected; cutting forces are
//! represented by their means. The integrator is DOP853 (order 8, adaptive steps, dense output) of
//! `differential-equations`: the only fast motion is the vibration on the contacts, which an explicit method
//! has to resolve anyway.
//!
//! The motion is simulated only if the scene has a `spline` block, see [`crate::model::scene::SplineFile`].

mod contact;
mod load;
mod motion;
mod reaction;
mod run;
mod stiffness;

#[doc(hidden)]
pub use contact::Contact;
pub(crate) use load::PlaneLoad;
pub(crate) use motion::InPlaneMotion;
pub(crate) use reaction::MeanReaction;
pub use run::SplineError;
#[doc(hidden)]
pub use run::{Run, SplineRun, Start};
#[doc(hidden)]
pub use stiffness::{ReactionEffect, reaction_effect};

use crate::model::plate::RimForce;
use crate::model::scene::Scene;

/// Simulates the blade of a scene under forces at its rim at a constant speed.
///
/// # Errors
/// [`SplineError`] if the scene has no `spline` block, a setting is out of range, or the motion cannot be followed.
#[doc(hidden)]
pub fn simulate(
    scene: &Scene,
    loads: &[RimForce],
    speed_rad_per_s: f64,
    run: &Run,
) -> Result<SplineRun, SplineError> {
    let spline = scene.spline().ok_or(SplineError::NoSpline)?;
    let weight_angle_rad = spline.weight_angle_deg.map(f64::to_radians);
    let load = PlaneLoad::new(scene.blade(), loads, weight_angle_rad);
    let motion = InPlaneMotion::new(scene.blade(), spline, load, speed_rad_per_s)?;
    motion.run(run)
}

#[cfg(test)]
mod contact_tests;
#[cfg(test)]
mod tests;
