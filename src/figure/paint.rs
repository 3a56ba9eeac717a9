//! Draws the curves, dots and rings of a panel on a sheet.

use super::axis::Axis;
use super::canvas::{Frame, Sheet, Stroke};
use super::chart_data::{Item, Line, Points};
use super::clip::clip;
use super::style::{DASH, FINE_DASH, HAIRLINE, tint};

/// Width of the edge of a ring relative to its diameter.
const EDGE: f64 = 0.2;

/// A panel on a sheet: axes and frame.
pub struct Ground<'a> {
    /// Horizontal axis of the panel.
    pub x: &'a Axis,
    /// Vertical axis of the panel.
    pub y: &'a Axis,
    /// Frame to which curves are clipped.
    pub frame: &'a Frame,
}

impl Ground<'_> {
    /// Draws the curves, and then the dots and rings.
    pub fn draw(&self, sheet: &mut Sheet, items: &[Item]) {
        self.draw_lines(sheet, items);
        self.draw_points(sheet, items);
    }

    /// The parts of a line inside the panel, on the sheet.
    pub fn parts(&self, line: &Line) -> Vec<Vec<[f64; 2]>> {
        let points = line.x.iter().zip(&line.y);
        let places: Vec<_> = points
            .map(|(x, y)| [self.x.at(*x), self.y.at(*y)])
            .collect();
        clip(&places, self.frame)
    }

    /// Draws the curves.
    pub fn draw_lines(&self, sheet: &mut Sheet, items: &[Item]) {
        for item in items {
            if let Item::Line(line) = item {
                let stroke = stroke(line);
                for part in self.parts(line) {
                    sheet.line(part, stroke);
                }
            }
        }
    }

    /// Draws the dots and rings whose centres are inside the panel.
    pub fn draw_points(&self, sheet: &mut Sheet, items: &[Item]) {
        for item in items {
            if let Item::Points(points) = item {
                self.draw_all(sheet, points);
            }
        }
    }

    fn draw_all(&self, sheet: &mut Sheet, points: &Points) {
        let radius = points.size / 2.0;
        let colour = tint(points.colour.colour(), points.tint);
        for (x, y) in points.x.iter().zip(&points.y) {
            if !(self.x.shows(*x) && self.y.shows(*y)) {
                continue;
            }
            let at = [self.x.at(*x), self.y.at(*y)];
            match points.hollow {
                true => sheet.ring(at, radius, Stroke::solid(colour, EDGE * points.size)),
                false => sheet.disc(at, radius, colour),
            }
        }
    }
}

/// Style of a curve; dashed lines no wider than a hairline have finer dashes.
pub fn stroke(line: &Line) -> Stroke {
    let dash = if line.width > HAIRLINE {
        DASH
    } else {
        FINE_DASH
    };
    Stroke {
        dash: line.dashed.then_some(dash),
        ..Stroke::solid(tint(line.colour.colour(), line.tint), line.width)
    }
}
