//! A rolled groove and the eigenstrain of its band.
//!
//! Plastic flow conserves volume: a groove of depth d on each face of a blade of thickness h has the strain
//! ε_z = −2d/h through the thickness, and ε_r + ε_θ = 2d/h in the plane. Between a narrow band of radius R and the rim the
//! stress depends on this sum, and on the difference ε_θ − ε_r only by the share (a/R)² of a bore of radius a. The difference
//! changes the stress within the band and between band and bore. It depends on the rolls and is not known for a blade, so
//! that both parts are taken to be equal.

use super::Blade;

/// Share of the displaced volume in each of the two directions in the plane. Rolls that are wide in comparison with the
/// length of their contact lengthen the metal along the groove (0 across), and the blade, which resists this lengthening on
/// both sides, directs the flow across (0 along); equal parts are between the two.
const SHARE: f64 = 0.5;

/// The blade at a groove.
pub(crate) struct Groove {
    thickness_m: f64,
}

impl Groove {
    /// The groove at a radius.
    pub fn at(blade: &Blade, radius_m: f64) -> Self {
        Groove {
            thickness_m: blade.thickness_m * blade.thickness_ratio(radius_m),
        }
    }

    /// In-plane eigenstrain of a groove with this depth on each face.
    pub fn eigenstrain(&self, depth_m: f64) -> f64 {
        SHARE * 2.0 * depth_m / self.thickness_m
    }

    /// Depth on each face of the groove with this eigenstrain; negative for a band that is thicker than the blade.
    pub fn depth_m(&self, eigenstrain: f64) -> f64 {
        eigenstrain * self.thickness_m / (2.0 * SHARE)
    }
}
