//! Where the blade stands still at one speed, and small motions about that.

use faer::linalg::solvers::Solve;
use faer::{Col, Scale, c64};

use crate::scene::rpm;
use crate::spectrum::{companion_eigenpairs, critical_speeds};

use super::{StretchedBlade, StretchedError, finite};

/// A place where the blade stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// p, r coordinates of the shapes, in √kg·m.
    pub coordinates: Col<f64>,
    /// Negative eigenvalues of ∂²V/∂p²: none at a minimum of V, which is stable.
    pub negative_eigenvalues: usize,
}

/// Most iterations of Newton's method.
pub(super) const ITERATIONS: usize = 30;
/// A correction of this share of the deflection is the last one: the next would be its square.
pub(super) const LAST: f64 = 1e-8;

impl StretchedBlade {
    /// Deflection of an equilibrium at a point of the blade.
    pub fn deflection_m(&self, equilibrium: &Equilibrium, radius_m: f64, angle_rad: f64) -> f64 {
        self.shapes_at((radius_m, angle_rad)).transpose() * &equilibrium.coordinates
    }

    /// The equilibrium that Newton's method finds from a guess; from `None`, from the flat blade.
    ///
    /// # Errors
    /// [`StretchedError::NotFound`], [`StretchedError::Value`].
    pub fn equilibrium(
        &self,
        speed_rad_per_s: f64,
        guess: Option<&Col<f64>>,
    ) -> Result<Equilibrium, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        let flat = || Col::zeros(self.force.nrows());
        let mut p = guess.cloned().unwrap_or_else(flat);
        for _ in 0..ITERATIONS {
            let rest = self.residual(&p, speed_rad_per_s)?;
            let step = self
                .hessian(&p, speed_rad_per_s)?
                .partial_piv_lu()
                .solve(&rest);
            p -= &step;
            if step.norm_l2() <= LAST * p.norm_l2() {
                return self.at(p, speed_rad_per_s);
            }
        }
        Err(self.not_found(&p, speed_rad_per_s))
    }

    /// The eigenvalues of small motions about an equilibrium, with Im λ ≥ 0, by magnitude.
    ///
    /// # Errors
    /// [`StretchedError::Spectrum`].
    pub fn small_motions(&self, equilibrium: &Equilibrium) -> Result<Vec<c64>, StretchedError> {
        let mut system = self.system.clone();
        system.stiffness += self.stretching.hessian(&equilibrium.coordinates)?;
        let pairs = companion_eigenpairs(&system, equilibrium.speed_rad_per_s)?;
        Ok(pairs.into_iter().map(|(lambda, _)| lambda).collect())
    }

    /// The speeds at which leaned equilibria leave the flat blade, ascending, each with the shape that they
    /// lean in, ‖v‖ = 1: the critical speeds of the shapes. Without a side force.
    ///
    /// # Errors
    /// [`StretchedError::Spectrum`].
    pub fn pitchforks(&self) -> Result<Vec<(f64, Col<f64>)>, StretchedError> {
        let critical = critical_speeds(&self.system)?;
        let pairs = critical.into_iter().map(|c| (c.speed_rad_per_s, c.shape));
        Ok(pairs.collect())
    }

    /// The leaned equilibrium a little above a pitchfork: p = εv with ε² = −vᵀK(Ω)v/4U₄(v), corrected by
    /// Newton's method. The other one is −p.
    ///
    /// # Errors
    /// [`StretchedError::NotFound`], also where vᵀK(Ω)v is not negative: the speed is not above
    /// the pitchfork, or not near it.
    pub fn leaned(
        &self,
        speed_rad_per_s: f64,
        shape: &Col<f64>,
    ) -> Result<Equilibrium, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        let stiffness = self.system.stiffness_at(speed_rad_per_s);
        let held = shape.transpose() * &stiffness * shape;
        let square = -held / (4.0 * self.stretching.energy_j(shape)?);
        if !(square > 0.0 && square.is_finite()) {
            return Err(self.not_found(shape, speed_rad_per_s));
        }
        self.equilibrium(speed_rad_per_s, Some(&(Scale(square.sqrt()) * shape)))
    }

    pub(super) fn at(
        &self,
        p: Col<f64>,
        speed_rad_per_s: f64,
    ) -> Result<Equilibrium, StretchedError> {
        let values = self.stiffnesses(&p, speed_rad_per_s)?;
        Ok(Equilibrium {
            negative_eigenvalues: values.iter().filter(|value| **value < 0.0).count(),
            coordinates: p,
            speed_rad_per_s,
        })
    }

    pub(super) fn not_found(&self, p: &Col<f64>, speed_rad_per_s: f64) -> StretchedError {
        let elastic = (self.system.stiffness_at(speed_rad_per_s) * p).norm_max();
        let rest = self
            .residual(p, speed_rad_per_s)
            .map_or(f64::NAN, |rest| rest.norm_max());
        StretchedError::NotFound {
            rpm: rpm(speed_rad_per_s),
            residual: rest / elastic.max(self.force.norm_max()),
        }
    }
}
