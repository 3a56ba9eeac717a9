//! Stiffness of a wave of the blade against that of a plain one.

use super::stress::CentrifugalStress;
use crate::model::scene::Blade;

/// Ratios of the stiffness of waves with a number of nodal diameters to that of a plain blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WaveRatio {
    /// Of bending, c_n: computed for slots, or given.
    pub bending: f64,
    /// Of K_σ, as given; for computed slots K_σ has their mean stress.
    pub rotation: f64,
}

impl WaveRatio {
    /// The ratios of a blade for n nodal diameters.
    pub fn of(blade: &Blade, stress: &CentrifugalStress, diameters: usize) -> Self {
        let given = blade.wave_factors.as_ref().map(|all| all.of(diameters));
        let slotted = stress.slotted();
        WaveRatio {
            bending: given.map_or(1.0, |row| row.bending)
                * slotted.map_or(1.0, |slots| slots.bending_on(diameters, blade.split_branch)),
            rotation: given.map_or(1.0, |row| row.rotation),
        }
    }
}
