//! Axes: positions of values on the sheet, ticks, and numbers at the ticks.

use serde::Serialize;

/// Name of an axis of rotation speeds.
pub const SPEED: &str = "rotation speed Ω\u{2003}[rpm]";

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Spread {
    /// Positions are proportional to the values.
    Linear,
    /// Positions are proportional to the square roots of the values, with their signs. Small values are visible
    /// beside large ones, and zero has a place.
    SignedRoot,
    /// Positions are proportional to the logarithms of the values, which are positive.
    Logarithmic,
}

impl Spread {
    fn of(self, value: f64) -> f64 {
        match self {
            Spread::Linear => value,
            Spread::SignedRoot => value.signum() * value.abs().sqrt(),
            Spread::Logarithmic => value.clamp(f64::MIN_POSITIVE, f64::INFINITY).log10(),
        }
    }
}

/// An axis along one side of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    values: [f64; 2],
    places: [f64; 2],
    spread: Spread,
}

impl Axis {
    /// An axis from the first value at the first position to the last value at the last position. An empty or
    /// non-finite range is replaced, see [`proper_range`].
    pub fn new(values: [f64; 2], places: [f64; 2], spread: Spread) -> Self {
        Self {
            values: proper_range(values),
            places,
            spread,
        }
    }

    /// A linear axis, see [`new`](Self::new).
    pub fn linear(values: [f64; 2], places: [f64; 2]) -> Self {
        Axis::new(values, places, Spread::Linear)
    }

    /// Values at the ends of the axis.
    pub fn values(&self) -> [f64; 2] {
        self.values
    }

    /// Positions of these ends on the sheet, in figure units.
    pub fn places(&self) -> [f64; 2] {
        self.places
    }

    /// Scale of the axis.
    pub fn spread(&self) -> Spread {
        self.spread
    }

    /// Whether the value lies on the axis.
    pub fn shows(&self, value: f64) -> bool {
        self.values[0] <= value && value <= self.values[1]
    }

    /// Position of a value on the sheet, in figure units; a value beyond the ends has a position beyond them.
    pub fn at(&self, value: f64) -> f64 {
        let [from, to] = self.values.map(|v| self.spread.of(v));
        let share = (self.spread.of(value) - from) / (to - from);
        self.places[0] + share * (self.places[1] - self.places[0])
    }

    /// Smallest distance of the ticks of a vertical axis.
    pub fn apart(&self) -> f64 {
        match self.spread {
            Spread::Linear => 40.0,
            // Ticks on these scales are closer to each other, so that small values have ticks too.
            Spread::SignedRoot | Spread::Logarithmic => 21.0,
        }
    }

    /// Round values at a distance of at least `apart` figure units, in ascending order.
    pub fn ticks(&self, apart: f64) -> Vec<f64> {
        match self.spread {
            Spread::Linear => self.even_ticks(apart),
            Spread::SignedRoot => self.root_ticks(apart),
            // Between neighbouring ones of 1, 2, 5, 10, … there are even values, which lie up to twice as close as on
            // average.
            Spread::Logarithmic => match self.decades(apart) {
                few if few.len() < 2 => self.even_ticks(2.0 * apart),
                ticks => ticks,
            },
        }
    }

