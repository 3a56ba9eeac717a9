//! Layout of panels in two columns, row by row.

use super::canvas::{Frame, Sheet};
use super::heading;

/// Positions of the panels of a sheet, in figure units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns {
    /// Left edges of the panels of the two columns.
    pub lefts: [f64; 2],
    /// Upper edge of the first row.
    pub top: f64,
    /// Width of a panel on a sheet with several panels.
    pub width: f64,
    /// Width of the panel on a sheet with a single panel.
    pub alone: f64,
    /// Height of each panel.
    pub height: f64,
    /// Distance of the upper edges of successive rows.
    pub row: f64,
}

/// Height below the last row.
const FOOT: f64 = 60.0;
/// Width of a sheet with two columns.
const WIDTH: f64 = 1200.0;

impl Columns {
    /// A sheet for a number of panels, with title and subtitle.
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

    /// The frame of the panel with the number `index`, from 0 on, of `panels` in all.
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

/// The name of the vertical axis of the panel with the number `index`; it is empty in the second column, whose
/// axis is that of the first.
pub fn name_of_row(index: usize, name: &str) -> &str {
    if index.is_multiple_of(2) { name } else { "" }
}
