//! Values that a shop can make.

use super::SizedWindow;
use crate::model::scene::typical_block::rounded;

/// Blades are ground to tenths of a millimetre.
const THICKNESS_M: f64 = 1e-4;
/// Number of significant digits of other numbers.
const DIGITS: i32 = 3;
/// Digits that remove the rounding error of a multiple of a step.
const WRITTEN: usize = 12;

/// A rounded value in a range, some steps inside of the end that is nearer to the value of the scene. The middle of a range that
/// is narrower.
pub fn rounded_inside(path: &str, window: &SizedWindow, of_scene: f64, inward: usize) -> f64 {
    let is_lower = of_scene <= window.to && (of_scene < window.from || window.below.is_some());
    let end = if is_lower { window.from } else { window.to };
    let step = if path.ends_with("thickness_m") {
        THICKNESS_M
    } else {
        10_f64.powi(end.abs().max(f64::MIN_POSITIVE).log10().floor() as i32 + 1 - DIGITS)
    };
    let steps = end / step;
    // An end that is a multiple of the step but for its error is this multiple.
    let whole = if is_lower {
        (steps - 1e-6).ceil() + inward as f64
    } else {
        (steps + 1e-6).floor() - inward as f64
    };
    let value = rounded(whole * step, WRITTEN);
    if (window.from..=window.to).contains(&value) {
        value
    } else {
        rounded(0.5 * (window.from + window.to), WRITTEN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(from: f64, to: f64) -> SizedWindow {
        SizedWindow {
            from,
            to,
            below: Some("margin".to_owned()),
            above: None,
        }
    }

    #[test]
    fn values_are_rounded_towards_the_inside() {
        let thickness =
            |from, to, own| rounded_inside("blade.thickness_m", &window(from, to), own, 0);
        assert_eq!(thickness(2.362e-3, 3.2e-3, 2.2e-3), 2.4e-3);
        assert_eq!(thickness(2.4e-3, 3.2e-3, 2.2e-3), 2.4e-3);
        assert_eq!(thickness(1.0e-3, 3.17e-3, 4e-3), 3.1e-3);
        assert_eq!(thickness(2.31e-3, 2.37e-3, 2.2e-3), 2.34e-3);
        let speed = rounded_inside("operating_rpm", &window(0.0, 2236.9), 2400.0, 1);
        assert_eq!(speed, 2220.0);
    }
}
