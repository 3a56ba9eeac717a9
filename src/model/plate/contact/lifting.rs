//! Pads that lift off, and the terms of their plate while they do.

use super::terms::ContactTerms;
use crate::model::scene::{GuideFile, Lifting};

/// Pads that lift off, and the linear terms of their plate while no pad is in contact.
#[derive(Debug, Clone)]
pub struct LiftingPads {
    pub(super) pads: Vec<(GuideFile, Lifting)>,
    /// Terms of all contacts of the plate, in which each of these pads has only the stiffness of its film.
    pub released: ContactTerms,
}

impl LiftingPads {
    /// The pads with only those terms that have a potential.
    pub fn conservative(&self) -> Self {
        LiftingPads {
            pads: self.pads.clone(),
            released: self.released.conservative(),
        }
    }
}
