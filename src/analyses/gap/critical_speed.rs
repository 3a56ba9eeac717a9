//! The first critical speed of a saw with linear guides.

use crate::model::plate::{Plate, Resolution};
use crate::model::scene::Scene;
use crate::modes::Assembled;

use super::error::GapError;

/// First critical speed, in rad/s, with guides of their full stiffness.
///
/// # Errors
/// [`GapError`].
pub(super) fn first_critical_of_linear(
    scene: &Scene,
    resolution: Resolution,
) -> Result<Option<f64>, GapError> {
    let saw = Assembled::from(Plate::new(scene, resolution));
    // With a limit of zero the search ends at the first critical speed.
    let critical = saw.critical_speeds(Some(&|_| 0.0))?;
    Ok(critical.first().map(|c| c.speed_rad_per_s))
}
