//! Panels in two columns, row by row.

use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::style::{ALARM, HAIRLINE, LABEL_SIZE, Weight, text_width};
use super::{axis::Axis, axis::Spread, heading};

/// Where the panels of a sheet are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns {
    /// Left edge of the panels of each column.
    pub lefts: [f64; 2],
    /// Upper edge of the first row.
    pub top: f64,
    /// Width of a panel beside another.
    pub width: f64,
    /// Width of a panel that is the only one.
    pub alone: f64,
    /// Height of a panel.
    pub height: f64,
    /// From the upper edge of a row to that of the next.
    pub row: f64,
}

/// Room below the last row.
const FOOT: f64 = 60.0;
/// Width of a sheet of two columns.
const WIDTH: f64 = 1200.0;

impl Columns {
    /// A sheet with room for so many panels, under a title.
    pub fn sheet(&self, panels: usize, title: &str, subtitle: &str) -> Sheet {
        let rows = panels.div_ceil(2).max(1);
        let beside = WIDTH - self.lefts[1] - self.width;
        let width = match panels {
            1 => self.lefts[0] + self.alone + beside,
            _ => WIDTH,
        };
        let mut sheet = Sheet::new(width as u32, (FOOT + self.row * rows as f64) as u32);
        heading::draw(&mut sheet, title, subtitle);
        sheet
    }

    /// The panel of an index, of so many.
    pub fn panel(&self, index: usize, panels: usize) -> Frame {
        let width = if panels == 1 { self.alone } else { self.width };
        let (left, top) = (
            self.lefts[index % 2],
            self.top + self.row * (index / 2) as f64,
        );
        Frame {
            left,
            top,
            right: left + width,
            bottom: top + self.height,
        }
    }
}

/// The name of a vertical axis, written beside the first column alone: the second shares it.
pub fn name_of_row(index: usize, name: &str) -> &str {
    if index.is_multiple_of(2) { name } else { "" }
}

/// An axis from the first of some values to the last.
pub fn axis_over(values: &[f64], places: [f64; 2]) -> Axis {
    let first = values.first().copied().unwrap_or(0.0);
    let last = values.last().copied().unwrap_or(1.0);
    Axis::new([first, last], places, Spread::Linear)
}

/// Marks the place in a record from which on a linear model knows no more than the rate of
/// growth.
pub fn draw_end_of_model(sheet: &mut Sheet, panel: &Frame, x: f64) {
    let line = [[x, panel.top], [x, panel.bottom]];
    sheet.line(line, Stroke::solid(ALARM, 1.5 * HAIRLINE));
}

/// Writes at that line what it is.
pub fn label_end_of_model(sheet: &mut Sheet, panel: &Frame, x: f64, text: &str) {
    let length = text_width(text, LABEL_SIZE, Weight::Regular) + 16.0;
    let (anchor, x) = match panel.right - x < length {
        true => (Anchor::End, x - 8.0),
        false => (Anchor::Start, x + 8.0),
    };
    let letters = Lettering::regular(LABEL_SIZE, ALARM, anchor);
    sheet.text([x, panel.bottom - 10.0], letters, text);
}
