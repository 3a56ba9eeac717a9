//! Equilibria at one speed, and small motions about them.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::model::linalg::symmetric_eigenvalues;
use crate::model::scene::{Polar, rpm};
use crate::modes::{SpectrumError, critical_speeds, eigenvalues};

use super::{ROUNDING, StretchedBlade, StretchedError, finite};

/// An equilibrium of the blade.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Coordinates p of the r shapes, in √kg·m.
    pub coordinates: Col<f64>,
    /// Number of negative eigenvalues of ∂²V/∂p²; zero at a minimum of V, which is stable.
    pub negative_eigenvalues: usize,
}

/// Largest number of iterations of Newton's method.
pub(super) const ITERATIONS: usize = 30;
/// Relative size of the last correction; that of the next would be its square.
pub(super) const LAST: f64 = 1e-8;

impl Equilibrium {
    /// The equilibrium with the eigenvalues of ∂²V/∂p² there, ascending.
    pub(super) fn of(coordinates: Col<f64>, speed_rad_per_s: f64, values: &[f64]) -> Self {
        let zero = -ROUNDING * values.last().copied().unwrap_or_default().abs();
        Equilibrium {
            speed_rad_per_s,
            coordinates,
            negative_eigenvalues: values.iter().filter(|value| **value < zero).count(),
        }
    }

    /// The equilibrium with ∂²V/∂p² there.
    ///
    /// # Errors
    /// [`StretchedError::Spectrum`].
    pub(super) fn with_hessian(
        coordinates: Col<f64>,
        speed_rad_per_s: f64,
        hessian: &Mat<f64>,
    ) -> Result<Self, StretchedError> {
        let values =
            symmetric_eigenvalues(hessian.as_ref()).map_err(SpectrumError::at(speed_rad_per_s))?;
        Ok(Equilibrium::of(coordinates, speed_rad_per_s, &values))
    }
}

impl StretchedBlade {
    /// Deflection of an equilibrium at a point of the blade.
    pub fn deflection_m(&self, equilibrium: &Equilibrium, radius_m: f64, angle_rad: f64) -> f64 {
        self.shapes_at(Polar::new(radius_m, angle_rad)).transpose() * &equilibrium.coordinates
    }

    /// Force of each pad that lifts off on the blade, by contact and film, in the order of the scene's guides.
    pub fn pad_forces_n(&self, equilibrium: &Equilibrium) -> Vec<f64> {
        let gaps = self.gaps.as_ref();
        gaps.map_or_else(Vec::new, |gaps| gaps.forces_n(&equilibrium.coordinates))
    }

    /// Force of the blade on both faces of each pad that lifts off, on that at positive deflections and on the other.
    pub(crate) fn face_forces_n(&self, equilibrium: &Equilibrium) -> Vec<[f64; 2]> {
        let gaps = self.gaps.as_ref();
        gaps.map_or_else(Vec::new, |gaps| {
            gaps.face_forces_n(&equilibrium.coordinates)
        })
    }

    /// Smallest distance between the blade and a face of each pad that lifts off; negative where a face is
    /// compressed.
    pub(crate) fn distances_left_m(&self, equilibrium: &Equilibrium) -> Vec<f64> {
        let gaps = self.gaps.as_ref();
        gaps.map_or_else(Vec::new, |gaps| {
            gaps.distances_left_m(&equilibrium.coordinates)
        })
    }

    /// Radius, in m, and magnitude of the force, in N, at each point at which a pad that lifts off touches the blade.
    pub(crate) fn contacts(&self, equilibrium: &Equilibrium) -> Vec<(f64, f64)> {
        let gaps = self.gaps.as_ref();
        gaps.map_or_else(Vec::new, |gaps| gaps.contacts(&equilibrium.coordinates))
    }

    /// The equilibrium to which Newton's method converges from a guess, or, for `None`, from the flat blade.
    ///
    /// # Errors
    /// [`StretchedError::NotFound`] if it does not converge, [`StretchedError::Value`].
    pub fn equilibrium(
        &self,
        speed_rad_per_s: f64,
        guess: Option<&Col<f64>>,
    ) -> Result<Equilibrium, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        let mut p = guess.cloned().unwrap_or_else(|| self.flat());
        for _ in 0..ITERATIONS {
            let tension = self.stretching.tension(&p)?;
            let rest = self.residual_with(&p, &tension, speed_rad_per_s);
            let step = self
                .hessian_with(&p, &tension, speed_rad_per_s)
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
        system.stiffness += self.added_stiffness(&equilibrium.coordinates)?;
        let mut motions = eigenvalues(&system, equilibrium.speed_rad_per_s)?;
        motions.sort_by(|x, y| x.norm().total_cmp(&y.norm()));
        Ok(motions)
    }

    /// The speeds at which equilibria branch from the flat blade, ascending, each with the shape of the
    /// branch, ‖v‖ = 1: the critical speeds of the reduced model. The side force is ignored.
    ///
    /// # Errors
    /// [`StretchedError::Spectrum`].
    pub fn pitchforks(&self) -> Result<Vec<(f64, Col<f64>)>, StretchedError> {
        let critical = critical_speeds(&self.system)?;
        let pairs = critical.into_iter().map(|c| (c.speed_rad_per_s, c.shape));
        Ok(pairs.collect())
    }

    /// The deflected equilibrium slightly above a pitchfork: p = εv with ε² = −vᵀK(Ω)v/4U₄(v), corrected by
    /// Newton's method. The other equilibrium is −p.
    ///
    /// # Errors
    /// [`StretchedError::Axisymmetric`]; [`StretchedError::NotFound`], also if vᵀK(Ω)v is not negative,
    /// because the speed is not just above the pitchfork.
    pub fn leaned(
        &self,
        speed_rad_per_s: f64,
        shape: &Col<f64>,
    ) -> Result<Equilibrium, StretchedError> {
        finite("the speed in rad/s", speed_rad_per_s)?;
        self.directed(shape)?;
        let near = self.leaned_near(speed_rad_per_s, shape)?;
        self.equilibrium(speed_rad_per_s, Some(&near))
    }

    /// The deflection εv of [`StretchedBlade::leaned`] without correction.
    ///
    /// # Errors
    /// [`StretchedError::NotFound`] if vᵀK(Ω)v is not negative.
    pub fn leaned_near(
        &self,
        speed_rad_per_s: f64,
        shape: &Col<f64>,
    ) -> Result<Col<f64>, StretchedError> {
        let stiffness = self.system.stiffness_at(speed_rad_per_s);
        let elastic = shape.transpose() * &stiffness * shape;
        let square = -elastic / (4.0 * self.stretching.energy_j(shape)?);
        if !(square > 0.0 && square.is_finite()) {
            return Err(self.not_found(shape, speed_rad_per_s));
        }
        Ok(Scale(square.sqrt()) * shape)
    }

    /// The equilibrium at known coordinates, with its number of negative eigenvalues.
    pub(super) fn at(
        &self,
        p: Col<f64>,
        speed_rad_per_s: f64,
    ) -> Result<Equilibrium, StretchedError> {
        let hessian = self.hessian(&p, speed_rad_per_s)?;
        Equilibrium::with_hessian(p, speed_rad_per_s, &hessian)
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