    /// Number at a tick; on a logarithmic axis a very small or large one is a power of ten.
    pub fn label(&self, tick: f64) -> String {
        match self.spread {
            Spread::Logarithmic if !(1e-3..1e5).contains(&tick) => power_of_ten(tick),
            _ => tick_label(tick),
        }
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn even_ticks(&self, apart: f64) -> Vec<f64> {
        let [from, to] = self.values;
        let most = ((self.places[1] - self.places[0]).abs() / apart).max(1.0);
        let step = round_up((to - from) / most);
        let (first, below) = ((from / step).ceil(), (to / step).floor());
        // Without this margin a rounding error may drop the tick at the end.
        let last = if (below + 1.0) * step <= to + 1e-9 * step {
            below + 1.0
        } else {
            below
        };
        let count = (last - first).clamp(0.0, 1000.0) as usize;
        (0..=count).map(|i| (first + i as f64) * step).collect()
    }

    /// 1, 2, 5, 10, … if they have the required distance, otherwise powers of ten.
    fn decades(&self, apart: f64) -> Vec<f64> {
        let [from, to] = self.values.map(|value| self.spread.of(value));
        let decade = (self.places[1] - self.places[0]).abs() / (to - from);
        let digits: &[f64] = if decade * 2f64.log10() >= apart {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let stride = (apart / decade).ceil().max(1.0) as usize;
        let exponents = (from.floor() as i32..=to.ceil() as i32).step_by(stride);
        let all = exponents.flat_map(|k| digits.iter().map(move |d| d * 10f64.powi(k)));
        let slip = 1e-9 * (to - from);
        all.filter(|tick| (from - slip..=to + slip).contains(&tick.log10()))
            .collect()
    }

    /// Zero, and 1, 3, 10, 30, … of either sign. From the largest size downwards, a value without the required
    /// distance is omitted.
    fn root_ticks(&self, apart: f64) -> Vec<f64> {
        let mut ticks = vec![0.0];
        for end in self.values {
            let mut last_place = None;
            let decade = end.abs().log10().ceil();
            let sizes = (0..8).flat_map(|k| {
                let ten = 10f64.powf(decade - f64::from(k));
                [ten, 0.3 * ten]
            });
            for value in sizes
                .map(|size| end.signum() * size)
                .filter(|v| self.shows(*v))
            {
                let place = self.at(value);
                let clear = |other: f64| (place - other).abs() >= apart;
                if clear(self.at(0.0)) && last_place.is_none_or(clear) {
                    ticks.push(value);
                    last_place = Some(place);
                }
            }
        }
        ticks.retain(|tick| self.shows(*tick));
        ticks.sort_by(f64::total_cmp);
        ticks
    }
}

/// Ends of an axis from the first of some values to the last, and half a cell longer at either end, so that a cell around
/// an outermost value lies within.
pub fn ends_of_cells(values: &[f64], spread: Spread) -> [f64; 2] {
    let [first, last] = ends(values);
    let share = 0.5 / values.len().saturating_sub(1).max(1) as f64;
    match spread {
        Spread::Logarithmic => {
            let beside = (last / first).powf(share);
            [first / beside, last * beside]
        }
        _ => {
            let beside = share * (last - first);
            [first - beside, last + beside]
        }
    }
}

/// The first and the last of some values.
pub fn ends(values: &[f64]) -> [f64; 2] {
    let first = values.first().copied().unwrap_or(1.0);
    [first, values.last().copied().unwrap_or(first)]
}

/// Smallest and largest of the values, which are ∞ and −∞ if there are none.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    let all = values.into_iter();
    all.fold(none, |[low, high], value| [low.min(value), high.max(value)])
}

/// The range, with ends limited to ±10¹² and non-finite ends replaced. A range that is empty or descends is
/// replaced by one around its first end.
pub fn proper_range([from, to]: [f64; 2]) -> [f64; 2] {
    const LARGEST: f64 = 1e12;
    let from = if from.is_finite() {
        from.clamp(-LARGEST, LARGEST)
    } else {
        0.0
    };
    let to = if to.is_finite() {
        to.clamp(-LARGEST, LARGEST)
    } else {
        from
    };
    let least = 1e-6 * from.abs().max(to.abs()).max(1e-6);
    if to - from >= least {
        return [from, to];
    }
    if from == 0.0 {
        return [0.0, 1.0];
    }
    let half = 0.1 * from.abs();
    [from - half, from + half]
}

/// The smallest number 1, 2 or 5 times a power of ten that is not below `size`, which is positive.
pub fn round_up(size: f64) -> f64 {
    let ten = 10f64.powf(size.log10().floor());
    [1.0, 2.0, 5.0]
        .map(|digit| digit * ten)
        .into_iter()
        .find(|step| *step >= size * (1.0 - 1e-9))
        .unwrap_or(10.0 * ten)
}

/// A number with at most six decimals, without trailing zeros.
pub fn tick_label(value: f64) -> String {
    // The sum has no negative zero.
    let rounded = (value * 1e6).round() / 1e6 + 0.0;
    format!("{rounded}").replace('-', "\u{2212}")
}

/// A number rounded to two significant digits; from ten on to a whole number.
pub fn two_digits(value: f64) -> String {
    let magnitude = value.abs().max(1e-6).log10().floor();
    let decimals = (1.0 - magnitude).clamp(0.0, 8.0) as usize;
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// A power of ten with one digit before it: "2·10⁻⁷", "10⁵".
fn power_of_ten(value: f64) -> String {
    let text = format!("{value:.0e}");
    let (digit, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    match digit {
        "1" => format!("10{}", raised(exponent)),
        _ => format!("{digit}·10{}", raised(exponent)),
    }
}

/// A superscript exponent: "⁻⁷".
pub fn raised(exponent: &str) -> String {
    exponent.chars().map(superscript).collect()
}

fn superscript(letter: char) -> char {
    match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        '4'..='9' => char::from_u32('⁴' as u32 + (letter as u32 - '4' as u32)).unwrap_or(letter),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_ticks_are_round_and_reach_both_ends() {
        let axis = Axis::linear([0.0, 3000.0], [0.0, 1000.0]);
        let expected = [0.0, 500.0, 1000.0, 1500.0, 2000.0, 2500.0, 3000.0];
        assert_eq!(axis.ticks(100.0), expected);
    }

    #[test]
    fn root_ticks_keep_their_distance() {
        let axis = Axis::new([-20.0, 35.0], [250.0, 0.0], Spread::SignedRoot);
        let ticks = axis.ticks(25.0);
        assert!(ticks.contains(&0.0) && ticks.contains(&30.0) && ticks.contains(&-10.0));
        for pair in ticks.windows(2) {
            assert!(axis.at(pair[0]) - axis.at(pair[1]) >= 25.0, "{pair:?}");
        }
    }

    #[test]
    fn decades_have_ticks_between_where_there_is_room() {
        let ticks = |values: [f64; 2], apart: f64| {
            let axis = Axis::new(values, [0.0, 400.0], Spread::Logarithmic);
            let labels = axis.ticks(apart).into_iter().map(|tick| axis.label(tick));
            labels.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(
            ticks([1e3, 1e5], 40.0),
            "1000 2000 5000 10000 20000 50000 10⁵"
        );
        assert_eq!(
            ticks([0.5, 5e8], 40.0),
            "1 10 100 1000 10000 10⁵ 10⁶ 10⁷ 10⁸"
        );
        assert_eq!(
            ticks([1e-10, 1e10], 40.0),
            "10⁻¹⁰ 10⁻⁸ 10⁻⁶ 10⁻⁴ 0.01 1 100 10000 10⁶ 10⁸ 10¹⁰"
        );
    }

    #[test]
    fn a_short_logarithmic_range_has_numbers_too() {
        let axis = Axis::new([22.05, 22.5], [0.0, 400.0], Spread::Logarithmic);
        let labels: Vec<_> = axis
            .ticks(40.0)
            .iter()
            .map(|tick| axis.label(*tick))
            .collect();
        assert_eq!(labels, ["22.1", "22.2", "22.3", "22.4", "22.5"]);
        for k in 1..100 {
            let end = 3.0 * (1.0 + 0.1 * f64::from(k));
            let axis = Axis::new([3.0, end], [0.0, 400.0], Spread::Logarithmic);
            let places: Vec<f64> = axis.ticks(40.0).iter().map(|tick| axis.at(*tick)).collect();
            assert!(places.len() >= 2, "{end}");
            assert!(
                places.windows(2).all(|pair| pair[1] - pair[0] >= 38.0),
                "{end} {places:?}"
            );
        }
    }

    #[test]
    fn a_range_without_length_is_widened() {
        for values in [
            [5.0, 5.0],
            [f64::NAN, 1.0],
            [3.0, 1.0],
            [0.0, f64::INFINITY],
        ] {
            let axis = Axis::linear(values, [0.0, 100.0]);
            assert!(axis.at(axis.values()[0]).is_finite());
            assert!(!axis.ticks(20.0).is_empty());
        }
    }

    #[test]
    fn numbers_are_written_with_a_minus_sign() {
        assert_eq!(tick_label(-0.3), "\u{2212}0.3");
        assert_eq!(tick_label(-0.0), "0");
        assert_eq!(tick_label(3.0 * 0.1), "0.3");
    }

    #[test]
    fn numbers_are_cut_to_two_digits() {
        assert_eq!(two_digits(0.0014056), "0.0014");
        assert_eq!(two_digits(-0.5318), "\u{2212}0.53");
        assert_eq!(two_digits(31.4), "31");
    }
}
