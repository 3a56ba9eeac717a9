//! Bands of instability as shades behind a panel.

use super::axis::Axis;
use super::canvas::{Frame, Sheet};
use super::style::{Colour, DIVERGENCE_SHADE, DIVERGENCE_STREAK, FLUTTER_SHADE, FLUTTER_STREAK};
use crate::report::{InstabilityEntry, InstabilityKind};

/// Narrower bands get a stronger colour, and at least `STREAK_WIDTH`.
pub const NARROW: f64 = 4.0;
const STREAK_WIDTH: f64 = 1.5;

fn colour(kind: InstabilityKind, narrow: bool) -> Colour {
    match (kind, narrow) {
        (InstabilityKind::Divergence, false) => DIVERGENCE_SHADE,
        (InstabilityKind::Divergence, true) => DIVERGENCE_STREAK,
        (InstabilityKind::Flutter, false) => FLUTTER_SHADE,
        (InstabilityKind::Flutter, true) => FLUTTER_STREAK,
    }
}

/// Left and right edge of a band on the sheet, or `None` off the axis.
pub fn places(speed: &Axis, band: &InstabilityEntry) -> Option<[f64; 2]> {
    let [first, last] = speed.values();
    let (from, to) = (band.from_rpm.max(first), band.to_rpm.min(last));
    if band.from_rpm.is_nan() || band.to_rpm.is_nan() || from > to {
        return None;
    }
    let [left, right] = [from, to].map(|rpm| speed.at(rpm));
    let missing = (STREAK_WIDTH - (right - left)).max(0.0);
    Some([left - missing / 2.0, right + missing / 2.0])
}

/// Shades the bands over the height of each panel.
pub fn shade<'a>(
    sheet: &mut Sheet,
    speed: &Axis,
    bands: impl Iterator<Item = &'a InstabilityEntry> + Clone,
    panels: &[Frame],
) {
    // Streaks last: a wide band must not hide a narrow one within it.
    for narrow in [false, true] {
        for band in bands.clone() {
            let Some([left, right]) = places(speed, band) else {
                continue;
            };
            if (right - left < NARROW) != narrow {
                continue;
            }
            for panel in panels {
                let stripe = Frame {
                    left,
                    right,
                    ..*panel
                };
                sheet.fill(stripe, colour(band.kind, narrow));
            }
        }
    }
}
