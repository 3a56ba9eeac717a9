//! Where the teeth in the cut are.

/// The teeth in the cut at a time, one pitch apart around its middle.
#[derive(Debug, Clone, Copy)]
pub struct TeethInCut {
    /// Angle of the middle of the cut.
    pub angle_rad: f64,
    /// How many.
    pub count: u32,
    /// Angle from tooth to tooth.
    pub pitch_rad: f64,
}

impl TeethInCut {
    /// Arc of the rim that they take.
    pub fn arc_rad(&self) -> f64 {
        f64::from(self.count) * self.pitch_rad
    }
}
