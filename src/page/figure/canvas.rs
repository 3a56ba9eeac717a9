//! The sheet on which a figure is laid out: marks in figure units, with the origin at the upper left and
//! ordinates downwards. A figure unit is one pixel of the PNG.
//!
//! The same list of marks is rendered to PNG and SVG, and tests find in it whether two labels overlap.

use super::style::{Colour, PAPER, Weight, one_line, text_width};

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
        Self {
            colour,
            width,
            dash: None,
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

    /// Semi-bold, horizontal text that begins at its point, for titles.
    pub fn title(em: f64, colour: Colour) -> Self {
        Self {
            weight: Weight::SemiBold,
            ..Self::regular(em, colour, Anchor::Start)
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
    /// A square with sides of twice the length `half`.
    pub fn around([x, y]: [f64; 2], half: f64) -> Self {
        Frame {
            left: x - half,
            top: y - half,
            right: x + half,
            bottom: y + half,
        }
    }

    /// A frame of the same height between two abscissae.
    pub fn between(&self, [left, right]: [f64; 2]) -> Self {
        Frame {
            left,
            right,
            ..*self
        }
    }

    /// The frame, wider on both sides by the length `aside`.
    pub fn widened(&self, aside: f64) -> Self {
        self.between([self.left - aside, self.right + aside])
    }

    /// Ends of a horizontal axis along the frame, from left to right.
    pub fn across(&self) -> [f64; 2] {
        [self.left, self.right]
    }

    /// Ends of a vertical axis along the frame, from bottom to top.
    pub fn upwards(&self) -> [f64; 2] {
        [self.bottom, self.top]
    }

    /// Centre of the frame.
    pub fn centre(&self) -> [f64; 2] {
        [
            0.5 * (self.left + self.right),
            0.5 * (self.top + self.bottom),
        ]
    }

    /// Whether the interiors of two frames overlap.
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
        Self {
            width,
            height,
            marks: Vec::new(),
        }
    }

    /// Width and height in figure units.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The marks in drawing order.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// Draws a line; non-finite points are skipped, and a line of fewer than two points is not drawn.
    pub fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>, stroke: Stroke) {
        let points = self.limited_all(points);
        if points.len() >= 2 {
            self.marks.push(Mark::Line(points, stroke));
        }
    }

    /// Draws a vertical line over the height of a frame.
    pub fn vertical(&mut self, x: f64, frame: &Frame, stroke: Stroke) {
        self.line([[x, frame.top], [x, frame.bottom]], stroke);
    }

    /// Draws a horizontal line over the width of a frame.
    pub fn horizontal(&mut self, y: f64, frame: &Frame, stroke: Stroke) {
        self.line([[frame.left, y], [frame.right, y]], stroke);
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, frame: Frame, colour: Colour) {
        let corners = self
            .limited([frame.left, frame.top])
            .zip(self.limited([frame.right, frame.bottom]));
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
        let points = self.limited_all(points);
        if points.len() >= 3 {
            self.marks.push(Mark::Polygon(points, colour));
        }
    }

    /// Draws a filled circle.
    pub fn disc(&mut self, centre: [f64; 2], radius: f64, colour: Colour) {
        if let Some(centre) = self.limited(centre) {
            self.marks.push(Mark::Disc(centre, radius, colour));
        }
    }

    /// Draws a solid circle with the background inside; `radius` is that of the middle of the line.
    pub fn ring(&mut self, centre: [f64; 2], radius: f64, stroke: Stroke) {
        self.disc(centre, radius + stroke.width / 2.0, stroke.colour);
        self.disc(centre, radius - stroke.width / 2.0, PAPER);
    }

    /// Writes one line of text; its point lies on the baseline.
    pub fn text(&mut self, at: [f64; 2], lettering: Lettering, text: &str) {
        let text = one_line(text);
        if let (Some(at), false) = (self.limited(at), text.is_empty()) {
            self.marks.push(Mark::Text(at, lettering, text));
        }
    }

    /// Writes one line of text on a ground in the colour of the paper, which covers the lines drawn before.
    pub fn text_on_paper(&mut self, at: [f64; 2], lettering: Lettering, text: &str) {
        self.fill(text_frame(at, &lettering, text), PAPER);
        self.text(at, lettering, text);
    }

    fn limited_all(&self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
        points.into_iter().filter_map(|p| self.limited(p)).collect()
    }

    /// The point, limited to the vicinity of the sheet because renderers use integers; `None` if it is not
    /// finite.
    fn limited(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
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
