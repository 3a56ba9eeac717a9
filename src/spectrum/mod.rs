//! One rotation speed: eigenvalues, modes, Krein signs, names.

mod at_rest;
mod buckling;
mod deflation;
mod dense;
pub mod derivative;
mod free_wave;
mod growth;
mod larger_basis;
mod low;
mod lowest;
mod mode;
mod model;
mod name;
mod pair;
mod part;
mod pencil;
mod projection;
mod reduction;
mod shift_invert;
mod state;
mod stop;

pub(crate) use at_rest::modes_at_rest;
pub use buckling::{AddedStress, SingularStress, first_singular};
pub use dense::{companion_eigenpairs, time_scale};
pub use growth::{fastest_growing, fastest_growing_of};
pub use larger_basis::LargerBasis;
pub use low::{LowModel, LowModes};
pub use lowest::LowestModes;
pub use mode::{Mode, ModeKind, split};
pub use model::{DescribedMode, SpectralModel, Strategy, WorkCounters};
pub use name::{Direction, HarmonicShare, ModeName, in_words};
pub use pair::ModePair;
pub use part::{NamedCriticalSpeed, Part};
pub(crate) use part::{frequency_scale, standing_name};
pub use pencil::{CriticalSpeed, critical_speeds, singular_multiples};
pub use projection::{Projection, orthonormal};
pub use shift_invert::lowest_eigenpairs;
pub use state::{State, StateModel};
pub use stop::Stop;

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
    /// Heat, roll tension or residual stress press the blade out of its plane.
    #[error(
        "the blade buckles at rest, in {diameters} nodal diameters: it stays flat up to {share:.3} of the stress of `membrane` and no more; lower the temperature or the residual stress there, roll it otherwise (a hot rim and roll tension work against each other), or hold the blade by stiffer guides"
    )]
    Buckled {
        /// Nodal diameters of the shape that it takes.
        diameters: usize,
        /// Share of the scene's membrane stress under which it would buckle.
        share: f64,
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
    /// The modes of all speeds of a chart would not fit into the memory allowed.
    #[error(
        "the chart would take {needed_mb} MB of memory for {modes} modes at each of {speeds} speeds, but must not take more than {allowed_mb} MB; end the sweep earlier or ask for a coarser accuracy"
    )]
    TooLarge {
        /// Memory needed.
        needed_mb: usize,
        /// Memory allowed.
        allowed_mb: usize,
        /// Modes at the last speed.
        modes: usize,
        /// Speeds.
        speeds: usize,
    },
    /// The blade would be torn long before the end of the sweep.
    #[error(
        "sweep.to_rpm is {to_rpm}, but must be at most {limit_rpm:.0}: the rim would be stretched by more than a tenth there, which no elastic blade bears; end the sweep earlier, or check diameter, modulus and density"
    )]
    Overstretched {
        /// End of the sweep.
        to_rpm: f64,
        /// Fastest speed allowed.
        limit_rpm: f64,
    },
    /// Waves that the basis does not hold become critical within the sweep.
    #[error(
        "sweep.to_rpm is {to_rpm}, but must be below {limit_rpm:.1}: waves of {diameters} diameters, the most that this accuracy holds, are critical there; end the sweep earlier or ask for a finer accuracy"
    )]
    Unresolved {
        /// End of the sweep.
        to_rpm: f64,
        /// Lowest critical speed of the most diameters.
        limit_rpm: f64,
        /// Largest number of nodal diameters in the basis.
        diameters: usize,
    },
    /// Whoever asked for the spectrum does not want it any more, see [`Stop`].
    #[error("the computation was stopped")]
    Stopped,
}
