//! The sheet on which a figure is laid out: marks in figure units, with the origin at the upper left and
//! ordinates downwards. A figure unit is one pixel of the PNG.
//!
//! The same list of marks is rendered to PNG and SVG, and tests find in it whether two labels overlap.

use super::style::{Colour, Weight, one_line, text_width};

/// Position of a text relative to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins at its point.
    Start,
    /// The text is centred at its point.
    Middle,
    /// The text ends at its point.
    End,
}

/// Style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Colour of the line or of its dashes.
    pub colour: Colour,
    /// Width in figure units.
    pub width: f64,
    /// Lengths of dash and gap in figure units; `None` for a solid line.
    pub dash: Option<[f64; 2]>,
}

impl Stroke {
    /// A solid line.
    pub fn solid(colour: Colour, width: f64) -> Self {
        let dash = None;
        Self {
            colour,
            width,
            dash,
        }
    }

    /// A dashed line.
    pub fn dashed(colour: Colour, width: f64, dash: [f64; 2]) -> Self {
        Self {
            dash: Some(dash),
            ..Self::solid(colour, width)
        }
    }
}

/// Style of a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lettering {
    /// Size of the font: height of an em, in figure units.
    pub em: f64,
    /// Weight of the font.
    pub weight: Weight,
    /// Colour of the letters.
    pub colour: Colour,
    /// Position of the text relative to its point.
    pub anchor: Anchor,
    /// Whether the text is rotated and reads from below to above.
    pub upright: bool,
}

impl Lettering {
    /// Regular, horizontal text.
    pub fn regular(em: f64, colour: Colour, anchor: Anchor) -> Self {
        Self {
            em,
            weight: Weight::Regular,
            colour,
            anchor,
            upright: false,
        }
    }
}

/// A rectangle in figure units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Abscissa of the left edge.
    pub left: f64,
    /// Ordinate of the upper edge.
    pub top: f64,
    /// Abscissa of the right edge.
    pub right: f64,
    /// Ordinate of the lower edge.
    pub bottom: f64,
}

impl Frame {
    /// Whether two frames have a point in common.
    pub fn overlaps(&self, other: &Frame) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }
}

/// An element of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A line through points.
    Line(Vec<[f64; 2]>, Stroke),
    /// A filled rectangle.
    Fill(Frame, Colour),
    /// A filled polygon.
    Polygon(Vec<[f64; 2]>, Colour),
    /// A filled circle: centre and radius.
    Disc([f64; 2], f64, Colour),
    /// A line of text; its point lies on the baseline.
    Text([f64; 2], Lettering, String),
}

/// A list of marks in drawing order.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    width: u32,
    height: u32,
    marks: Vec<Mark>,
}

impl Sheet {
    /// An empty sheet.
    pub fn new(width: u32, height: u32) -> Self {
        let marks = Vec::new();
        Self {
            width,
            height,
            marks,
        }
    }

    /// Width and height in figure units.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The marks in drawing order.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// Draws a line; non-finite points are skipped, and a line of fewer than two points is not drawn.
    pub fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>, stroke: Stroke) {
        let points: Vec<_> = points.into_iter().filter_map(|p| self.held(p)).collect();
        if points.len() >= 2 {
            self.marks.push(Mark::Line(points, stroke));
        }
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, frame: Frame, colour: Colour) {
        let corners = self
            .held([frame.left, frame.top])
            .zip(self.held([frame.right, frame.bottom]));
        if let Some(([left, top], [right, bottom])) = corners {
            let frame = Frame {
                left,
                top,
                right,
                bottom,
            };
            self.marks.push(Mark::Fill(frame, colour));
        }
    }

    /// Fills a polygon; non-finite points are skipped, and a polygon of fewer than three corners is not drawn.
    pub fn polygon(&mut self, points: impl IntoIterator<Item = [f64; 2]>, colour: Colour) {
        let points: Vec<_> = points.into_iter().filter_map(|p| self.held(p)).collect();
        if points.len() >= 3 {
            self.marks.push(Mark::Polygon(points, colour));
        }
    }

    /// Draws a filled circle.
    pub fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Colour) {
        if let Some(centre) = self.held(centre) {
            self.marks.push(Mark::Disc(centre, radius, colour));
        }
    }

    /// Draws a circle filled with `inside`.
    pub fn ring(&mut self, centre: [f64; 2], radius: f64, stroke: Stroke, inside: Colour) {
        self.disc(centre, radius + stroke.width / 2.0, stroke.colour);
        self.disc(centre, radius - stroke.width / 2.0, inside);
    }

    /// Writes one line of text; its point lies on the baseline.
    pub fn text(&mut self, at: [f64; 2], lettering: Lettering, text: &str) {
        let text = one_line(text);
        if let (Some(at), false) = (self.held(at), text.is_empty()) {
            self.marks.push(Mark::Text(at, lettering, text));
        }
    }

    /// The point, limited to the vicinity of the sheet because renderers use integers.
    fn held(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        (x.is_finite() && y.is_finite())
            .then(|| [x.clamp(-width, 2.0 * width), y.clamp(-height, 2.0 * height)])
    }
}

/// The frame of a text, including ascenders and descenders.
pub fn text_frame([x, y]: [f64; 2], lettering: &Lettering, text: &str) -> Frame {
    let length = text_width(text, lettering.em, lettering.weight);
    let before = match lettering.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => length / 2.0,
        Anchor::End => length,
    };
    let (ascent, descent) = (0.76 * lettering.em, 0.22 * lettering.em);
    if lettering.upright {
        let bottom = y + before;
        let (left, right) = (x - ascent, x + descent);
        return Frame {
            left,
            top: bottom - length,
            right,
            bottom,
        };
    }
    let left = x - before;
    let (top, bottom) = (y - ascent, y + descent);
    Frame {
        left,
        top,
        right: left + length,
        bottom,
    }
}
