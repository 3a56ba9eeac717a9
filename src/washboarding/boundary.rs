//! Onset of growth over the cutting stiffness.

/// The smallest cutting stiffness at which a motion grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Boundary {
    /// Cutting stiffness; zero if a motion grows without the delayed force.
    pub stiffness_n_per_m: f64,
    /// Frequency of the motion in space.
    pub frequency_rad_per_s: f64,
}
