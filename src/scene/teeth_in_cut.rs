//! Positions of the teeth in the cut.

use super::SceneError;
use super::check::within;

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
    /// Arc of a contact around the middle of the cut: the given one, or else one pitch for each tooth.
    pub fn arc_rad(&self, key: &str, given_deg: Option<f64>) -> Result<f64, SceneError> {
        match given_deg {
            Some(arc) => Ok(within(key, arc, (1e-3, 360.0))?.to_radians()),
            None => Ok(f64::from(self.count) * self.pitch_rad),
        }
    }
}
