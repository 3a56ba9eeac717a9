//! Points of the blade at which deflections are evaluated.

use std::f64::consts::TAU;

use faer::Col;

use super::StretchedBlade;
use super::slopes::ANGLES;
use crate::model::scene::Polar;

/// Points (r, θ) of the blade, each with the values of the shapes at it.
#[derive(Debug, Clone)]
pub struct Sites(Vec<(Polar, Col<f64>)>);

/// Ratio of the number of sampled radii of a plate to that used here.
const EVERY: usize = 4;

impl StretchedBlade {
    /// Points distributed over the blade.
    pub fn sites(&self) -> Sites {
        let radii = self.plate.sampled_radii_m().step_by(EVERY);
        let angles = |radius_m| {
            (0..ANGLES).map(move |k| Polar::new(radius_m, TAU * k as f64 / ANGLES as f64))
        };
        let places = radii.flat_map(angles);
        Sites(places.map(|place| (place, self.shapes_at(place))).collect())
    }
}

impl Sites {
    /// Iterates over the points and the values of the shapes.
    pub(super) fn iter(&self) -> impl Iterator<Item = &(Polar, Col<f64>)> {
        self.0.iter()
    }

    /// Largest magnitude of the deflection over the points.
    pub fn largest_m(&self, coordinates: &Col<f64>) -> f64 {
        let at = self
            .iter()
            .map(|(_, shapes)| shapes.transpose() * coordinates);
        at.map(f64::abs).fold(0.0, f64::max)
    }
}
