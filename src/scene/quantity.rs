//! A number of a scene: name, unit, allowed and usual range, typical value.

use serde::Serialize;

use super::RefusedValue;
use super::quantities::QUANTITIES;
use super::span::Span;
use crate::text::shown;

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

/// The quantity with this path, with `[]` for indices. Use it in constants: then a path that is not in the table does not
/// compile.
pub(crate) const fn quantity(path: &str) -> Quantity {
    let mut k = 0;
    while k < QUANTITIES.len() {
        let own = QUANTITIES[k].path.as_bytes();
        let mut same = own.len() == path.len();
        let mut at = 0;
        while same && at < own.len() {
            same = own[at] == path.as_bytes()[at];
            at += 1;
        }
        if same {
            return QUANTITIES[k];
        }
        k += 1;
    }
    panic!("the table of quantities has no such path")
}

/// The typical value of the quantity with this path, for constants.
pub(crate) const fn typical_value(path: &str) -> f64 {
    match quantity(path).typical {
        Some(typical) => typical.value,
        None => panic!("the quantity has no typical value"),
    }
}

impl Quantity {
    /// The quantity of a path such as `guides[0].radius_m`; `None` if scenes have no such number.
    pub fn of(path: &str) -> Option<&'static Self> {
        let general = general(path);
        QUANTITIES.iter().find(|quantity| quantity.path == general)
    }

    /// The kind of the number at a path.
    pub fn kind_of(path: &str) -> Kind {
        Self::of(path).map_or(Kind::Other, |quantity| quantity.kind)
    }

    /// Returns a number if it is in the allowed range; `key` names it in the error.
    ///
    /// # Errors
    /// [`RefusedValue`] if it is not.
    pub(crate) fn checked(&self, key: &str, value: f64) -> Result<f64, RefusedValue> {
        match self.allowed.contains(value) {
            true => Ok(value),
            false => Err(self.refused(key, value, value)),
        }
    }

    /// The error of a number outside the allowed range, given as `words`.
    pub(super) fn refused(&self, key: &str, value: f64, words: impl super::Given) -> RefusedValue {
        let allowed = match self.allowed.is_far() {
            true => format!(
                "{}; {}",
                self.allowed.end_in_words(value),
                self.usual_in_words()
            ),
            false => self.allowed.in_words(),
        };
        let remedy = match (self.unit, self.kind) {
            ("", Kind::Count) => "give a whole number in this range",
            ("", _) => "it has no unit; 1 % is 0.01",
            _ => "give it in the unit that ends the key's name",
        };
        RefusedValue::new(key, words, allowed, remedy)
    }

    /// The usual range for a reader: "saws have 0.04 to 5 m".
    pub(crate) fn usual_in_words(&self) -> String {
        let (from, to) = self.usual;
        let words = format!("saws have {} to {} {}", shown(from), shown(to), self.unit);
        words.trim_end().to_owned()
    }

    /// Whether a value is zero or in the usual range.
    pub fn is_usual(&self, value: f64) -> bool {
        value == 0.0 || (self.usual.0..=self.usual.1).contains(&value)
    }
}

/// A path with `[]` for the index of a list.
pub(super) fn general(path: &str) -> String {
    let mut general = String::new();
    let mut inside = false;
    for character in path.chars() {
        inside &= character != ']';
        if !inside {
            general.push(character);
        }
        inside |= character == '[';
    }
    general
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::json_schema;
    use crate::scene::schema::keys;

    #[test]
    fn kinds_follow_from_the_last_key_and_from_guides() {
        let kinds = [
            ("guides[2].radius_m", Kind::GuideRadius),
            ("probe.radius_m", Kind::Radius),
            ("cut.angle_deg", Kind::Angle),
            ("cut.wood.stiffness_n_per_m", Kind::Stiffness),
            ("guides[0].damping_n_s_per_m", Kind::Damping),
            ("blade.thickness_m", Kind::Other),
        ];
        for (path, kind) in kinds {
            assert_eq!(Quantity::kind_of(path), kind, "{path}");
        }
        // A number that is added to the table has the kind of those with the same last key.
        for (k, one) in QUANTITIES.iter().enumerate() {
            let last = |quantity: &Quantity| quantity.path.rsplit('.').next();
            let is_guide = |quantity: &Quantity| quantity.kind == Kind::GuideRadius;
            let alike = QUANTITIES[..k]
                .iter()
                .filter(|other| last(other) == last(one));
            for other in alike.filter(|other| !is_guide(other) && !is_guide(one)) {
                assert_eq!(one.kind, other.kind, "{} {}", one.path, other.path);
            }
        }
    }

    #[test]
    fn the_table_has_the_numbers_of_the_schema_and_no_others() {
        let schema = json_schema();
        let is_of = |path: &str, kind: &str| {
            let key = keys(&schema).into_iter().find(|key| key.path == path);
            let node = key.and_then(|key| schema.pointer(&key.pointer).cloned());
            node.is_some_and(|node| node["type"] == kind || node["type"][0] == kind)
        };
        let mut of_schema: Vec<String> = keys(&schema).into_iter().map(|key| key.path).collect();
        of_schema.retain(|path| is_of(path, "number") || is_of(path, "integer"));
        let mut of_table: Vec<String> = QUANTITIES.iter().map(|q| q.path.to_owned()).collect();
        of_schema.sort();
        of_table.sort();
        assert_eq!(of_table, of_schema);
        for quantity in QUANTITIES {
            let is_count = quantity.kind == Kind::Count;
            assert_eq!(
                is_of(quantity.path, "integer"),
                is_count,
                "{}",
                quantity.path
            );
        }
    }

    #[test]
    fn usual_and_typical_values_are_allowed_and_usual() {
        for quantity in QUANTITIES {
            let path = quantity.path;
            for end in [quantity.usual.0, quantity.usual.1] {
                assert!(
                    end == 0.0 || quantity.allowed.contains(end),
                    "{path}: {end}"
                );
            }
            let Some(typical) = quantity.typical else {
                continue;
            };
            let (low, high) = typical.common;
            assert!((low..=high).contains(&typical.value), "{path}");
            for value in [typical.value, low, high] {
                assert!(
                    !typical.is_number() || quantity.is_usual(value),
                    "{path}: {value}"
                );
            }
        }
    }

    #[test]
    fn a_quantity_is_found_by_the_path_of_an_error() {
        let radius = Quantity::of("guides[12].radius_m").unwrap();
        assert_eq!((radius.name, radius.unit), ("radius of the guide", "m"));
        assert!(Quantity::of("measured.rows[0].frequencies_hz[3]").is_some());
        assert!(Quantity::of("guides[0]").is_none());
    }
}
