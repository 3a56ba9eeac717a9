//! A component projected on few vectors, and the residual of the projection.

use faer::{Col, Mat};

use crate::model::system::GyroscopicSystem;

use super::residual::Lifted;
use super::vectors::{Eigenpair, halves, joined};

/// A component projected on few orthonormal vectors.
#[derive(Debug, Clone)]
pub struct Projection {
    /// V, N × r, with orthonormal columns.
    pub basis: Mat<f64>,
    /// The matrices projected on V.
    pub reduced: GyroscopicSystem,
    /// The matrices times V, for residuals on the whole component.
    products: GyroscopicSystem,
}

impl Projection {
    /// Projects a component on orthonormal vectors.
    pub fn new(system: &GyroscopicSystem, basis: Mat<f64>) -> Self {
        let products = system.times(basis.as_ref());
        let reduced = products.onto(basis.as_ref());
        Projection {
            basis,
            reduced,
            products,
        }
    }

    /// The whole component, with V = 1.
    pub fn whole(system: &GyroscopicSystem) -> Self {
        Projection {
            basis: Mat::identity(system.order(), system.order()),
            reduced: system.clone(),
            products: system.clone(),
        }
    }

    /// Vq and L(λ)Vq of pairs (λ, q) at one speed, all in one product of matrices.
    pub fn lifted(&self, speed_rad_per_s: f64, pairs: &[Eigenpair]) -> Vec<Lifted> {
        let coordinates = halves(self.basis.ncols(), pairs.iter().map(|(_, q)| q));
        let shape = &self.basis * &coordinates;
        let force = self.products.stiffness_at(speed_rad_per_s) * &coordinates;
        let momentum = self.products.velocity_at(speed_rad_per_s) * &coordinates;
        pairs
            .iter()
            .enumerate()
            .map(|(k, (lambda, _))| {
                let shape = joined(&shape, k);
                let (force, momentum) = (joined(&force, k), joined(&momentum, k));
                let residual = Col::from_fn(shape.nrows(), |i| {
                    lambda * (lambda * shape[i] + momentum[i]) + force[i]
                });
                Lifted { shape, residual }
            })
            .collect()
    }
}
