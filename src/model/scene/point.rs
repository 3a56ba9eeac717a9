//! A point of the blade, fixed in space.

/// A point of the blade, fixed in space: of the probe, or of the side force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Angle, positive in the direction of rotation.
    pub angle_deg: f64,
}

/// A point of the blade in polar coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polar {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Angle, positive in the direction of rotation.
    pub angle_rad: f64,
}

impl Polar {
    /// The point at a radius in m and an angle in rad.
    pub const fn new(radius_m: f64, angle_rad: f64) -> Self {
        Polar {
            radius_m,
            angle_rad,
        }
    }
}

impl Point {
    /// The point with its angle in rad.
    pub fn polar(&self) -> Polar {
        Polar::new(self.radius_m, self.angle_deg.to_radians())
    }
}
