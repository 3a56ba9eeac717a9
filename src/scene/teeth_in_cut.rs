//! Positions of the teeth in the cut.

/// The teeth that cut at the same time, one pitch apart, symmetric about the middle of the cut.
#[derive(Debug, Clone, Copy)]
pub struct TeethInCut {
    /// Angle of the middle of the cut.
    pub angle_rad: f64,
    /// Number of teeth.
    pub count: u32,
    /// Angle between successive teeth.
    pub pitch_rad: f64,
}

impl TeethInCut {
    /// Angle that the teeth span, one pitch for each.
    pub fn arc_rad(&self) -> f64 {
        f64::from(self.count) * self.pitch_rad
    }
}
