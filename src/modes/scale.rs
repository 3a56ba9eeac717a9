//! Frequency scale of a blade.

use crate::model::plate::Plate;

/// 5√(D/ρh)/b², in rad/s, near the lowest natural frequency of most blades.
pub(crate) fn frequency_scale(plate: &Plate) -> f64 {
    let blade = &plate.blade;
    let specific = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
    5.0 * specific.sqrt() / blade.outer_radius_m.powi(2)
}
