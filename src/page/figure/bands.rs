//! Bands of instability as shaded areas behind the curves of a panel.

use super::axis::Axis;
use super::canvas::{Frame, Sheet};
use super::items::Band;

/// Bands narrower than this, in figure units, are drawn in a stronger colour.
pub const NARROW: f64 = 4.0;
/// Smallest width of a band on the sheet, in figure units.
const STREAK_WIDTH: f64 = 1.5;

/// Left and right edge of a range of speeds in rpm on the sheet, at least 1.5 apart; `None` if no part of the range
/// is on the axis.
pub fn places(speed: &Axis, range: [f64; 2]) -> Option<[f64; 2]> {
    let [first, last] = speed.values();
    let (from, to) = (range[0].max(first), range[1].min(last));
    if range[0].is_nan() || range[1].is_nan() || from > to {
        return None;
    }
    let [left, right] = [from, to].map(|rpm| speed.at(rpm));
    let missing = (STREAK_WIDTH - (right - left)).max(0.0);
    Some([left - missing / 2.0, right + missing / 2.0])
}

/// Shades bands over the height of each panel.
pub fn draw<'a>(
    sheet: &mut Sheet,
    speed: &Axis,
    bands: impl Iterator<Item = &'a Band> + Clone,
    panels: &[Frame],
) {
    // Narrow bands are drawn last, so that no wide one hides them.
    for narrow in [false, true] {
        let shaded = bands.clone().flat_map(|band| {
            let hue = if narrow { band.streak } else { band.shade };
            band.shaded.iter().map(move |range| (range, hue))
        });
        for (range, hue) in shaded {
            let ends =
                places(speed, *range).filter(|[left, right]| (right - left < NARROW) == narrow);
            if let Some(ends) = ends {
                for panel in panels {
                    sheet.fill(panel.between(ends), hue.colour());
                }
            }
        }
    }
}
