//! Draws the curves, dots and rings of a panel on a sheet.

use super::axis::Axis;
use super::canvas::{Frame, Sheet, Stroke};
use super::clipping::clip;
use super::items::{Item, Line, Points, Shape, Upright};
use super::style::{DASH, FINE_DASH, HAIRLINE, tint};

/// Width of the head of an arrow relative to that of its line.
const HEAD: f64 = 1.4;
/// Width of the edge of a ring relative to its diameter.
const EDGE: f64 = 0.2;

/// Number of points of a curve for each figure unit above which it is drawn by its extremes in each unit.
const DENSE: f64 = 4.0;

/// The lowest and the highest point of a curve in each column of a figure unit, in the order of the curve: many points with
/// the same pixel as abscissa look like a stroke from the lowest to the highest of them.
fn strokes(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let columns = places.chunk_by(|a, b| a[0].floor() == b[0].floor());
    let strokes = columns.flat_map(|column| {
        let by_height = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
        let low = (0..column.len()).min_by(by_height).unwrap_or(0);
        let high = (0..column.len()).max_by(by_height).unwrap_or(0);
        [low.min(high), low.max(high)].map(|k| column[k])
    });
    strokes.collect()
}

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
        let columns = self.frame.right - self.frame.left;
        if places.len() as f64 > DENSE * columns {
            clip(&strokes(&places), self.frame)
        } else {
            clip(&places, self.frame)
        }
    }

    /// Draws the curves.
    pub fn draw_lines(&self, sheet: &mut Sheet, items: &[Item]) {
        for item in items {
            if let Item::Line(line) = item {
                let stroke = stroke(line);
                for part in self.parts(line) {
                    sheet.line(part, stroke);
                }
                self.draw_single(sheet, line, stroke);
                if line.arrow {
                    self.draw_head(sheet, line, stroke);
                }
            }
        }
    }

    /// Draws a dot at a point of a curve without neighbours.
    fn draw_single(&self, sheet: &mut Sheet, line: &Line, stroke: Stroke) {
        let points: Vec<[f64; 2]> = line.x.iter().zip(&line.y).map(|(x, y)| [*x, *y]).collect();
        let is_gap = |point: &[f64; 2]| point.iter().any(|value| value.is_nan());
        for piece in points.split(is_gap) {
            if let [[x, y]] = piece
                && self.x.shows(*x)
                && self.y.shows(*y)
            {
                let radius = 0.5 * stroke.width + 0.6;
                sheet.disc([self.x.at(*x), self.y.at(*y)], radius, stroke.colour);
            }
        }
    }

    /// Draws the head of an arrow at the end of a vertical line, unless the line is short on the sheet.
    fn draw_head(&self, sheet: &mut Sheet, line: &Line, stroke: Stroke) {
        let place = |k: usize| [self.x.at(line.x[k]), self.y.at(line.y[k])];
        let last = line.x.len().saturating_sub(1);
        if last == 0 {
            return;
        }
        let ([_, from], [x, to]) = (place(last - 1), place(last));
        let back = 7.0_f64.copysign(from - to);
        if (from - to).abs() > 9.0 {
            for aside in [-4.0, 4.0] {
                let width = HEAD * stroke.width;
                sheet.line(
                    [[x + aside, to + back], [x, to]],
                    Stroke { width, ..stroke },
                );
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
        for (x, y) in points.x.iter().zip(&points.y) {
            if !(self.x.shows(*x) && self.y.shows(*y)) {
                continue;
            }
            draw_mark(sheet, [self.x.at(*x), self.y.at(*y)], points);
        }
    }
}

/// Draws a mark of some points.
pub fn draw_mark(sheet: &mut Sheet, at: [f64; 2], points: &Points) {
    let radius = points.size / 2.0;
    let colour = tint(points.colour.colour(), points.tint);
    let edge = Stroke::solid(colour, EDGE * points.size);
    match points.shape {
        Shape::Disc => sheet.disc(at, radius, colour),
        Shape::Ring => sheet.ring(at, radius, edge),
        Shape::Square => sheet.fill(Frame::around(at, radius), colour),
        Shape::Cross => {
            let [x, y] = at;
            for side in [-radius, radius] {
                sheet.line([[x - radius, y - side], [x + radius, y + side]], edge);
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

/// Style of a vertical line.
pub fn upright_stroke(line: &Upright) -> Stroke {
    if line.dashed {
        Stroke::dashed(line.colour.colour(), HAIRLINE, FINE_DASH)
    } else {
        Stroke::solid(line.colour.colour(), 1.5 * HAIRLINE)
    }
}
