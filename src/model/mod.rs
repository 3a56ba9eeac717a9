//! The saw as its equation of motion.
//!
//! In the order of reading: [`scene`] is the input, [`plate`] the blade, its loads and its contacts, [`system`] the matrices
//! M, D(Ω) and K(Ω). [`spline`] is the motion of the blade on its arbor, [`analytical`] the closed forms with which tests and
//! pages compare. `linalg` checks every eigenvector and singular value where it is made; `tuning` marks constants that were
//! found by trial.

pub mod analytical;
pub(crate) mod linalg;
pub mod plate;
pub mod scene;
mod spacing;
pub mod spline;
pub mod system;
pub(crate) mod tuning;

#[doc(hidden)]
pub use spacing::evenly_spaced;
