//! The axis of a number of the scene.

use crate::analyses::scene_number::{self, FigureUnit};
use crate::model::scene::is_logarithmic;
use crate::page::figure::axis::{Spread, ends, ends_of_cells};
use crate::page::figure::chart_data::AxisData;

/// The axis of a number of the scene, in the unit in which figures write it, logarithmic if its ends are
/// decades apart.
pub struct Along {
    /// The axis, in the unit of the figure.
    pub axis: AxisData,
    /// Values of the saws, in the unit of the figure.
    pub values: Vec<f64>,
    /// Factor from the unit of the scene to that of the figure.
    factor: f64,
}

impl Along {
    /// The axis from the first value to the last; the values are in the unit of the scene.
    pub fn between(path: &str, values: &[f64]) -> Self {
        Along::new(path, values, |values, _| ends(values))
    }

    /// The axis with cells around the values, which are in the unit of the scene, see [`ends_of_cells`].
    pub fn of_cells(path: &str, values: &[f64]) -> Self {
        Along::new(path, values, ends_of_cells)
    }

    fn new(path: &str, values: &[f64], ends: impl Fn(&[f64], Spread) -> [f64; 2]) -> Self {
        let FigureUnit { symbol, factor } = scene_number::unit(path);
        let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
        let spread = match values[..] {
            [first, .., last] if is_logarithmic(first, last) => Spread::Logarithmic,
            _ => Spread::Linear,
        };
        let axis = AxisData::new(&scene_number::name(path), symbol).spread(spread);
        Along {
            axis: axis.within(ends(&values, spread)),
            values,
            factor,
        }
    }

    /// The value half way on the axis between two values, all in the unit of the figure but the two.
    pub fn half_way(&self, left: f64, right: f64) -> f64 {
        let [left, right] = [left, right].map(|value| self.at(value));
        match self.axis.spread {
            Spread::Logarithmic => (left * right).sqrt(),
            _ => 0.5 * (left + right),
        }
    }

    /// A value in the unit of the figure, from one in that of the scene.
    pub fn at(&self, value: f64) -> f64 {
        self.factor * value
    }
}
