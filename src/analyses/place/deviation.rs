//! Deviation of the board of a saw of a search.

use crate::analyses::board_deviation::at_cut_m;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::Scene;

/// Deflection of the rim at the cut under the constant lateral force of a scene at its operating speed, with linear guides on a plate and
/// those with a gap on a basis; `None` without an operating speed, and if it is unknown. The search has the plates of idling saws.
pub fn operating_deviation_m(scene: &Scene, own: Resolution, linear: &Plate) -> Option<f64> {
    at_cut_m(scene, own, linear, scene.file().operating_rpm?).ok()
}
