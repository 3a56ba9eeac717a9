//! Time histories of the saw in a cut and in a run-up, which are an independent check of its stability.
//!
//! At a constant speed a step is the exponential of the state matrix, which is exact for loads that change
//! linearly. While the speed changes, or under forces that depend on the displacement, Newmark's average
//! acceleration is used (N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (1959), 67–94). Both work on the lowest
//! modes of the blade and its static deflections under the loads.
//!
//! [`cut`](crate::analyses::cut::cut()) follows the saw through a cut, [`runup`](crate::analyses::runup::runup()) while its
//! speed rises.

mod band_growth;
mod deflections;
mod linear_limit;
mod motion;
mod newmark;
mod propagator;
mod reduced_blade;
mod response;
mod runup;
mod sinusoids;
mod stretched_probe;
mod stretched_runup;
mod stretching;

pub(crate) use band_growth::band_exponents;
pub(crate) use deflections::Deflections;
pub(crate) use linear_limit::{Gauge, LINEAR_THICKNESSES, linear_limit_m};
pub(crate) use motion::{Force, Integrator, State};
pub(crate) use newmark::Newmark;
pub(crate) use propagator::Propagator;
pub(crate) use reduced_blade::{ReducedBlade, Snapshot, at_point, lateral_load};
pub(crate) use response::response_map;
pub(crate) use runup::run_up;
pub use sinusoids::FitError;
pub(crate) use sinusoids::{SAMPLES, Sinusoid, damped_sinusoids, fitted_growth};
pub(crate) use stretched_probe::StretchedProbe;
pub(crate) use stretched_runup::{StretchedRunUp, stretched_run_up};
pub(crate) use stretching::{forces, system as reduced_system};

use crate::model::scene::SceneError;
use crate::model::spline::SplineError;
use crate::modes::SpectrumError;
use crate::motion::stretched_blade::{LARGEST_SLOPE, StretchedError};
use crate::stability::AnalysisError;

/// Reason for which a time history could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum TransientError {
    /// The scene lacks the block `cut` or `runup`, or no sweep can reach its speeds.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The motion of the blade on its arbor could not be computed.
    #[error(transparent)]
    Spline(#[from] SplineError),
    /// The computation of a blade that stretches failed.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
    /// The deflection in the cut could not be decomposed into sinusoids.
    #[error("{0}; the scene's numbers differ too much in size")]
    Fit(#[from] FitError),
    /// The deflection overflowed.
    #[error(
        "the deflection at {rpm:.0} rpm overflows within {time_s:.3} s; shorten the time, or lower the speed"
    )]
    Overflow {
        /// Rotation speed.
        rpm: f64,
        /// Time from the beginning of the record.
        time_s: f64,
    },
    /// The force of a run-up deflects the blade beyond the linear model at once.
    #[error(
        "side_force.force_n is {force_n}, which alone bends the blade by more than {LINEAR_THICKNESSES} thicknesses, where the linear model ends; give a smaller force"
    )]
    BentByForce {
        /// Constant side force.
        force_n: f64,
    },
    /// The force of a run-up causes slopes at once for which von Kármán's strains are not valid.
    #[error(
        "side_force.force_n is {force_n}, which alone bends the blade to slopes of more than {LARGEST_SLOPE}, where the model with stretching ends; give a smaller force"
    )]
    SteepByForce {
        /// Constant side force.
        force_n: f64,
    },
    /// Newton's method did not converge in a step.
    #[error(
        "no motion within {step_s:e} s at {rpm:.0} rpm balances the forces on the blade; make the forces or the deflections smaller"
    )]
    NotBalanced {
        /// Rotation speed.
        rpm: f64,
        /// Length of the step.
        step_s: f64,
    },
    /// The exponential of the state matrix, or a product of such matrices, overflowed.
    #[error(
        "within {step_s:e} s at {rpm:.0} rpm the motion overflows; the forces or other numbers of the scene are too large"
    )]
    NotFinite {
        /// Rotation speed.
        rpm: f64,
        /// Length of the step.
        step_s: f64,
    },
}

#[cfg(test)]
mod tests;
