//! A blade that stretches: its equilibria, small motions about them, and the amplitude of flutter.
//!
//! The blade without damping has the potential V(q) = ½ qᵀK(Ω)q + U₄(q) − fᵀq with U₄ of
//! [`Stretching`](crate::model::plate::Stretching). Above the first critical speed K is indefinite: the flat blade is
//! not a minimum of V, but a blade deflected to one side is. Each edge of a band of divergence is a pitchfork,
//! at which two such equilibria branch from the flat one; a side force f unfolds it.
//!
//! The input is a [`Plate`], which guides or a collar restrain laterally, and a number of shapes, its lowest
//! modes at rest. The results are equilibria over speed, in metres by [`StretchedBlade::deflection_m`], the number
//! of negative eigenvalues of ∂²V/∂q², and the eigenvalues λ of small motions, λ² + λ 2ΩG + K(Ω) + ∂²U₄/∂q² = 0,
//! in 1/s. If the number is zero the equilibrium is stable, and remains so with any damping fixed in space.
//! Otherwise gyroscopic forces may stabilize the undamped blade, but such damping destabilizes it (Thomson,
//! Tait & Chetaev; see W. T. Thomson & P. G. Tait, *Treatise on Natural Philosophy*, 1879, §345).
//!
//! A pad that lifts off (`GapPotential`) contributes only its film to K(Ω); its potential is added to V.
//! Within the gaps of such pads a blade with a free bore has no stiffness against heave and tilt: only a side
//! force determines its position.
//!
//! Curves of equilibria are followed by pseudo-arclength continuation (H. B. Keller, in *Applications of
//! Bifurcation Theory*, 1977, 359–384).

mod basis;
mod branch;
mod equilibrium;
mod flutter_rise;
mod potential_minimum;
mod pressed_blade;
mod rise;
mod saturation;
mod sites;
mod slopes;
mod sweep;

pub(crate) use basis::ForcedPlate;
pub use branch::{Branch, BranchEnd, Extent, Turn, TurnKind};
pub use equilibrium::Equilibrium;
pub use flutter_rise::FlutterRise;
pub(crate) use pressed_blade::{Deviation, PressedBlade};
pub use rise::{Rise, saturations};
pub use saturation::Saturation;
pub use sites::Sites;
pub use slopes::Slopes;
pub use sweep::Sweep;

use faer::{Col, Mat, MatRef, Scale};

use crate::model::linalg::symmetric_eigenvalues;
use crate::model::plate::{GapPotential, Plate, ReducedStretching, StretchingError};
use crate::model::scene::Polar;
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectrumError;

