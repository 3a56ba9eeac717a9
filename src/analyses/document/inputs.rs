//! The table of the numbers of a scene.

use crate::model::scene::{Entry, Quantity, SceneFile, in_words};
use crate::page::outline::{Column, Table, Value};
use crate::page::text::shown;

/// A table with the key, the meaning, the value with its unit and the origin of each number that the scene contains.
pub fn inputs(scene: &SceneFile) -> Table {
    let columns = ["key", "meaning", "value", "origin"].map(Column::words);
    let rows = scene.inputs().into_iter().map(|Entry { path, value }| {
        let quantity = Quantity::of(&path);
        let meaning = quantity.map_or("", |quantity| quantity.name);
        let shown = match (value.as_f64(), quantity.map(|quantity| quantity.unit)) {
            (Some(number), None | Some("")) => shown(number),
            (Some(number), Some(unit)) => format!("{} {unit}", shown(number)),
            (None, _) => in_words(&value),
        };
        let origin = if scene.is_default(&path) {
            "usual value of the program"
        } else {
            "typed"
        };
        [
            path.into(),
            meaning.into(),
            Value::from(shown),
            origin.into(),
        ]
    });
    Table::new("", columns).with_rows(rows)
}
