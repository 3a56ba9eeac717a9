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

/// Wider bands than this share of the axis that do not count have no shade.
const WIDEST_WEAK: f64 = 0.03;

/// Whether any of a band is shaded on an axis of these speeds.
pub fn is_shaded([first, last]: [f64; 2], band: &InstabilityEntry) -> bool {
    let is_wide = band.to_rpm - band.from_rpm > WIDEST_WEAK * (last - first);
    !(is_wide && band.counted_rpm.is_empty())
}

/// The stretches of a band that are shaded: where it counts. One that does not is shaded as a
/// whole, unless it grows weakly over a wide range, as damping alone makes it.
fn stretches(speed: &Axis, band: &InstabilityEntry) -> Vec<InstabilityEntry> {
    let stretch = |[from_rpm, to_rpm]: [f64; 2]| InstabilityEntry {
        from_rpm,
        to_rpm,
        ..band.clone()
    };
    if !is_shaded(speed.values(), band) {
        return Vec::new();
    }
    match band.counted_rpm.is_empty() {
        true => vec![band.clone()],
        false => band.counted_rpm.iter().copied().map(stretch).collect(),
    }
}

/// Shades the bands over the height of each panel.
pub fn shade<'a>(
    sheet: &mut Sheet,
    speed: &Axis,
    bands: impl Iterator<Item = &'a InstabilityEntry>,
    panels: &[Frame],
) {
    let stretches: Vec<InstabilityEntry> = bands.flat_map(|band| stretches(speed, band)).collect();
    // Streaks last: a wide band must not hide a narrow one within it.
    for narrow in [false, true] {
        for band in &stretches {
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
