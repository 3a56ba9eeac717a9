//! Reasons for which an analysis of washboarding fails.

use crate::model::scene::SceneError;
use crate::modes::SpectrumError;
use crate::stability::AnalysisError;

/// Reason for which an analysis of washboarding failed.
#[derive(Debug, thiserror::Error)]
pub enum WashboardError {
    /// The scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The mode has no damping that could balance the delayed force.
    #[error(
        "damping is missing or too small for the mode of {frequency_hz:.1} Hz at {rpm:.0} rpm, but every mode must lose energy: a delayed force, however small, makes an undamped mode grow or leaves it at the limit; give damping.material_retardation_time_s (1e-6 s is of the order of steel) or damping.air_n_s_per_m3"
    )]
    Undamped {
        /// Rotation speed.
        rpm: f64,
        /// Frequency of the mode.
        frequency_hz: f64,
    },
    /// The saw has so many modes that those driven by the teeth cannot all be computed.
    #[error(
        "blade.teeth at {rpm:.0} rpm drive modes between {:.0} and {:.0} Hz, but the blade has so many that only those up to {complete_hz:.0} Hz can be included; give a thicker blade, a lower speed or fewer teeth",
        0.5 * passing_hz, passing_hz
    )]
    Incomplete {
        /// Rotation speed.
        rpm: f64,
        /// Tooth passing frequency.
        passing_hz: f64,
        /// Frequency up to which modes are complete.
        complete_hz: f64,
    },
    /// A rigid motion has no stiffness.
    #[error(
        "the guides must hold the blade against every rigid motion (there are none, or they are too soft); give a guide with a stiffness, cut.wood, or mount the blade on a collar"
    )]
    Loose,
}
