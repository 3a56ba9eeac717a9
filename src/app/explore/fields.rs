//! Fields of the form: names, units and usual ranges of the numbers of a scene.

use serde::{Deserialize, Serialize};

use crate::model::scene::{Kind, QUANTITIES, Quantity};

/// Units of the form. Only lengths differ.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Units {
    /// Lengths in millimetres.
    #[default]
    Metric,
    /// Lengths in inches.
    Inches,
}

/// Unit in which a number is shown and typed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FieldUnit {
    /// Symbol; empty for a dimensionless number.
    pub unit: &'static str,
    /// Factor from the unit of the key to this one.
    pub scale: f64,
    /// Number of digits that are shown.
    digits: u32,
}

/// A number of a scene as the form shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Field {
    /// JSON path, with `[]` for any index of a list.
    pub path: &'static str,
    /// Name that is clear without the form around it.
    pub name: &'static str,
    /// Name beside the field: the key without its unit.
    pub label: String,
    /// Unit in scenes; empty for a dimensionless number.
    si: &'static str,
    /// Whether the number is a count.
    pub whole: bool,
    /// Kind of the number.
    kind: Kind,
    /// Range that includes all saws in use, in the unit of the key.
    pub usual: (f64, f64),
    metric: FieldUnit,
    inches: FieldUnit,
}

/// Unit of a quantity, ending of its key, unit of the field, and the factor to it.
const UNITS: [(&str, &str, &str, f64); 24] = [
    ("m", "_m", "mm", 1e3),
    ("kg", "_kg", "kg", 1.0),
    ("Pa", "_pa", "MPa", 1e-6),
    ("kg/m³", "_kg_per_m3", "kg/m³", 1.0),
    ("kg·m²", "_kg_m2", "kg·m²", 1.0),
    ("°", "_deg", "°", 1.0),
    ("N/m", "_n_per_m", "MN/m", 1e-6),
    ("N·m/(rad·m)", "_n_m_per_rad_per_m", "N·m/(rad·m)", 1.0),
    ("N·s/m", "_n_s_per_m", "N·s/m", 1.0),
    ("N·s/m³", "_n_s_per_m3", "N·s/m³", 1.0),
    ("N/m^(3/2)", "_n_per_m_3_2", "N/m^1.5", 1.0),
    ("N·(s/m)^(3/2)", "_n_s_3_2_per_m_3_2", "N·(s/m)^1.5", 1.0),
    ("s", "_s", "s", 1.0),
    ("1/s", "_per_s", "1/s", 1.0),
    ("1/K", "_per_k", "1/K", 1.0),
    ("K", "_k", "K", 1.0),
    ("rpm", "_rpm", "rpm", 1.0),
    ("N", "_n_per_tooth", "N per tooth", 1.0),
    ("N", "_n", "N", 1.0),
    ("W", "_w", "W", 1.0),
    ("W/(m²·K)", "_w_per_m2_k", "W/(m²·K)", 1.0),
    ("W/(m·K)", "_w_per_m_k", "W/(m·K)", 1.0),
    ("m/s", "_m_per_s", "m/s", 1.0),
    ("Hz", "_hz", "Hz", 1.0),
];
/// Keys whose labels are not the keys without their units: name, unit of the field, and the factor to it.
const NAMED: [(&str, &str, &str, f64); 2] = [
    ("youngs_modulus_pa", "Young's modulus", "GPa", 1e-9),
    ("rpm", "speed", "rpm", 1.0),
];
const INCH_M: f64 = 0.0254;
/// With this many digits, a typed number is shown as typed after its unit was converted.
const DIGITS: u32 = 12;
/// A round length in millimetres is not a round number of inches.
const INCH_DIGITS: u32 = 6;

impl Field {
    /// Returns the fields of all numbers of scenes in the order of the schema.
    pub fn all() -> Vec<Self> {
        QUANTITIES.iter().map(Field::new).collect()
    }

    /// Returns the field of a path such as `guides[0].radius_m`; `None` if it is not that of a number or of a list of numbers.
    pub fn of(path: &str) -> Option<Self> {
        let quantity = Quantity::of(path).or_else(|| Quantity::of(&format!("{path}[]")));
        quantity.map(Field::new)
    }

    fn new(quantity: &Quantity) -> Self {
        let path = quantity.path.trim_end_matches("[]");
        let key = path.rsplit('.').next().unwrap_or(path);
        let named = NAMED.iter().find(|(own, ..)| *own == key);
        let by_ending = || {
            let mut units = UNITS.iter().filter(|(si, ..)| *si == quantity.unit);
            units.find_map(|(_, ending, unit, scale)| {
                Some((key.strip_suffix(ending)?, *unit, *scale))
            })
        };
        let (label, unit, scale) = match named {
            Some((_, name, unit, scale)) => (*name, *unit, *scale),
            None => by_ending().unwrap_or((key, quantity.unit, 1.0)),
        };
        let metric = FieldUnit {
            unit,
            scale,
            digits: DIGITS,
        };
        let inches = match quantity.unit {
            "m" => FieldUnit {
                unit: "in",
                scale: 1.0 / INCH_M,
                digits: INCH_DIGITS,
            },
            _ => metric,
        };
        Field {
            path: quantity.path,
            name: quantity.name,
            label: label.replace('_', " "),
            si: quantity.unit,
            whole: quantity.kind == Kind::Count,
            kind: quantity.kind,
            usual: quantity.usual,
            metric,
            inches,
        }
    }

    /// Returns the unit in which the field is shown.
    pub fn unit(&self, units: Units) -> FieldUnit {
        match units {
            Units::Metric => self.metric,
            Units::Inches => self.inches,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No label contains the unit of its key, and the units convert by the factors of the SI.
    #[test]
    fn a_label_is_a_key_without_its_unit() {
        for field in Field::all() {
            let unit = Quantity::of(field.path).unwrap().unit;
            let has_unit = unit.is_empty() || !field.metric.unit.is_empty();
            assert!(has_unit, "{}", field.path);
            let words: Vec<&str> = field.label.split(' ').collect();
            for ending in ["m", "n", "rpm", "deg", "pa", "k", "s", "w"] {
                assert_ne!(words.last(), Some(&ending), "{}", field.path);
            }
        }
        let shown = |path, units| Field::of(path).unwrap().unit(units);
        let stiffness = shown("guides[0].stiffness_n_per_m", Units::Metric);
        assert_eq!((stiffness.unit, 2e7 * stiffness.scale), ("MN/m", 20.0));
        let inches = shown("blade.thickness_m", Units::Inches);
        assert_eq!((inches.unit, 0.0254 * inches.scale), ("in", 1.0));
        let force = Field::of("cut.radial_n_per_tooth").unwrap();
        assert_eq!(
            (force.label.as_str(), force.metric.unit),
            ("radial", "N per tooth")
        );
    }
}
