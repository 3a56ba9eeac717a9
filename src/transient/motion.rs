//! Components of a time history: the state, forces that depend on it, and integrators.
//!
//! q̈ + (2ΩG + C) q̇ + K(Ω) q = Σ sₖ(t) bₖ + f(q), in the unknowns q of the reduced blade, whose mass matrix
//! is the identity. The loads bₖ and their magnitudes sₖ are given; a force f depends on the displacement.
//! Every kind of force is a type that implements [`Force`].

use faer::{Col, Mat};

use super::TransientError;

/// Displacement and velocity.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// q, in √kg·m.
    pub displacement: Col<f64>,
    /// q̇, in √kg·m/s.
    pub velocity: Col<f64>,
}

impl State {
    /// At rest, undeflected.
    pub fn rest(order: usize) -> Self {
        State::still(Col::zeros(order))
    }

    /// At rest, with a deflection.
    pub fn still(displacement: Col<f64>) -> Self {
        State {
            velocity: Col::zeros(displacement.nrows()),
            displacement,
        }
    }
}

/// A force that depends on the displacement, in addition to the linear terms.
pub trait Force {
    /// Adds f(q) to `force`, in N/√kg.
    fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>);

    /// Adds −∂f/∂q to `stiffness`, in 1/s².
    fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>);
}

/// An integrator with steps of one length at one speed.
pub trait Integrator {
    /// One step, with the magnitudes of the loads at its beginning and at its end.
    ///
    /// # Errors
    /// [`TransientError::NotBalanced`] if no state at the end of the step was found.
    fn step(&self, state: &State, sizes: [&[f64]; 2]) -> Result<State, TransientError>;
}
