//! Motion of the blade in its own plane, loose on a splined arbor.
//!
//! The blade is a rigid disk with three freedoms: its centre (x, y) in the space-fixed
//! frame and the angle ψ by which it leads the arbor, which turns at a constant Ω:
//!
//!   m ẍ = F_load + Σ F_k n_k,   J ψ̈ = T_load + r_p Σ F_k n_k·t_k
//!
//! Every spline tooth has two flanks at the pitch radius r_p, turned by ±α (the pressure
//! angle) from the tangent t_k: n_k = ±cos α t_k + sin α r_k is the direction in which
//! the arbor's flank pushes the blade. A flank is pressed in by x_k = −u_k·n_k − c, where
//! u_k = (x, y) + r_p ψ t_k is how far the blade has moved there and c the gap of the
//! centred blade. It pushes with F = K x^{3/2} + C ẋ^{3/2} (the paper's equation 1), C
//! with the sign of ẋ, and never pulls: F ≥ 0, and F = 0 without touch.
//!
//! Displacements are small beside the pitch of the teeth, so normals stay those of the
//! centred arbor. Friction, unbalance and the blade's in-plane elasticity are left out;
//! the cutting forces are their means. The integrator is DOP853 (order 8, adaptive
//! steps, dense output) of `differential-equations`: the only fast motion is the
//! vibration on the contacts, which an explicit method has to resolve anyway.
//!
//! Not run unless asked for: see [`crate::scene::SplineFile`].

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

use crate::plate::RimForce;
use crate::scene::Scene;

/// How long and how finely to simulate.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Run {
    /// Where the blade begins.
    pub start: Start,
    /// Revolutions given to the motion to settle.
    pub settling_revolutions: u32,
    /// Revolutions over which forces are averaged.
    pub averaged_revolutions: u32,
    /// Relative tolerance of the integrator, on a step.
    pub tolerance: f64,
    /// Where to give up. A step takes some 20 µs with 20 teeth, and a usual run 2000 steps
    /// seated and 40 000 bouncing.
    pub max_steps: usize,
}

/// Where the blade begins; its centre is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[doc(hidden)]
pub enum Start {
    /// Seated on the teeth under the load, centred if the load does not press it on any.
    #[default]
    Seated,
    /// Centred on the arbor: the load then throws it across the gap.
    Centred,
}

impl Default for Run {
    /// Ten revolutions let the shock of the first touch of a damped contact die out
    /// (a light damping never does).
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

/// What the simulation gives.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct SplineRun {
    /// The centre at evenly spread times, settling included.
    pub orbit: Vec<OrbitPoint>,
    /// Index in `orbit` from which forces were averaged.
    pub settled_from: usize,
    /// The reaction of the arbor, averaged in the space-fixed frame.
    pub reaction: MeanReaction,
    /// Largest energy that came from nowhere, relative to the largest energy in motion
    /// and contact: the error of the integration, a few times steps × tolerance.
    pub energy_defect: f64,
    /// Energy lost in the contacts.
    pub dissipated_j: f64,
    /// Steps of the integrator, accepted and rejected.
    pub steps: usize,
}

/// Why the motion could not be simulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// The scene does not ask for it.
    #[error("the scene has no `spline` block; give the teeth and their contact to simulate it")]
    NotAsked,
    /// At rest the arbor passes no teeth.
    #[error("the speed is {rad_per_s} rad/s, but must be positive; the arbor turns forward")]
    Speed {
        /// The speed asked for.
        rad_per_s: f64,
    },
    /// Nothing to average, or no tolerance to keep.
    #[error("{what} is {value}, but must be {allowed}")]
    Run {
        /// Field of [`Run`].
        what: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The vibration on the contacts is too fast for the time asked for.
    #[error(
        "the contact vibrates too fast: {limit} steps reached {reached_s} of {asked_s} s; \
         lower the contact stiffness, the damping or the number of revolutions"
    )]
    Steps {
        /// Most steps allowed.
        limit: usize,
        /// Time reached.
        reached_s: f64,
        /// Time asked for.
        asked_s: f64,
    },
    /// Numbers beyond what a double holds.
    #[error("the motion leaves the range of numbers; are load, mass and contact in SI units?")]
    NotFinite,
}

/// Simulates the blade of a scene under forces at its rim at a constant speed.
///
/// # Errors
/// [`SplineError`] when the scene has no `spline` block, or the motion cannot be followed.
#[doc(hidden)]
pub fn simulate(
    scene: &Scene,
    loads: &[RimForce],
    speed_rad_per_s: f64,
    run: &Run,
) -> Result<SplineRun, SplineError> {
    let spline = scene.spline().ok_or(SplineError::NotAsked)?;
    let load = PlaneLoad::new(scene.blade(), loads, spline.weight_angle_rad);
    let motion = InPlaneMotion::new(scene.blade(), spline, load, speed_rad_per_s)?;
    motion.run(run)
}

#[cfg(test)]
mod contact_tests;
#[cfg(test)]
mod tests;
