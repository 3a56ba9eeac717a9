//! A number of a scene: name, unit, allowed and usual range, typical value.

use serde::Serialize;

use super::RefusedValue;
use super::span::Span;
use crate::page::text::shown;

/// Remedy for a negative speed.
pub(super) const TURNS_THE_OTHER_WAY: &str =
    "speeds are positive; for a saw that turns the other way change the sign of every angle";

/// Name, unit and ranges of a number of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quantity {
    /// JSON path, with `[]` for any index of a list.
    pub path: &'static str,
    /// Name, used in axis labels and tables.
    pub name: &'static str,
    /// Unit; empty for a dimensionless number.
    pub unit: &'static str,
    /// Range outside of which a number is refused. Other keys may narrow it.
    pub allowed: Span,
    /// Range that includes all saws in use. Zero is always usual, because it means that the feature is absent.
    pub usual: (f64, f64),
    /// Kind, which determines how the number varies in production and in searches.
    pub kind: Kind,
    /// Value for a user who does not know the number.
    pub typical: Option<Typical>,
}

/// Kind of a number. Each kind has its own tolerances of production and its own usual bounds of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Radius of a guide, anywhere on the blade.
    GuideRadius,
    /// Radius of anything but a guide.
    Radius,
    /// Angle of a guide, a force, the cut or the probe.
    Angle,
    /// Stiffness of a contact, known by its power of ten.
    Stiffness,
    /// Damping of a contact, known by its power of ten.
    Damping,
    /// Gap of a guide.
    Gap,
    /// Whole number.
    Count,
    /// Any other number.
    Other,
}

/// A typical value of a number. The schema and the form offer it; a command that assumes it reports it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Typical {
    /// The value, in the unit of the key, or with the unit or reference in `of`.
    pub value: f64,
    /// Unit or reference of the value, if the number of the key is computed from it; empty if the value is this
    /// number.
    pub of: &'static str,
    /// Smallest and largest value of common saws.
    pub common: (f64, f64),
    /// Source of value and range.
    pub basis: &'static str,
}

/// A quantity of the table, of kind [`Kind::Other`] and without a typical value.
pub(super) const fn q(
    path: &'static str,
    name: &'static str,
    unit: &'static str,
    allowed: Span,
    from: f64,
    to: f64,
) -> Quantity {
    Quantity {
        path,
        name,
        unit,
        allowed,
        usual: (from, to),
        kind: Kind::Other,
        typical: None,
    }
}

impl Quantity {
    pub(super) const fn of_kind(self, kind: Kind) -> Self {
        Quantity { kind, ..self }
    }

    pub(super) const fn typically(
        self,
        value: f64,
        of: &'static str,
        low: f64,
        high: f64,
        basis: &'static str,
    ) -> Self {
        let typical = Typical {
            value,
            of,
            common: (low, high),
            basis,
        };
        Quantity {
            typical: Some(typical),
            ..self
        }
    }
}

impl Quantity {
    /// Returns a number if it is in the allowed range; `key` names it in the error.
    ///
    /// # Errors
    /// [`RefusedValue`] if it is not.
    pub(crate) fn checked(&self, key: &str, value: f64) -> Result<f64, RefusedValue> {
        if self.allowed.contains(value) {
            Ok(value)
        } else {
            Err(self.refused(key, value, value))
        }
    }

    /// The error of a number outside the allowed range, given as `words`.
    pub(super) fn refused(&self, key: &str, value: f64, words: impl super::Given) -> RefusedValue {
        let is_narrower = self.usual != (self.allowed.from, self.allowed.to);
        let allowed = if self.allowed.is_far() && is_narrower {
            format!(
                "{}, {}",
                self.allowed.end_in_words(value),
                self.usual_in_words()
            )
        } else {
            format!("{} {}", self.allowed.in_words(), self.unit)
        };
        let remedy = match (self.unit, self.kind) {
            ("", Kind::Count) => "give a whole number in this range",
            ("", _) => "give a number in this range; 1 % is 0.01",
            ("rpm", _) if value < 0.0 => TURNS_THE_OTHER_WAY,
            _ => "give a number in this range, in this unit",
        };
        let meant = self.question_of_unit(value);
        let remedy = meant.unwrap_or_else(|| remedy.to_owned());
        RefusedValue::new(key, words, allowed.trim_end(), remedy)
    }

    /// The usual range for a reader: "usual range 0.04 to 5 m".
    pub(crate) fn usual_in_words(&self) -> String {
        let (from, to) = self.usual;
        let words = format!("usual range {} to {} {}", shown(from), shown(to), self.unit);
        words.trim_end().to_owned()
    }

    /// Whether a value is zero or in the usual range.
    pub fn is_usual(&self, value: f64) -> bool {
        value == 0.0 || (self.usual.0..=self.usual.1).contains(&value)
    }
}

impl Typical {
    /// Whether the value is the number of the key.
    pub fn is_number(&self) -> bool {
        self.of.is_empty()
    }

    /// Describes value and range: "Typically 20, from 0 to 90 (source)."
    pub(super) fn sentence(&self) -> String {
        let [value, low, high] = [self.value, self.common.0, self.common.1].map(shown);
        let space = if self.is_number() { "" } else { " " };
        let (of, basis) = (self.of, self.basis);
        format!("Typically {value}{space}{of}, from {low} to {high} ({basis}).")
    }
}
