//! Lines, ticks and names of axes on a sheet.

use super::axis::Axis;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::style::{AXIS_SIZE, GRID, HAIRLINE, INK, QUIET, Weight, text_width};

/// Draws grid lines, ticks, numbers and name of a vertical axis.
pub fn draw_vertical(sheet: &mut Sheet, axis: &Axis, panel: &Frame, name: &str) {
    draw_vertical_at(sheet, axis, panel, &axis.ticks(axis.apart()));
    name_upright(sheet, 28.0, panel, name);
}

/// Draws grid lines, ticks and numbers of a vertical axis at given values.
pub fn draw_vertical_at(sheet: &mut Sheet, axis: &Axis, panel: &Frame, ticks: &[f64]) {
    for tick in ticks {
        let y = axis.at(*tick);
        sheet.horizontal(y, panel, Stroke::solid(GRID, HAIRLINE));
        let short = Stroke::solid(QUIET, HAIRLINE);
        sheet.line([[panel.left - 5.0, y], [panel.left, y]], short);
        number_beside(sheet, panel, y, &axis.label(*tick));
    }
}

/// Writes a number to the left of a panel, at the height of a tick.
pub fn number_beside(sheet: &mut Sheet, panel: &Frame, y: f64, number: &str) {
    let letters = Lettering::regular(AXIS_SIZE, QUIET, Anchor::End);
    let at = [panel.left - 9.0, y + 0.36 * AXIS_SIZE];
    sheet.text(at, letters, number);
}

/// Writes the name of a vertical axis, reading upwards, at the middle of the height of its panel.
pub fn name_upright(sheet: &mut Sheet, x: f64, panel: &Frame, name: &str) {
    let letters = Lettering {
        upright: true,
        ..Lettering::regular(AXIS_SIZE, INK, Anchor::Middle)
    };
    sheet.text([x, panel.centre()[1]], letters, name);
}

/// Draws line and ticks of a horizontal axis, with numbers if `numbered`.
pub fn draw_horizontal(sheet: &mut Sheet, axis: &Axis, y: f64, numbered: bool) {
    let [left, right] = axis.places();
    // A short axis has ticks closer to each other.
    let apart = ((right - left) / 6.0).min(100.0);
    let ticks = axis
        .ticks(apart)
        .into_iter()
        .map(|tick| (tick, axis.label(tick)));
    draw_horizontal_at(sheet, axis, y, ticks, numbered);
}

/// Draws line and ticks of a horizontal axis, with the name of each tick if `named` and if it has room beside the one
/// before.
pub fn draw_horizontal_at<T: AsRef<str>>(
    sheet: &mut Sheet,
    axis: &Axis,
    y: f64,
    ticks: impl IntoIterator<Item = (f64, T)>,
    named: bool,
) {
    let [left, right] = axis.places();
    sheet.line([[left, y], [right, y]], Stroke::solid(QUIET, HAIRLINE));
    let mut free = f64::NEG_INFINITY;
    for (tick, name) in ticks {
        let x = axis.at(tick);
        sheet.line([[x, y], [x, y + 5.0]], Stroke::solid(QUIET, HAIRLINE));
        let half = 0.5 * text_width(name.as_ref(), AXIS_SIZE, Weight::Regular);
        if named && x - half > free {
            let letters = Lettering::regular(AXIS_SIZE, QUIET, Anchor::Middle);
            sheet.text([x, y + 20.0], letters, name.as_ref());
            free = x + half + 6.0;
        }
    }
}

/// Writes the name of a horizontal axis centred between its ends, on a baseline.
pub fn name_below(sheet: &mut Sheet, [left, right]: [f64; 2], baseline: f64, name: &str) {
    let letters = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    sheet.text([0.5 * (left + right), baseline], letters, name);
}
