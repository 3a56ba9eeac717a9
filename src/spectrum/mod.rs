//! One rotation speed: eigenvalues, modes, Krein signs, names.

mod dense;
pub mod derivative;
mod low;
mod mode;
mod model;
mod name;
mod part;
mod pencil;
mod reduction;
mod shift_invert;

pub use dense::companion_eigenpairs;
pub use low::LowModel;
pub use mode::{Mode, ModeKind};
pub use model::{DescribedMode, SpectralModel, Strategy, WorkCounters};
pub use name::{Direction, HarmonicShare, ModeName, in_words};
pub use part::{NamedCriticalSpeed, Part};
pub use pencil::{CriticalSpeed, critical_speeds};
pub use reduction::Projection;
pub use shift_invert::lowest_eigenpairs;

/// Why a spectrum could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum SpectrumError {
    /// The QR iteration did not converge.
    #[error("the eigenvalues of order {order} did not converge at {rpm} rpm")]
    NoConvergence {
        /// Order of the state matrix.
        order: usize,
        /// Rotation speed.
        rpm: f64,
    },
    /// The stiffness at rest is not positive definite, so that no speed is critical
    /// in the usual sense.
    #[error(
        "the blade is not stable at rest: its stiffness of order {order} is not positive definite"
    )]
    UnstableAtRest {
        /// Order of the stiffness matrix.
        order: usize,
    },
    /// Numbers so far apart that their products overflow.
    #[error(
        "the matrices of order {order} are not finite at {rpm} rpm; the scene's numbers are too far apart"
    )]
    NotFinite {
        /// Order of the matrix.
        order: usize,
        /// Rotation speed.
        rpm: f64,
    },
}
