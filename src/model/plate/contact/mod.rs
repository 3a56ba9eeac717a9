//! Contacts of the blade that are fixed in space, and their terms in the equation of motion.
//!
//! Every kind of contact is a type that implements [`Contact`], in its own file.

mod gap;
mod guide;
mod lifting;
mod patch;
mod points;
mod terms;
mod wood;

pub use gap::GapPotential;
pub(crate) use guide::pad_force;
pub use lifting::LiftingPads;
pub(crate) use points::{PadPoint, pad_points};
pub use terms::ContactTerms;

use super::matrices::Plate;

/// A contact fixed in space that acts on the blade linearly in deflection and velocity.
pub trait Contact {
    /// Adds the terms of this contact in the basis of the plate.
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms);
}
