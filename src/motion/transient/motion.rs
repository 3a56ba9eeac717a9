//! Components of a time history: the state, forces that depend on it, and integrators.
//!
//! q̈ + (2ΩG + C) q̇ + K(Ω) q = Σ sₖ(t) bₖ + f(q), in the unknowns q of the reduced blade, whose mass matrix
//! is the identity. The loads bₖ and their magnitudes sₖ are given; a force f depends on the displacement.
//! Every kind of force is a type that implements [`Force`].

use faer::{Col, Mat, Scale};

use super::TransientError;

/// Displacement and velocity of the reduced blade.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// q, in √kg·m.
    pub displacement: Col<f64>,
    /// q̇, in √kg·m/s.
    pub velocity: Col<f64>,
}

impl State {
    /// The undeflected blade at rest.
    pub fn rest(order: usize) -> Self {
        State::still(Col::zeros(order))
    }

    /// A deflected blade at rest.
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

    /// f(q) at some displacements, a column each.
    fn forces_at(&self, displacements: &Mat<f64>) -> Mat<f64> {
        let mut forces = Mat::zeros(displacements.nrows(), displacements.ncols());
        for (displacement, mut column) in displacements.col_iter().zip(forces.col_iter_mut()) {
            let mut force = Col::zeros(displacement.nrows());
            self.add_to(&displacement.to_owned(), &mut force);
            column.copy_from(&force);
        }
        forces
    }

    /// Weighted sums of −∂f/∂q over some displacements: one for each column of `weights`, which has a row for each displacement,
    /// with the columns of the matrix below each other.
    fn stiffness_sums(&self, displacements: &Mat<f64>, weights: &Mat<f64>) -> Mat<f64> {
        let order = displacements.nrows();
        let mut all = Mat::zeros(order * order, displacements.ncols());
        for (displacement, mut column) in displacements.col_iter().zip(all.col_iter_mut()) {
            let mut own = Mat::zeros(order, order);
            self.add_stiffness(&displacement.to_owned(), &mut own);
            for j in 0..order {
                column
                    .as_mut()
                    .subrows_mut(j * order, order)
                    .copy_from(own.col(j));
            }
        }
        all * weights
    }

    /// Adds ∫₀¹ f(q + s d) ds to `force`: by two Gauss points, exactly for forces up to the third power of q.
    fn add_mean_to(&self, displacement: &Col<f64>, change: &Col<f64>, force: &mut Col<f64>) {
        let mut sum = Col::zeros(force.nrows());
        for share in ON_LINE {
            self.add_to(&(displacement + Scale(share) * change), &mut sum);
        }
        *force += Scale(0.5) * sum;
    }

    /// Adds −∂/∂d of ∫₀¹ f(q + s d) ds to `stiffness`, in 1/s².
    fn add_mean_stiffness(
        &self,
        displacement: &Col<f64>,
        change: &Col<f64>,
        stiffness: &mut Mat<f64>,
    ) {
        for share in ON_LINE {
            let mut own = Mat::zeros(stiffness.nrows(), stiffness.ncols());
            self.add_stiffness(&(displacement + Scale(share) * change), &mut own);
            *stiffness += Scale(0.5 * share) * own;
        }
    }
}

/// Gauss points of the straight line from 0 to 1, each with the weight ½.
const ON_LINE: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// An integrator with steps of one length at one speed.
pub trait Integrator {
    /// Returns the state after one step, from the magnitudes of the loads at its beginning and at its end.
    ///
    /// # Errors
    /// [`TransientError::NotBalanced`] if no state was found that balances the forces.
    fn step(&self, state: &State, sizes: [&[f64]; 2]) -> Result<State, TransientError>;
}
