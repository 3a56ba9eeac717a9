//! Eigenvalues, modes, Krein signs and names at one rotation speed.
//!
//! A [`Plate`](crate::model::plate::Plate) gives a [`SpectralModel`], which computes the modes of
//!
//! L(λ) q = (λ² + λ D(Ω) + K(Ω)) q = 0
//!
//! at any speed Ω of its range: λ in 1/s, q in the plate's basis with ‖q‖ = 1, the [`ModeKind`] with its
//! Krein sign, the [`ModeName`] and the backward error on the full model. For an undamped blade D is skew and
//! K symmetric, so λ occur in quadruples ±σ ± iω, and L(iω) is Hermitian.
//!
//! References: F. Tisseur & K. Meerbergen, *The quadratic eigenvalue problem*, SIAM Review 43 (2001),
//! 235–286, for the eigenproblem; R. S. MacKay, *Stability of equilibria of Hamiltonian systems*
//! (1986), for Krein signs.

pub(crate) mod derivative;

mod argument;
mod arnoldi;
mod assembled_plate;
mod basis_error;
pub mod branches;
mod buckling;
mod chart_height;
mod companion;
mod component;
mod connected_parts;
mod critical_speed;
mod deflation;
mod double_eigenvalue;
mod error;
mod event_name;
mod family;
mod free_wave;
mod full_model;
mod growth;
mod half_order;
mod heights;
mod hermitian_inertia;
mod kept_waves;
mod lowest_modes;
mod matrix_slope;
mod mode;
mod mode_name;
mod model;
mod nearest_pairs;
mod pencil;
mod progress;
mod refined_pair;
mod residual;
mod resting_mode;
mod scale;
pub(crate) mod single_eigenvalue;
mod standing_waves;
mod structured_stiffness;
mod symmetric_pencil;
mod vectors;
mod wave;
pub(crate) mod waves;
mod work;

pub(crate) use argument::turn_along;
pub(crate) use arnoldi::lowest_eigenpairs;
#[doc(hidden)]
pub use assembled_plate::{Assembled, SpeedLimit};
pub(crate) use basis_error::BasisError;
pub(crate) use buckling::{AddedStress, SingularStress, first_singular};
pub(crate) use chart_height::ABOVE_LAST;
pub use chart_height::Strategy;
#[doc(hidden)]
pub use companion::companion_eigenpairs;
pub(crate) use companion::time_scale;
#[doc(hidden)]
pub use component::Component;
pub use critical_speed::NamedCriticalSpeed;
#[doc(hidden)]
pub use critical_speed::{CriticalSpeed, critical_speeds};
pub(crate) use critical_speed::{clear_range, named, searched_range};
pub(crate) use double_eigenvalue::DoubleEigenvalue;
pub use error::SpectrumError;
pub use event_name::{EventName, EventWaves};
pub(crate) use full_model::{AtSpeed, FullModel};
#[doc(hidden)]
pub use growth::fastest_growing;
pub(crate) use growth::{Growing, eigenvalues, grows};
pub(crate) use hermitian_inertia::negative_eigenvalues;
pub(crate) use kept_waves::kept_waves;
#[doc(hidden)]
pub use lowest_modes::LowestModes;
pub(crate) use matrix_slope::{Differences, matrix_slopes};
pub use mode::{Mode, ModeKind};
pub(crate) use mode::{classify, krein_index};
pub use mode_name::{Direction, ModeName};
pub(crate) use mode_name::{HarmonicShare, in_words};
pub(crate) use model::SPLITTING;
pub use model::{DescribedMode, NamedMode, SpectralModel};
pub(crate) use nearest_pairs::nearest_pairs;
pub(crate) use progress::Work;
pub use progress::{Progress, Stage};
pub(crate) use refined_pair::RefinedPair;
pub(crate) use resting_mode::RestingMode;
pub(crate) use scale::frequency_scale;
pub use standing_waves::StandingWaves;
pub(crate) use standing_waves::{diameters_within, highest_reflected, waves_within};
pub(crate) use symmetric_pencil::stiffened;
pub(crate) use vectors::{complex, orthonormal, smallest, split};
pub use work::Cancellation;
#[doc(hidden)]
pub use work::WorkCounters;
