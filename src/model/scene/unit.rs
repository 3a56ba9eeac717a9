//! Units in text form: `mm`, `kN/mm`, `g/cm³`, `N·s/m`, `1/K`.
//!
//! A unit is a factor to SI and powers of base units. Units of the same powers measure the same quantity. The
//! angle is a base unit of its own, so that revolutions per minute are not mistaken for hertz.

/// Powers of metre, kilogram, second, kelvin and angle.
type Powers = [f64; 5];

/// Factor to SI and powers of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    /// Ratio of the unit to the SI unit of its quantity.
    pub factor: f64,
    powers: Powers,
}

const fn unit(factor: f64, powers: Powers) -> Unit {
    Unit { factor, powers }
}

const LENGTH: Powers = [1.0, 0.0, 0.0, 0.0, 0.0];
const MASS: Powers = [0.0, 1.0, 0.0, 0.0, 0.0];
const TIME: Powers = [0.0, 0.0, 1.0, 0.0, 0.0];
const FORCE: Powers = [1.0, 1.0, -2.0, 0.0, 0.0];
const PRESSURE: Powers = [-1.0, 1.0, -2.0, 0.0, 0.0];
const POWER: Powers = [2.0, 1.0, -3.0, 0.0, 0.0];
const ANGLE: Powers = [0.0, 0.0, 0.0, 0.0, 1.0];
const TURNING: Powers = [0.0, 0.0, -1.0, 0.0, 1.0];
const NUMBER: Powers = [0.0; 5];
const ONE: Unit = unit(1.0, NUMBER);
const TURN: f64 = 2.0 * std::f64::consts::PI;
const POUND_KG: f64 = 0.453_592_37;
const POUND_N: f64 = POUND_KG * 9.806_65;
const INCH_M: f64 = 0.0254;

/// Units that take a prefix.
const PREFIXED: [(&str, Unit); 9] = [
    ("m", unit(1.0, LENGTH)),
    ("g", unit(1e-3, MASS)),
    ("s", unit(1.0, TIME)),
    ("K", unit(1.0, [0.0, 0.0, 0.0, 1.0, 0.0])),
    ("N", unit(1.0, FORCE)),
    ("Pa", unit(1.0, PRESSURE)),
    ("W", unit(1.0, POWER)),
    ("Hz", unit(1.0, [0.0, 0.0, -1.0, 0.0, 0.0])),
    ("rad", unit(1.0, ANGLE)),
];

/// Units without a prefix. They are tried first, so that `min` is not read as milli-inch.
const PLAIN: [(&str, Unit); 18] = [
    ("1", ONE),
    ("%", unit(1e-2, NUMBER)),
    ("min", unit(60.0, TIME)),
    ("h", unit(3600.0, TIME)),
    ("°", unit(TURN / 360.0, ANGLE)),
    ("deg", unit(TURN / 360.0, ANGLE)),
    ("rev", unit(TURN, ANGLE)),
    ("rpm", unit(TURN / 60.0, TURNING)),
    ("rps", unit(TURN, TURNING)),
    ("bar", unit(1e5, PRESSURE)),
    ("in", unit(INCH_M, LENGTH)),
    ("inch", unit(INCH_M, LENGTH)),
    ("ft", unit(12.0 * INCH_M, LENGTH)),
    ("lb", unit(POUND_KG, MASS)),
    ("lbf", unit(POUND_N, FORCE)),
    ("psi", unit(POUND_N / (INCH_M * INCH_M), PRESSURE)),
    ("ksi", unit(1e3 * POUND_N / (INCH_M * INCH_M), PRESSURE)),
    ("hp", unit(550.0 * 12.0 * INCH_M * POUND_N, POWER)),
];

const PREFIXES: [(char, f64); 9] = [
    ('n', 1e-9),
    ('u', 1e-6),
    ('µ', 1e-6),
    ('μ', 1e-6),
    ('m', 1e-3),
    ('c', 1e-2),
    ('k', 1e3),
    ('M', 1e6),
    ('G', 1e9),
];

const SIGNS: [char; 7] = ['*', '·', '⋅', '/', '^', '(', ')'];

impl Unit {
    /// Parses a unit; `None` if the text is not a unit. An empty text is the unit of a dimensionless number.
    pub fn parse(text: &str) -> Option<Unit> {
        let words: Vec<&str> = text.split_whitespace().collect();
        // Two units that only a blank separates are refused: without the blank, `m s` would be read as
        // milliseconds.
        let is_apart = |pair: &[&str]| !pair[0].ends_with(SIGNS) && !pair[1].starts_with(SIGNS);
        if words.windows(2).any(is_apart) {
            return None;
        }
        let text = words.concat();
        if text.is_empty() {
            return Some(ONE);
        }
        let mut rest = text.as_str();
        let unit = product(&mut rest)?;
        rest.is_empty().then_some(unit)
    }

    /// Whether both units measure the same quantity.
    pub fn is_of(&self, other: &Unit) -> bool {
        self.powers == other.powers
    }

    fn times(self, other: Unit, exponent: f64) -> Unit {
        let mut powers = self.powers;
        for (power, of) in powers.iter_mut().zip(other.powers) {
            *power += exponent * of;
        }
        Unit {
            factor: self.factor * other.factor.powf(exponent),
            powers,
        }
    }
}

/// Parses factors from left to right, up to a closing bracket or the end.
fn product(rest: &mut &str) -> Option<Unit> {
    let mut unit = power(rest)?;
    while let Some(sign) = rest.chars().next().filter(|c| "*·⋅/".contains(*c)) {
        *rest = &rest[sign.len_utf8()..];
        unit = unit.times(power(rest)?, if sign == '/' { -1.0 } else { 1.0 });
    }
    Some(unit)
}

