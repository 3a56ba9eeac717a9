//! The reduced basis of a time history.
//!
//! It contains the lowest modes at some speeds, and the static responses to the loads, so that the stiffness
//! against a load is right also where no low mode bends.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, MatRef, Scale, Side};

use crate::model::linalg::SymmetricEigen;
use crate::model::plate::Plate;
use crate::model::scene::{Polar, Tooth};
use crate::model::system::GyroscopicSystem;
use crate::modes::{
    SpectrumError, frequency_scale, lowest_eigenpairs, orthonormal, split, stiffened,
};

/// A system at a speed, whose lowest modes are added to the basis.
#[derive(Debug, Clone, Copy)]
pub struct Snapshot<'a> {
    /// The full model.
    pub system: &'a GyroscopicSystem,
    /// Rotation speed Ω of the modes.
    pub speed_rad_per_s: f64,
}

/// An orthonormal basis V of a subspace of the plate's motions.
#[derive(Debug, Clone)]
pub struct ReducedBlade {
    basis: Mat<f64>,
}

/// Distance of a unit vector from the span of the others below which the basis omits it.
const INDEPENDENT: f64 = 1e-7;

impl ReducedBlade {
    /// A basis that contains the `modes` lowest modes of each snapshot and the static responses K⁻¹b to the loads, for which free
    /// rigid motions have a stiffness.
    pub fn new(
        plate: &Plate,
        snapshots: &[Snapshot<'_>],
        modes: usize,
        loads: &[Col<f64>],
    ) -> Self {
        let order = plate.degrees_of_freedom();
        let shift = frequency_scale(plate);
        let mut vectors = Vec::new();
        for Snapshot {
            system,
            speed_rad_per_s,
        } in snapshots
        {
            vectors.extend(system.free_rigid.iter().cloned());
            // If the modes cannot be computed, the basis consists of all functions.
            let Ok(lowest) = lowest_eigenpairs(system, *speed_rad_per_s, modes, shift) else {
                return Self::whole(plate);
            };
            for (_, q) in lowest {
                let (re, im) = split(&q);
                vectors.extend([re, im]);
            }
            let stiffness = system.stiffness_at(*speed_rad_per_s);
            let factors = stiffened(&stiffness, &system.free_rigid).partial_piv_lu();
            for load in loads {
                let answer = factors.solve(load);
                let norm = answer.norm_l2();
                if norm > 0.0 && norm.is_finite() {
                    vectors.push(Scale(1.0 / norm) * answer);
                }
            }
        }
        ReducedBlade {
            basis: orthonormal(order, &vectors, INDEPENDENT),
        }
    }

    /// Adds all shapes of a non-rotating system below a frequency, which respond to forces up to that
    /// frequency.
    ///
    /// # Errors
    /// [`SpectrumError::Decomposition`].
    pub fn with_shapes_below(
        &self,
        system: &GyroscopicSystem,
        highest_rad_per_s: f64,
    ) -> Result<Self, SpectrumError> {
        let order = system.order();
        let shapes =
            SymmetricEigen::new(system.stiffness.as_ref()).map_err(SpectrumError::at(0.0))?;
        let below = |k: &usize| shapes.values[*k] <= highest_rad_per_s * highest_rad_per_s;
        let slow = (0..order)
            .filter(below)
            .map(|k| shapes.vectors.col(k).to_owned());
        let own = (0..self.order()).map(|k| self.basis.col(k).to_owned());
        let vectors: Vec<Col<f64>> = own.chain(slow).collect();
        Ok(ReducedBlade {
            basis: orthonormal(order, &vectors, INDEPENDENT),
        })
    }

    /// Adds all buckling shapes of a non-rotating system: a load that buckles the blade excites shapes that
    /// differ considerably from the lowest modes.
    ///
    /// # Errors
    /// [`SpectrumError::Decomposition`].
    pub fn with_buckled_shapes(&self, system: &GyroscopicSystem) -> Result<Self, SpectrumError> {
        match system.stiffness.llt(Side::Lower) {
            Ok(_) => Ok(self.clone()),
            Err(_) => self.with_shapes_below(system, 0.0),
        }
    }

    /// The basis of all functions, which gives the full model.
    pub fn whole(plate: &Plate) -> Self {
        let order = plate.degrees_of_freedom();
        ReducedBlade {
            basis: Mat::identity(order, order),
        }
    }

    /// The basis of the same motions rotated around the axis by an angle.
    pub fn turned(&self, plate: &Plate, angle_rad: f64) -> Self {
        let mut basis = self.basis.clone();
        let size = plate.basis.count();
        for n in 1..=plate.max_diameters() {
            let (sin, cos) = (n as f64 * angle_rad).sin_cos();
            let cosine = plate.offset(n);
            for j in cosine..cosine + size {
                for k in 0..basis.ncols() {
                    let (c, s) = (self.basis[(j, k)], self.basis[(j + size, k)]);
                    basis[(j, k)] = c * cos - s * sin;
                    basis[(j + size, k)] = c * sin + s * cos;
                }
            }
        }
        ReducedBlade { basis }
    }

    /// The matrix V, whose columns are orthonormal.
    pub fn basis(&self) -> MatRef<'_, f64> {
        self.basis.as_ref()
    }

    /// Number of basis vectors.
    pub fn order(&self) -> usize {
        self.basis.ncols()
    }

    /// The system on the basis, with the matrices VᵀMV = 1, VᵀKV and so on.
    pub fn system(&self, full: &GyroscopicSystem) -> GyroscopicSystem {
        full.project(self.basis.as_ref())
    }

    /// VᵀAV of a symmetric A.
    pub fn matrix(&self, full: &Mat<f64>) -> Mat<f64> {
        self.basis.transpose() * full * &self.basis
    }

    /// Projection Vᵀb of a load.
    pub fn vector(&self, full: &Col<f64>) -> Col<f64> {
        self.basis.transpose() * full
    }
}

/// Values of all basis functions at a point: the load of a unit force there, and the weights of a probe there.
pub fn at_point(plate: &Plate, place: Polar) -> Col<f64> {
    let values = plate.functions_at(place.radius_m, place.angle_rad);
    Col::from_fn(values.len(), |i| values[i])
}

/// Mean load of one newton across the blade on each tooth, Σ s_k φ(b, θ_k) with the shares s_k of the time.
pub fn lateral_load(plate: &Plate, teeth: &[Tooth]) -> Col<f64> {
    let mut load = Col::zeros(plate.degrees_of_freedom());
    for Tooth { angle_rad, share } in teeth {
        load += Scale(*share) * at_point(plate, Polar::new(plate.blade.outer_radius_m, *angle_rad));
    }
    load
}
