//! The axis of a number of the scene.

use super::axis::{Axis, Spread};
use super::written;
use crate::scene::is_logarithmic;

/// The axis of a number of the scene, in the unit in which figures write it, logarithmic if its ends are
/// decades apart.
pub struct Along {
    /// The axis, in the unit of the figure.
    pub axis: Axis,
    /// Values of the saws, in the unit of the figure.
    pub values: Vec<f64>,
    /// Name of the number, with the unit of the figure.
    pub name: String,
    /// Factor from the unit of the scene to that of the figure.
    factor: f64,
}

impl Along {
    /// The axis from the first value to the last; the values are in the unit of the scene.
    pub fn between(path: &str, values: &[f64], places: [f64; 2]) -> Self {
        Along::longer(path, values, places, 0.0)
    }

    /// The axis with cells around the values, which are in the unit of the scene, see [`Axis::of_cells`].
    pub fn of_cells(path: &str, values: &[f64], places: [f64; 2]) -> Self {
        Along::longer(path, values, places, 0.5)
    }

    fn longer(path: &str, values: &[f64], places: [f64; 2], by_cells: f64) -> Self {
        let (unit, factor) = written::unit(path);
        let name = match unit {
            "" => written::name(path),
            _ => format!("{}\u{2003}[{unit}]", written::name(path)),
        };
        let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
        let first = values.first().copied().unwrap_or(0.0);
        let last = values.last().copied().unwrap_or(1.0);
        let share = by_cells / values.len().saturating_sub(1).max(1) as f64;
        let (spread, ends) = if is_logarithmic(first, last) {
            let beside = (last / first).powf(share);
            (Spread::Logarithmic, [first / beside, last * beside])
        } else {
            let beside = share * (last - first);
            (Spread::Linear, [first - beside, last + beside])
        };
        Along {
            axis: Axis::new(ends, places, spread),
            values,
            name,
            factor,
        }
    }

    /// Position on the sheet of a value in the unit of the scene.
    pub fn at(&self, value: f64) -> f64 {
        self.axis.at(self.factor * value)
    }

    /// Whether a value in the unit of the scene lies on the axis.
    pub fn shows(&self, value: f64) -> bool {
        self.axis.shows(self.factor * value)
    }
}
