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
        Along::new(path, values, |values, spread| {
            let ends = [values.first(), values.last()].map(|end| end.copied().unwrap_or(0.0));
            Axis::new(ends, places, spread)
        })
    }

    /// The axis with cells around the values, which are in the unit of the scene, see [`Axis::of_cells`].
    pub fn of_cells(path: &str, values: &[f64], places: [f64; 2]) -> Self {
        Along::new(path, values, |values, spread| {
            Axis::of_cells(values, places, spread)
        })
    }

    fn new(path: &str, values: &[f64], axis: impl FnOnce(&[f64], Spread) -> Axis) -> Self {
        let (unit, factor) = written::unit(path);
        let name = match unit {
            "" => written::name(path),
            _ => format!("{}\u{2003}[{unit}]", written::name(path)),
        };
        let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
        let spread = match values[..] {
            [first, .., last] if is_logarithmic(first, last) => Spread::Logarithmic,
            _ => Spread::Linear,
        };
        Along {
            axis: axis(&values, spread),
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