/// Reason for which a computation of a blade that stretches failed.
#[derive(Debug, thiserror::Error)]
pub enum StretchedError {
    /// Nothing resists heave or tilt.
    #[error(
        "nothing holds the blade laterally, so its equilibria are not unique; add a guide, or clamp the bore"
    )]
    NotHeld,
    /// Nothing resists heave or tilt within the gaps of guides.
    #[error(
        "within the gaps of its guides nothing holds the blade laterally, so that its position is undetermined; give a side force, or one of the guides a film_stiffness_n_per_m"
    )]
    Loose,
    /// No guide resists the side force.
    #[error(
        "at {rpm:.1} rpm the side force presses the blade away from all its guides, which are on one side only (guides[].side); give pads on both sides, or reverse the force"
    )]
    Escapes {
        /// Rotation speed.
        rpm: f64,
    },
    /// The blade is axisymmetric, so that deflected equilibria are not isolated.
    #[error(
        "the blade is axisymmetric, so the direction of its deflection is undetermined; add a guide, or a side force"
    )]
    Axisymmetric,
    /// The number of shapes is zero or exceeds that of the functions.
    #[error("{given} shapes were requested; give 1 to {most}; 20 to 40 are usual")]
    Shapes {
        /// Number of requested shapes.
        given: usize,
        /// Number of basis functions.
        most: usize,
    },
    /// Newton's method did not converge.
    #[error(
        "no equilibrium was found at {rpm:.1} rpm: the residual forces are {residual:.1e} of the elastic ones; start closer to an equilibrium, or with a smaller force"
    )]
    NotFound {
        /// Rotation speed.
        rpm: f64,
        /// Largest residual force relative to the largest elastic force.
        residual: f64,
    },
    /// A speed, a force or a range is not finite, or a range is empty.
    #[error("{what} is {value}; give a finite number{allowed}")]
    Value {
        /// Name of the value.
        what: &'static str,
        /// The given value.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The potential of stretching could not be computed.
    #[error(transparent)]
    Stretching(#[from] StretchingError),
}

/// A blade that stretches, in a basis of a few shapes, under a constant side force.
#[derive(Debug, Clone)]
pub struct StretchedBlade {
    plate: Plate,
    /// Shapes, the orthonormal columns of an N × r matrix.
    shapes: Mat<f64>,
    system: GyroscopicSystem,
    stretching: ReducedStretching,
    /// Potential of the pads that lift off, if there are any.
    gaps: Option<GapPotential>,
    /// Side force on the shapes, in N/√kg.
    force: Col<f64>,
}

impl StretchedBlade {
    /// Relative change ‖Δq‖/‖q‖ of an equilibrium in a larger basis that contains this one.
    ///
    /// # Errors
    /// [`StretchedError`] as for [`StretchedBlade::equilibrium`].
    pub fn change_with(
        &self,
        finer: &StretchedBlade,
        equilibrium: &Equilibrium,
    ) -> Result<f64, StretchedError> {
        let guess = finer.shapes.transpose() * (&self.shapes * &equilibrium.coordinates);
        let found = finer.equilibrium(equilibrium.speed_rad_per_s, Some(&guess))?;
        Ok((&found.coordinates - &guess).norm_l2() / found.coordinates.norm_l2())
    }

    /// Replaces the side force by a lateral force at a point (radius in m, angle in rad), fixed in space.
    ///
    /// # Errors
    /// [`StretchedError::Value`] if a number is not finite.
    pub fn pressed(self, force_n: f64, place: Polar) -> Result<Self, StretchedError> {
        finite("the radius in m", place.radius_m)?;
        finite("the angle", place.angle_rad)?;
        self.loaded(force_n, &[(place, 1.0)])
    }

    /// Replaces the side force by a lateral force on several points, each with its share of the whole, fixed in space.
    ///
    /// # Errors
    /// [`StretchedError::Value`] if the force is not finite.
    pub(crate) fn loaded(
        mut self,
        force_n: f64,
        places: &[(Polar, f64)],
    ) -> Result<Self, StretchedError> {
        finite("the force in N", force_n)?;
        self.force.fill(0.0);
        for (place, share) in places {
            self.force += Scale(force_n * share) * self.shapes_at(*place);
        }
        Ok(self)
    }

    /// The blade with the gaps of its pads multiplied by a factor, in the same basis.
    pub fn with_gaps(mut self, factor: f64) -> Self {
        self.gaps = self.gaps.map(|gaps| gaps.scaled(factor));
        self
    }

    /// The blade with the forces that its pads have on average over an oscillation, with one amplitude at all of them, in the same
    /// basis.
    pub(crate) fn over_oscillation(mut self, amplitude_m: f64) -> Self {
        self.gaps = self.gaps.map(|gaps| gaps.over_oscillation(amplitude_m));
        self
    }

    /// The potential of stretching in the basis.
    pub(crate) fn stretching(&self) -> &ReducedStretching {
        &self.stretching
    }

    /// Whether a pad lifts off.
    pub(crate) fn lifts_off(&self) -> bool {
        self.gaps.is_some()
    }

    /// The potential of pads that lift off.
    pub(crate) fn gaps(&self) -> Option<&GapPotential> {
        self.gaps.as_ref()
    }

    /// The side force in the basis, in N/√kg.
    pub(crate) fn force(&self) -> &Col<f64> {
        &self.force
    }

    /// The blade without side force.
    pub fn unforced(mut self) -> Self {
        self.force.fill(0.0);
        self
    }

    /// Coordinates of zero deflection.
    pub fn flat(&self) -> Col<f64> {
        Col::zeros(self.force.nrows())
    }

    /// Values of the shapes at a point of the blade (radius in m, angle in rad), in 1/√kg.
    pub(crate) fn shapes_at(&self, place: Polar) -> Col<f64> {
        let values = self.plate.functions_at(place.radius_m, place.angle_rad);
        self.shapes.transpose() * Col::from_fn(values.len(), |i| values[i])
    }

    /// Norm of the coordinates of a deflection of one thickness over the whole blade, in √kg·m.
    fn size(&self) -> f64 {
        self.plate.blade.thickness_m * self.plate.blade.mass_kg().sqrt()
    }

    /// The shapes, N × r.
    pub fn shapes(&self) -> MatRef<'_, f64> {
        self.shapes.as_ref()
    }

    /// Checks that a deflected equilibrium is isolated: without anything fixed in space it could be rotated
    /// about the axis.
    fn directed(&self, coordinates: &Col<f64>) -> Result<(), StretchedError> {
        let turns = self.plate.is_axisymmetric() && self.force.norm_max() == 0.0;
        if turns && coordinates.norm_max() > 0.0 {
            Err(StretchedError::Axisymmetric)
        } else {
            Ok(())
        }
    }

    /// Checks that equilibria are isolated: within the gaps of its pads a blade that nothing else restrains is in
    /// equilibrium everywhere, unless a force acts on it.
    fn not_loose(&self) -> Result<(), StretchedError> {
        if self.gaps.is_none() || self.force.norm_max() > 0.0 {
            return Ok(());
        }
        let flat = self.stiffnesses(&self.flat(), 0.0)?;
        let largest = flat.last().copied().unwrap_or_default();
        if flat.first().is_some_and(|first| *first <= LOOSE * largest) {
            Err(StretchedError::Loose)
        } else {
            Ok(())
        }
    }

    /// Gradient ∂V/∂p, in N/√kg.
    fn residual(&self, p: &Col<f64>, speed_rad_per_s: f64) -> Result<Col<f64>, StretchedError> {
        Ok(self.residual_with(p, &self.stretching.tension(p)?, speed_rad_per_s))
    }

    /// As [`StretchedBlade::residual`], with the tension of p.
    fn residual_with(&self, p: &Col<f64>, tension: &Col<f64>, speed_rad_per_s: f64) -> Col<f64> {
        let elastic = self.system.stiffness_at(speed_rad_per_s) * p;
        let mut rest = elastic + self.stretching.gradient_with(p, tension) - &self.force;
        if let Some(gaps) = &self.gaps {
            rest += gaps.gradient(p);
        }
        rest
    }

    /// Second derivatives ∂²V/∂p², in 1/s².
    fn hessian(&self, p: &Col<f64>, speed_rad_per_s: f64) -> Result<Mat<f64>, StretchedError> {
        Ok(self.hessian_with(p, &self.stretching.tension(p)?, speed_rad_per_s))
    }

    /// As [`StretchedBlade::hessian`], with the tension of p.
    fn hessian_with(&self, p: &Col<f64>, tension: &Col<f64>, speed_rad_per_s: f64) -> Mat<f64> {
        self.system.stiffness_at(speed_rad_per_s) + self.added_with(p, tension)
    }

    /// Stiffness of stretching and of pads that lift off, in 1/s².
    fn added_stiffness(&self, p: &Col<f64>) -> Result<Mat<f64>, StretchedError> {
        Ok(self.added_with(p, &self.stretching.tension(p)?))
    }

    fn added_with(&self, p: &Col<f64>, tension: &Col<f64>) -> Mat<f64> {
        let stretching = self.stretching.hessian_with(tension);
        match &self.gaps {
            Some(gaps) => stretching + gaps.hessian(p),
            None => stretching,
        }
    }

    /// Derivative ∂²V/∂p∂Ω of the gradient by the speed.
    fn softening(&self, p: &Col<f64>, speed_rad_per_s: f64) -> Col<f64> {
        Scale(2.0 * speed_rad_per_s) * (&self.system.spin * p)
    }

    /// Eigenvalues of ∂²V/∂p², ascending.
    fn stiffnesses(&self, p: &Col<f64>, speed: f64) -> Result<Vec<f64>, StretchedError> {
        let values = symmetric_eigenvalues(self.hessian(p, speed)?.as_ref());
        Ok(values.map_err(SpectrumError::at(speed))?)
    }
}

/// A negative eigenvalue of ∂²V/∂p² with a magnitude up to this share of the largest is zero: rounding gives such values
/// to motions that nothing restrains.
const ROUNDING: f64 = 1e-12;
/// If the smallest stiffness at rest is not larger than this share of the largest, nothing restrains the blade.
const LOOSE: f64 = 1e-11;

/// Von Kármán's strains are valid for slopes up to about this value.
pub const LARGEST_SLOPE: f64 = 0.1;

/// Returns a value, or an error if it is not finite.
fn finite(what: &'static str, value: f64) -> Result<f64, StretchedError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(StretchedError::Value {
            what,
            value,
            allowed: "",
        })
    }
}

#[cfg(test)]
pub(crate) mod basis_tests;
#[cfg(test)]
mod diagram_tests;
#[cfg(test)]
mod flutter_tests;
#[cfg(test)]
mod gap_tests;
#[cfg(test)]
mod tests;
