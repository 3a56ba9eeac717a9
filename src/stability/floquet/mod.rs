//! Growth of slotted saws beside guides, by Floquet multipliers.
//!
//! Slots turn and guides do not, so that the equation of motion is periodic in NΩ with the number N of slots: it has no eigenvalues, but
//! multipliers μ of the state over one pitch, T = 2π/NΩ, and a motion grows by ln|μ|/T. [`GuidedBlade`] is the blade of finite elements,
//! with its slots and its own stress of rotation, beside springs and dampers fixed in space; [`GuidedBlade::growth`] has the largest growth
//! with an estimated error, [`NearbyGrowth`] that at an operating speed and 1 % beside it.
//!
//! References: V. A. Yakubovich & V. M. Starzhinskii, *Linear Differential Equations with Periodic Coefficients*, Wiley, 1975.

mod error;
mod growth;
mod guided;
mod nearby;
mod pitch;

pub use error::NotComputed;
pub use growth::FloquetGrowth;
pub use guided::GuidedBlade;
pub use nearby::NearbyGrowth;
