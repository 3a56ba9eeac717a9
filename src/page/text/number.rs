//! Format of numbers in messages and summaries.

/// Number of significant digits in a message: sufficient for typed numbers, and few enough to hide rounding errors
/// (0.1 + 0.2 is 0.3).
const DIGITS: usize = 12;
/// Range of absolute values that are always written without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-4..1e6;

/// A number with at most 12 significant digits, for a message: 2750, 0.0028, 2.1e11.
pub fn shown(value: f64) -> String {
    shown_to(DIGITS, value)
}

/// A number rounded to a number of significant digits, at least one, without trailing zeros. Very small and
/// large numbers have an exponent if this is shorter.
pub fn shown_to(digits: usize, value: f64) -> String {
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1))
        .parse()
        .unwrap_or(value);
    let plain = rounded.to_string();
    if rounded == 0.0 || !rounded.is_finite() || PLAIN.contains(&rounded.abs()) {
        return plain;
    }
    let with_exponent = format!("{rounded:e}");
    if plain.len() <= with_exponent.len() {
        plain
    } else {
        with_exponent
    }
}

/// A number with the given number of decimals. A number that is rounded to zero has no sign.
pub fn fixed(decimals: usize, value: f64) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
    let unsigned = text.strip_prefix('-').filter(|_| is_zero);
    unsigned.map_or_else(|| text.clone(), str::to_owned)
}

/// A positive number rounded down to a number of significant digits.
pub fn rounded_down(digits: i32, value: f64) -> f64 {
    let unit = 10_f64.powf(value.log10().floor() + 1.0 - f64::from(digits));
    (value / unit).floor() * unit
}

/// Largest number of digits of [`rounded_between`].
pub const MOST_DIGITS: usize = 9;

/// The number of fewest digits, at least two, between two positive numbers; the lower of both if they are too close.
pub fn rounded_between(low: f64, high: f64) -> f64 {
    let rounded = (2..=MOST_DIGITS as i32).map(|digits| rounded_down(digits, high));
    let mut between = rounded.filter(|rounded| *rounded > low && *rounded < high);
    between.next().unwrap_or(low)
}

/// A number of things with the words for one or for several: "1 saw does", "2 saws do".
pub fn counted(count: usize, [one, several]: [&str; 2]) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// A text as the start of a sentence.
pub fn capitalized(text: &str) -> String {
    let mut characters = text.chars();
    let first = characters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + characters.as_str()
}

/// A time in words, to about a tenth.
pub fn time_in_words(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 90.0 => format!("{:.0} seconds", 10.0 * (seconds / 10.0).round()),
        seconds if seconds < 5400.0 => format!("{:.0} minutes", seconds / 60.0),
        seconds => format!("{:.0} hours", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{counted, fixed, rounded_between, shown};

    #[test]
    fn one_thing_is_named_in_the_singular() {
        let found = [0, 1, 2].map(|count| counted(count, ["saw was", "saws were"]));
        assert_eq!(found, ["0 saws were", "1 saw was", "2 saws were"]);
    }

    #[test]
    fn a_number_between_two_others_has_few_digits() {
        let found = [(41145.3, 43300.0), (41145.3, 41167.2), (2.0, 2.0)];
        let found = found.map(|(low, high)| rounded_between(low, high));
        assert_eq!(found, [43000.0, 41160.0, 2.0]);
    }

    #[test]
    fn a_zero_has_no_sign() {
        let found = [-0.0, -4e-4, 4e-4, -5.1e-4, -2.0].map(|value| fixed(3, value));
        assert_eq!(found, ["0.000", "0.000", "0.000", "-0.001", "-2.000"]);
    }

    #[test]
    fn numbers_are_short_and_nothing_typed_is_lost() {
        for (value, expected) in [
            (2749.9999999999995, "2750"),
            (0.1 + 0.05, "0.15"),
            (0.1 + 0.2, "0.3"),
            (1e300, "1e300"),
            (-1e300, "-1e300"),
            (2.1e11, "2.1e11"),
            (1e-12, "1e-12"),
            (1e6, "1e6"),
            (1234567.0, "1234567"),
            (0.30000001, "0.30000001"),
            (0.0028, "0.0028"),
            (40000.0, "40000"),
            (0.0, "0"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(shown(value), expected);
        }
    }
}
