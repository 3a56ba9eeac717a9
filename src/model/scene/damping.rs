//! Damping of the blade.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::rule::{is_default, refuse};

/// Damping of the blade: the contributions of the material, which turns with the blade, and of the air add up.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DampingFile {
    /// Kelvin–Voigt retardation time η of the material, which turns with the blade.
    #[serde(default, skip_serializing_if = "is_default")]
    pub material_retardation_time_s: f64,
    /// Loss factor of the blade, twice the damping ratio of every mode of the blade at rest without guides. It acts in the
    /// frame of the blade, as viscous damping with this ratio at the frequency of each of these modes.
    #[serde(default, skip_serializing_if = "is_default")]
    pub loss_factor: f64,
    /// Measured damping ratios of modes of the blade at rest without guides, by their number of nodal diameters, in place of half
    /// the loss factor.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mode_ratios: Vec<ModeRatioRow>,
    /// Viscous resistance per area of the surrounding air.
    #[serde(default, skip_serializing_if = "is_default")]
    pub air_n_s_per_m3: f64,
    /// Ratio of the rotation speed of the air to that of the blade: 0, by default, for air at rest in space; 1 for
    /// air that turns with the blade.
    #[serde(default, skip_serializing_if = "is_default")]
    pub air_rotation_share: f64,
}

/// Damping ratio of the modes with a number of nodal diameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeRatioRow {
    /// Number of nodal diameters.
    pub diameters: u32,
    /// Damping ratio, the share of critical damping: the logarithmic decrement over 2π.
    pub damping_ratio: f64,
}

impl DampingFile {
    /// Checks that no number of nodal diameters is named twice.
    pub(super) fn checked(&self) -> Result<(), SceneError> {
        let mut named = Vec::new();
        for (k, row) in self.mode_ratios.iter().enumerate() {
            if named.contains(&row.diameters) {
                let key = format!("damping.mode_ratios[{k}].diameters");
                let remedy = "give one ratio for each number of nodal diameters";
                return Err(refuse(&key, f64::from(row.diameters), "named once", remedy));
            }
            named.push(row.diameters);
        }
        Ok(())
    }

    /// Damping ratio of the modes at rest with n nodal diameters, as listed or by the loss factor.
    pub(crate) fn ratio_of(&self, n: usize) -> f64 {
        let mut rows = self.mode_ratios.iter();
        let listed = rows.find(|row| row.diameters as usize == n);
        listed.map_or(0.5 * self.loss_factor, |row| row.damping_ratio)
    }

    /// The smallest damping ratio of any number of nodal diameters.
    pub(crate) fn smallest_ratio(&self) -> f64 {
        let listed = self.mode_ratios.iter().map(|row| row.damping_ratio);
        listed.fold(0.5 * self.loss_factor, f64::min)
    }

    /// Whether the material of the blade dissipates energy.
    pub(crate) fn is_material(&self) -> bool {
        let ratios = self.mode_ratios.iter().any(|row| row.damping_ratio > 0.0);
        self.material_retardation_time_s > 0.0 || self.loss_factor > 0.0 || ratios
    }

    /// Whether anything dissipates energy.
    pub(super) fn acts(&self) -> bool {
        self.is_material() || self.air_n_s_per_m3 > 0.0
    }
}
