//! The residual of the equation of motion for an eigenpair.

use faer::{Col, Mat, c64};

use super::vectors::joined;
use crate::model::system::GyroscopicSystem;

/// A mode in the unknowns of its component.
#[derive(Debug)]
pub struct Lifted {
    /// Deflection q.
    pub shape: Col<c64>,
    /// Residual L(λ)q.
    pub residual: Col<c64>,
}

/// Modes with their residuals λ(λq + Dq) + Kq from the [`halves`](super::vectors::halves) of q, Dq and Kq.
pub fn lifted(
    lambdas: impl Iterator<Item = c64>,
    [shapes, momentum, force]: [&Mat<f64>; 3],
) -> Vec<Lifted> {
    let of = |(k, lambda): (usize, c64)| {
        let [shape, momentum, force] = [shapes, momentum, force].map(|all| joined(all, k));
        let residual = Col::from_fn(shape.nrows(), |i| {
            lambda * (lambda * shape[i] + momentum[i]) + force[i]
        });
        Lifted { shape, residual }
    };
    lambdas.enumerate().map(of).collect()
}

/// ‖D‖ and ‖K‖ at any speed, from the products of their terms, for residuals.
#[derive(Debug)]
pub struct MatrixNorms {
    /// Products Σ aᵢⱼbᵢⱼ of K₀, K_σ − N, K_circ and K_n, whose factors in K(Ω) are 1, Ω², Ω and 1.
    stiffness: [[f64; 4]; 4],
    /// Products Σ aᵢⱼbᵢⱼ of G and C, whose factors in D(Ω) are 2Ω and 1.
    velocity: [[f64; 2]; 2],
}

impl MatrixNorms {
    /// Computes the products of the terms of a system.
    pub fn new(system: &GyroscopicSystem) -> Self {
        let stiffness = [
            Some(&system.stiffness),
            Some(&system.spin),
            system.circulatory.as_ref(),
            system.nonconservative.as_ref(),
        ];
        let velocity = [Some(&system.gyroscopic), system.damping.as_ref()];
        MatrixNorms {
            stiffness: stiffness.map(|left| stiffness.map(|right| product(left, right))),
            velocity: velocity.map(|left| velocity.map(|right| product(left, right))),
        }
    }

    /// ‖L(λ)q‖ / ((|λ|² + |λ|‖D‖ + ‖K‖) ‖q‖): the relative change of the matrices
    /// that would make the pair exact (Tisseur, Linear Algebra Appl. 309, 2000).
    pub fn backward_error(&self, speed_rad_per_s: f64, lambda: c64, lifted: &Lifted) -> f64 {
        let speed = speed_rad_per_s;
        let stiffness = norm(&self.stiffness, [1.0, speed * speed, speed, 1.0]);
        let velocity = norm(&self.velocity, [2.0 * speed, 1.0]);
        let size = lambda.norm_sqr() + lambda.norm() * velocity + stiffness;
        let denominator = size * lifted.shape.norm_l2();
        if denominator > 0.0 {
            lifted.residual.norm_l2() / denominator
        } else {
            0.0
        }
    }
}

/// Σ aᵢⱼ bᵢⱼ; zero for an absent term.
fn product(left: Option<&Mat<f64>>, right: Option<&Mat<f64>>) -> f64 {
    let Some((left, right)) = left.zip(right) else {
        return 0.0;
    };
    let columns = left.col_iter().zip(right.col_iter());
    columns.map(|(x, y)| x.transpose() * y).sum()
}

/// ‖Σ wᵢ Aᵢ‖ from the products of the Aᵢ.
fn norm<const N: usize>(products: &[[f64; N]; N], weights: [f64; N]) -> f64 {
    let rows = products.iter().zip(weights);
    let square: f64 = rows
        .map(|(row, w)| w * row.iter().zip(weights).map(|(p, v)| p * v).sum::<f64>())
        .sum();
    square.max(0.0).sqrt()
}
