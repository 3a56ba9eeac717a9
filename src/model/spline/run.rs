//! A simulation of the blade on its spline: what it is asked, and what it finds.

use super::reaction::MeanReaction;

/// The blade at one time, in the space-fixed frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitPoint {
    /// Time since the start.
    pub time_s: f64,
    /// Coordinate of the centre, towards the cut.
    pub x_m: f64,
    /// Coordinate of the centre, a quarter turn further in the direction of rotation.
    pub y_m: f64,
    /// Angle ψ by which the blade leads the arbor.
    pub twist_rad: f64,
}

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
