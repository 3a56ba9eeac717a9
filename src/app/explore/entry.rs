//! The text that a user types into a field.

use super::fields::{Field, Units};
use super::refusal::Refusal;
use super::wording::unread;
use crate::model::scene::{Quantity, Reading};

impl Field {
    /// Reads the text of the field at a path, a number in its unit or with another one, in the unit of the key.
    ///
    /// # Errors
    /// [`Refusal`] if the form has no such field, or the text is no number in its unit.
    pub fn read(path: &str, text: &str, units: Units) -> Result<f64, Refusal> {
        let no_field = || Refusal::with_message(format!("{path} is not a number of a scene"));
        let field = Field::of(path).ok_or_else(no_field)?;
        let shown = field.unit(units);
        // Some units of the form, such as "N per tooth", are names of the unit of the key.
        let own = Quantity::of(path).map_or("", |quantity| quantity.unit);
        let unit_left_out = if shown.scale == 1.0 { own } else { shown.unit };
        let reading = Reading::of(path).map(|reading| reading.usually_in(unit_left_out));
        let read = reading.and_then(|reading| reading.number(text));
        read.map_err(|refused| {
            let told = unread(&field, &refused);
            Refusal::from(refused).telling(told)
        })
    }
}
