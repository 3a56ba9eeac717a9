//! A point of the blade, fixed in space.

/// A point of the blade, fixed in space: of the probe, or of the side force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Angle, positive in the direction of rotation.
    pub angle_deg: f64,
}

impl Point {
    /// Distance from the axis in m, and angle in rad.
    pub fn polar(&self) -> (f64, f64) {
        (self.radius_m, self.angle_deg.to_radians())
    }
}
