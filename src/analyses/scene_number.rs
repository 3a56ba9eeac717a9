//! Numbers of a scene with their names, in millimetres and gigapascals where scenes have metres and pascals.

use crate::model::scene::Quantity;
use crate::page::figure::axis::raised;
use crate::page::text::shown_to;

/// Units of a scene that figures replace, and the units in their place.
const HANDY: [(&str, FigureUnit); 2] = [
    ("m", FigureUnit::new("mm", 1e3)),
    ("Pa", FigureUnit::new("GPa", 1e-9)),
];

/// Name of a number with a given path: "stiffness of guide 1"; the path itself if it is unknown.
pub fn name(path: &str) -> String {
    let Some(quantity) = Quantity::of(path) else {
        return path.to_owned();
    };
    let index = path
        .strip_prefix("guides[")
        .and_then(|rest| rest.split_once(']'));
    match index.and_then(|(index, _)| index.parse::<usize>().ok()) {
        Some(index) => {
            let guide = format!("guide {}", index + 1);
            quantity.name.replace("the guide", &guide)
        }
        None => quantity.name.to_owned(),
    }
}

/// Unit in which figures write a number.
#[derive(Clone, Copy)]
pub struct FigureUnit {
    /// Symbol of the unit.
    pub symbol: &'static str,
    /// Factor from the unit of the scene to this one.
    pub factor: f64,
}

impl FigureUnit {
    /// A unit with this symbol and factor.
    pub const fn new(symbol: &'static str, factor: f64) -> Self {
        FigureUnit { symbol, factor }
    }
}

/// Unit in which figures write a number with a given path.
pub fn unit(path: &str) -> FigureUnit {
    let symbol = Quantity::of(path).map_or("", |quantity| quantity.unit);
    let handy = HANDY.iter().find(|(own, _)| *own == symbol);
    let factor = 1.0;
    handy.map_or(FigureUnit { symbol, factor }, |(_, unit)| *unit)
}

/// Name, value and unit of a number with a given path: "radius of guide 1: 250.3 mm". The value is in the unit of the
/// scene.
pub fn in_words(path: &str, value: f64) -> String {
    let FigureUnit { symbol, factor } = unit(path);
    let space = if matches!(symbol, "" | "°") { "" } else { " " };
    format!(
        "{}: {}{space}{symbol}",
        name(path),
        four_digits(factor * value)
    )
}

/// Significant digits of a value in a sentence.
pub const DIGITS: usize = 4;

/// Value and unit of a number with a given path in a sentence: "2.8 mm". The value is in the unit of the scene.
pub fn with_unit(path: &str, value: f64) -> String {
    let FigureUnit { symbol, factor } = unit(path);
    let words = format!("{} {symbol}", shown_to(DIGITS, factor * value));
    words.trim_end().to_owned()
}

/// A number with four significant digits; very small and large numbers have a power of ten.
fn four_digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        let text = format!("{value:.3e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{digits}·10{}", raised(exponent)).replace('-', "\u{2212}");
    }
    let decimals = 3 - value.abs().max(1e-3).log10().floor() as i32;
    let text = format!("{value:.*}", decimals.clamp(0, 6) as usize);
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_name_and_the_unit_of_the_table() {
        let said = [
            ("guides[0].stiffness_n_per_m", 5.988e8),
            ("guides[1].radius_m", 0.2503),
            ("guides[0].angle_deg", -119.9),
            ("blade.material.youngs_modulus_pa", 2.1e11),
            ("blade.material.density_kg_per_m3", 7850.0),
            ("an.unknown_key", 2.0),
        ]
        .map(|(path, value)| in_words(path, value));
        let expected = [
            "stiffness of guide 1: 5.988·10⁸ N/m",
            "radius of guide 2: 250.3 mm",
            "angle of guide 1: \u{2212}119.9°",
            "Young's modulus: 210.0 GPa",
            "density: 7850 kg/m³",
            "an.unknown_key: 2.000",
        ];
        assert_eq!(said, expected);
    }

    #[test]
    fn numbers_of_any_size_take_four_digits() {
        assert_eq!(four_digits(0.194024), "0.1940");
        assert_eq!(four_digits(-55.0), "\u{2212}55.00");
        assert_eq!(four_digits(2.0e7), "2.000·10⁷");
        assert_eq!(four_digits(-2.5e-4), "\u{2212}2.500·10⁻⁴");
        assert_eq!(four_digits(0.0), "0.000000");
    }
}
