//! Where a motion begins to grow.

/// The least cutting stiffness at which a motion begins to grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Boundary {
    /// Zero where one grows without the delayed force.
    pub stiffness_n_per_m: f64,
    /// Its frequency in space.
    pub frequency_rad_per_s: f64,
}
