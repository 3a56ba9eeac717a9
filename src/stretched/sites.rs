//! Places over the blade at which deflections are looked at.

use faer::Col;

use super::{StretchedBlade, angles};

/// (r, θ) of places over the blade, and the shapes there.
#[derive(Debug, Clone)]
pub struct Sites(Vec<((f64, f64), Col<f64>)>);

/// Of the radii that a plate is sampled at one in so many.
const EVERY: usize = 4;

impl StretchedBlade {
    /// Places over the whole blade.
    pub fn sites(&self) -> Sites {
        let radii = self.plate.sampled_radii_m().step_by(EVERY);
        let places = radii.flat_map(|radius_m| angles().map(move |angle| (radius_m, angle)));
        Sites(places.map(|place| (place, self.shapes_at(place))).collect())
    }
}

impl Sites {
    /// Places and shapes.
    pub(super) fn iter(&self) -> impl Iterator<Item = &((f64, f64), Col<f64>)> {
        self.0.iter()
    }

    /// Largest deflection at any of them, without its sign.
    pub fn largest_m(&self, coordinates: &Col<f64>) -> f64 {
        let at = self
            .iter()
            .map(|(_, shapes)| shapes.transpose() * coordinates);
        at.map(f64::abs).fold(0.0, f64::max)
    }
}