/// Parses a symbol or a product in brackets, with its exponent.
fn power(rest: &mut &str) -> Option<Unit> {
    let base = match rest.strip_prefix('(') {
        Some(inner) => {
            *rest = inner;
            let unit = product(rest)?;
            *rest = rest.strip_prefix(')')?;
            unit
        }
        None => {
            let is_one = rest.starts_with('1');
            let letters = rest.find(|c: char| !(c.is_alphabetic() || c == '°' || c == '%'));
            let end = if is_one {
                1
            } else {
                letters.unwrap_or(rest.len())
            };
            let (symbol, after) = rest.split_at(end);
            *rest = after;
            of_symbol(symbol)?
        }
    };
    Some(ONE.times(base, exponent(rest)?))
}

/// Unit of a symbol with or without a prefix.
fn of_symbol(symbol: &str) -> Option<Unit> {
    let named = |table: &[(&str, Unit)], name: &str| {
        let found = table.iter().find(|(own, _)| *own == name);
        found.map(|(_, unit)| *unit)
    };
    let whole = named(&PLAIN, symbol).or_else(|| named(&PREFIXED, symbol));
    whole.or_else(|| {
        let first = symbol.chars().next()?;
        let (_, factor) = PREFIXES.iter().find(|(prefix, _)| *prefix == first)?;
        let mut unit = named(&PREFIXED, &symbol[first.len_utf8()..])?;
        unit.factor *= factor;
        Some(unit)
    })
}

/// Parses an exponent, such as `²`, `³`, `2`, `^2`, `**2`, `^-1` or `^(3/2)`; without one, returns 1.
fn exponent(rest: &mut &str) -> Option<f64> {
    for (sign, value) in [('²', 2.0), ('³', 3.0)] {
        if let Some(after) = rest.strip_prefix(sign) {
            *rest = after;
            return Some(value);
        }
    }
    let marked = rest.strip_prefix('^').or_else(|| rest.strip_prefix("**"));
    *rest = marked.unwrap_or(rest);
    if let Some(inner) = rest.strip_prefix('(') {
        // A bracket without `^` or `**` before it is not an exponent, so that a unit like `m(2)` is refused.
        marked?;
        let (fraction, after) = inner.split_once(')')?;
        *rest = after;
        let (above_text, below_text) = fraction.split_once('/').unwrap_or((fraction, "1"));
        let (above, below): (f64, f64) = (above_text.parse().ok()?, below_text.parse().ok()?);
        return (below != 0.0).then_some(above / below);
    }
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '-'));
    let (digits, after) = rest.split_at(end.unwrap_or(rest.len()));
    *rest = after;
    match (digits, marked) {
        ("", None) => Some(1.0),
        _ => digits.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantities::QUANTITIES;
    use super::*;

    /// Factors of the SI brochure and of NIST's guide SP 811, appendix B.
    #[test]
    fn factors_are_those_of_the_tables_of_units() {
        let cases = [
            ("mm", "m", 1e-3),
            ("in", "m", 0.0254),
            ("kN/mm", "N/m", 1e6),
            ("N/µm", "N/m", 1e6),
            ("lbf/in", "N/m", 175.126_835),
            ("GPa", "Pa", 1e9),
            ("N/mm²", "Pa", 1e6),
            ("N/mm^2", "Pa", 1e6),
            ("psi", "Pa", 6_894.757),
            ("g/cm³", "kg/m³", 1e3),
            ("g/cm3", "kg/m**3", 1e3),
            ("kg*m/s^2", "N", 1.0),
            ("kW", "W", 1e3),
            ("hp", "W", 745.699_9),
            ("N·m/s", "W", 1.0),
            ("m/min", "m/s", 1.0 / 60.0),
            ("km/h", "m/s", 1.0 / 3.6),
            ("rad", "°", 57.295_779_5),
            ("rad/s", "rpm", 9.549_296_6),
            ("rev/s", "rpm", 60.0),
            ("%", "", 1e-2),
            ("kg/s", "N·s/m", 1.0),
            ("kN/mm^(3/2)", "N/m^(3/2)", 1e3 * 1e3_f64.powf(1.5)),
        ];
        for (from, to, factor) in cases {
            let units = (Unit::parse(from), Unit::parse(to));
            let (from_unit, to_unit) = (units.0.expect(from), units.1.expect(to));
            assert!(from_unit.is_of(&to_unit), "{from} {to}");
            let found = from_unit.factor / to_unit.factor;
            assert!((found / factor - 1.0).abs() < 1e-7, "{from}: {found}");
        }
    }

    #[test]
    fn units_of_other_quantities_and_other_texts_are_refused() {
        let of = |a: &str, b: &str| Unit::parse(a).unwrap().is_of(&Unit::parse(b).unwrap());
        assert!(!of("mm", "N"));
        assert!(!of("Hz", "rpm"));
        assert!(!of("1/min", "rpm"));
        assert!(!of("m", "m^2"));
        for text in [
            "furlong", "m/", "/m", "m)", "(m", "m^", "mm2/", "kmin", "m(m)", "m s",
        ] {
            assert_eq!(Unit::parse(text), None, "{text}");
        }
    }

    #[test]
    fn the_unit_of_every_quantity_is_read() {
        for quantity in QUANTITIES {
            assert!(Unit::parse(quantity.unit).is_some(), "{}", quantity.unit);
        }
    }
}
