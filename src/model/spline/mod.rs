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
mod stiffness;

#[doc(hidden)]
pub use contact::Contact;
pub(crate) use load::PlaneLoad;
pub(crate) use motion::{InPlaneMotion, OrbitPoint};
pub(crate) use reaction::MeanReaction;
#[doc(hidden)]
pub use stiffness::{ReactionEffect, reaction_effect};

use crate::model::plate::RimForce;
use crate::model::scene::Scene;

/// Duration and accuracy of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Run {
    /// Initial position of the blade.
    pub start: Start,
    /// Number of revolutions before forces are averaged.
    pub settling_revolutions: u32,
    /// Number of revolutions over which forces are averaged.
    pub averaged_revolutions: u32,
    /// Relative tolerance of a step of the integrator.
    pub tolerance: f64,
    /// Largest number of steps. A step takes some 20 µs with 20 teeth; a usual run takes 2000 steps if the
    /// blade is seated and 40 000 if it bounces.
    pub max_steps: usize,
}

/// Initial position of the blade; its centre is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[doc(hidden)]
pub enum Start {
    /// In equilibrium on the teeth under the load, or centred if no tooth resists the load.
    #[default]
    Seated,
    /// Centred on the arbor: the load then accelerates the blade across the gap.
    Centred,
}

impl Default for Run {
    /// Ten revolutions suffice for the motion after the first impact to decay, unless the damping of the contacts
    /// is light.
    fn default() -> Self {
        Run {
            start: Start::Seated,
            settling_revolutions: 10,
            averaged_revolutions: 10,
            tolerance: 1e-8,
            max_steps: 200_000,
        }
    }
}

/// Result of a simulation.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct SplineRun {
    /// Positions of the centre at evenly spaced times, including the settling revolutions.
    pub orbit: Vec<OrbitPoint>,
    /// Index in `orbit` from which forces were averaged.
    pub settled_from: usize,
    /// Reaction of the arbor, averaged in the space-fixed frame.
    pub reaction: MeanReaction,
    /// Largest numerical error of the energy balance, relative to the largest energy of motion and contact: a few
    /// times the number of steps times the tolerance.
    pub energy_defect: f64,
    /// Energy lost in the contacts.
    pub dissipated_j: f64,
    /// Number of steps of the integrator, accepted and rejected.
    pub steps: usize,
}

/// Reason for which the motion could not be simulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// The scene does not contain a spline.
    #[error("the scene has no `spline` block; give the teeth and their contact to simulate it")]
    NoSpline,
    /// The speed is not positive; at rest no teeth pass.
    #[error("the speed must be positive, as the arbor turns forward (you gave {rad_per_s} rad/s)")]
    Speed {
        /// The given speed.
        rad_per_s: f64,
    },
    /// A setting is out of range.
    #[error("{what} must be {allowed} (you gave {value})")]
    Run {
        /// Field of [`Run`].
        what: &'static str,
        /// The given value.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// The vibration on the contacts is too fast for the requested duration.
    #[error(
        "the contact vibrates too fast: {limit} steps reached {reached_s} of {asked_s} s; \
         lower the contact stiffness, the damping or the number of revolutions"
    )]
    Steps {
        /// Largest allowed number of steps.
        limit: usize,
        /// Time reached.
        reached_s: f64,
        /// Requested time.
        asked_s: f64,
    },
    /// A number overflowed.
    #[error("the motion leaves the range of numbers; are load, mass and contact in SI units?")]
    NotFinite,
}

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
