//! One rotation speed: eigenvalues, modes, Krein signs, names.

pub(crate) mod derivative;

mod arnoldi;
mod at_rest;
mod buckling;
mod companion;
mod component;
mod critical;
mod deflation;
mod error;
mod free_wave;
mod generalized;
mod growth;
mod guided_reduction;
mod hamiltonian;
mod larger_basis;
mod lowest;
mod matrix_slope;
mod mode;
mod mode_name;
mod mode_pair;
mod model;
mod projection;
mod reflected;
mod residual;
mod vectors;
mod work;

#[doc(hidden)]
pub use arnoldi::lowest_eigenpairs;
pub(crate) use at_rest::modes_at_rest;
pub(crate) use buckling::{AddedStress, SingularStress, first_singular};
#[doc(hidden)]
pub use companion::companion_eigenpairs;
pub(crate) use companion::time_scale;
#[doc(hidden)]
pub use component::Component;
pub(crate) use component::frequency_scale;
pub use critical::NamedCriticalSpeed;
pub(crate) use critical::standing_name;
#[doc(hidden)]
pub use critical::{CriticalSpeed, critical_speeds};
pub use error::SpectrumError;
pub(crate) use growth::fastest_growing;
#[doc(hidden)]
pub use growth::fastest_growing_of;
pub(crate) use hamiltonian::{HamiltonianReduction, State};
pub(crate) use larger_basis::LargerBasis;
#[doc(hidden)]
pub use lowest::LowestModes;
pub(crate) use matrix_slope::{Differences, matrix_slopes};
pub use mode::{Mode, ModeKind};
pub use mode_name::{Direction, ModeName};
pub(crate) use mode_name::{HarmonicShare, in_words};
pub(crate) use mode_pair::ModePair;
pub use model::{DescribedMode, SpectralModel, Strategy};
pub(crate) use reflected::{ReflectedModel, ReflectedModes};
#[doc(hidden)]
pub use vectors::{orthonormal, split};
pub use work::{Cancellation, WorkCounters};
