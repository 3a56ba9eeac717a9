//! Deviation of the board: the deflection at the cut under the side force.

use crate::analyses::check::rim_at_cut;
use crate::analyses::deflect::PointLoad;
use crate::model::plate::Plate;
use crate::model::scene::Scene;
use crate::motion::transient::at_point;

/// Deflection of the rim at the cut under the side force of a scene at its operating speed, as an absolute value, with linear guides;
/// `None` without an operating speed, and if rigid motions are free.
pub fn linear_deviation_m(scene: &Scene, plate: &Plate) -> Option<f64> {
    let speed = scene.operating_rad_per_s()?;
    let force = scene.side_force();
    let deflected = PointLoad::new(plate, force.at.polar())?.deflected(speed)?;
    let per_newton = at_point(plate, rim_at_cut(scene)).transpose() * deflected;
    Some((force.force_n * per_newton).abs())
}
