//! A number of a scene that a search has changed.

use crate::model::scene::Quantity;
use crate::page::outline::{Fact, Value};
use crate::page::text::shown_to;

/// A number of the scene before and after a search, with a number of significant digits.
pub(crate) fn changed(path: &str, before: f64, after: f64, digits: usize) -> Fact {
    let quantity = Quantity::of(path);
    let number = |value: f64| Value::Number {
        value,
        words: shown_to(digits, value),
        unit: quantity.map_or("", |quantity| quantity.unit),
        unit_of: quantity.map(|quantity| quantity.path),
    };
    Fact::new(path, number(after)).after(number(before))
}
