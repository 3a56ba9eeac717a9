//! The arm that holds a guide pad.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::is_default;

/// The arm that holds a guide pad: the springs and dampers of the pad stand on a rigid head that moves across the plane of the
/// blade, and the arm holds the head. Without an arm they stand on the frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideArmFile {
    /// Lateral stiffness of the arm at its head. A cantilever of length l and second moment of area I has 3EI/l³.
    pub stiffness_n_per_m: f64,
    /// Mass that moves with the head: that of the head, and a share of that of the arm, 33/140 of a cantilever. Zero by
    /// default: pad and arm are then springs in series.
    #[serde(default, skip_serializing_if = "is_default")]
    pub mass_kg: f64,
    /// Lateral viscous damping between head and frame.
    #[serde(default, skip_serializing_if = "is_default")]
    pub damping_n_s_per_m: f64,
    /// Loss factor of the arm in place of its damping: viscous damping that has this loss factor at the frequency of the head on
    /// its arm without the blade.
    #[serde(default, skip_serializing_if = "is_default")]
    pub loss_factor: f64,
}

impl GuideArmFile {
    /// Damping between head and frame, in N·s/m: the given one, or η √(km).
    pub(crate) fn viscous_n_s_per_m(&self) -> f64 {
        self.damping_n_s_per_m + self.loss_factor * (self.stiffness_n_per_m * self.mass_kg).sqrt()
    }
}
