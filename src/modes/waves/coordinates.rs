//! Coordinates of a component: its near waves and few vectors of far ones.

use faer::{Col, Mat, c64};

use crate::model::system::GyroscopicSystem;
use crate::modes::residual::{Lifted, lifted};
use crate::modes::vectors::{Eigenpair, halves, real_times};

/// A component in coordinates of few orthonormal vectors.
#[derive(Debug, Clone)]
pub struct Coordinates {
    /// V, N × r, with orthonormal columns.
    pub vectors: Mat<f64>,
    /// Vᵀ times the matrices times V.
    pub system: GyroscopicSystem,
    /// The matrices times V, for residuals on the whole component.
    products: GyroscopicSystem,
}

impl Coordinates {
    /// The matrices of a component in coordinates of orthonormal vectors.
    pub fn new(full: &GyroscopicSystem, vectors: Mat<f64>) -> Self {
        let products = full.times(vectors.as_ref());
        let system = products.onto(vectors.as_ref());
        Coordinates {
            vectors,
            system,
            products,
        }
    }

    /// Vq.
    pub fn shape(&self, q: &Col<c64>) -> Col<c64> {
        real_times(&self.vectors, q)
    }

    /// Vq and L(λ)Vq of pairs (λ, q) at one speed, all in one product of matrices.
    pub fn lifted(&self, speed_rad_per_s: f64, pairs: &[Eigenpair]) -> Vec<Lifted> {
        let coordinates = halves(self.vectors.ncols(), pairs.iter().map(|(_, q)| q));
        let shapes = &self.vectors * &coordinates;
        let force = self.products.stiffness_at(speed_rad_per_s) * &coordinates;
        let momentum = self.products.velocity_at(speed_rad_per_s) * &coordinates;
        let lambdas = pairs.iter().map(|(lambda, _)| *lambda);
        lifted(lambdas, [&shapes, &momentum, &force])
    }
}
