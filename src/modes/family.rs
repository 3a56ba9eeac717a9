//! Eigenvalue problems L(λ, Ω) x = 0 that depend on the speed, with their derivatives.

use faer::{Mat, c64};

use super::derivative::stands_still;
use crate::model::system::GyroscopicSystem;

/// Matrices L(λ, Ω).
pub trait Family {
    /// The matrices at a speed.
    type At<'a>: MatrixPolynomial
    where
        Self: 'a;

    /// The matrices at a speed; `None` if the family does not reach it.
    fn at(&self, speed_rad_per_s: f64) -> Option<Self::At<'_>>;
}

/// Matrices L(λ) at a speed.
pub trait MatrixPolynomial {
    /// Number of unknowns.
    fn order(&self) -> usize;

    /// Size of usual eigenvalues, in 1/s.
    fn unit_per_s(&self) -> f64;

    /// L, L_λ, L_λλ, …
    fn by_root<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT];

    /// L_Ω, L_Ωλ, …
    fn by_speed<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT];
}

/// A system at a speed.
pub struct SystemAt<'a> {
    system: &'a GyroscopicSystem,
    speed_rad_per_s: f64,
    stiffness: Mat<f64>,
    velocity: Mat<f64>,
}

impl Family for GyroscopicSystem {
    type At<'a> = SystemAt<'a>;

    fn at(&self, speed_rad_per_s: f64) -> Option<SystemAt<'_>> {
        Some(SystemAt {
            system: self,
            speed_rad_per_s,
            stiffness: self.stiffness_at(speed_rad_per_s),
            velocity: self.velocity_at(speed_rad_per_s),
        })
    }
}

impl MatrixPolynomial for SystemAt<'_> {
    fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    fn unit_per_s(&self) -> f64 {
        1.0
    }

    fn by_root<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT] {
        let of_unit = [lambda * lambda, 2.0 * lambda, c64::from(2.0)];
        std::array::from_fn(|degree| {
            let velocity = [lambda, c64::ONE].get(degree).copied();
            let mut matrix = Mat::from_fn(self.order(), self.order(), |i, k| {
                let held = if degree == 0 {
                    self.stiffness[(i, k)]
                } else {
                    0.0
                };
                velocity.map_or(c64::ZERO, |factor| factor * self.velocity[(i, k)]) + held
            });
            if let Some(unit) = of_unit.get(degree) {
                (0..self.order()).for_each(|i| matrix[(i, i)] += unit);
            }
            matrix
        })
    }

    fn by_speed<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT] {
        let GyroscopicSystem {
            spin,
            gyroscopic,
            circulatory,
            drift,
            ..
        } = self.system;
        let drift = drift.as_ref().filter(|_| stands_still(lambda));
        let entry = |matrix: Option<&Mat<f64>>, i, k| matrix.map_or(0.0, |matrix| matrix[(i, k)]);
        let order = self.order();
        std::array::from_fn(|degree| match degree {
            0 => Mat::from_fn(order, order, |i, k| {
                let turned = 2.0 * self.speed_rad_per_s * (spin[(i, k)] + entry(drift, i, k));
                2.0 * lambda * gyroscopic[(i, k)] + turned + entry(circulatory.as_ref(), i, k)
            }),
            1 => Mat::from_fn(order, order, |i, k| c64::from(2.0 * gyroscopic[(i, k)])),
            _ => Mat::zeros(order, order),
        })
    }
}
