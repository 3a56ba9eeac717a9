//! The key below a figure, which explains its marks.

use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::style::{Colour, LABEL_SIZE, QUIET, label_width};

/// Space after each word.
const AFTER_WORD: f64 = 24.0;
/// Space between a mark and its word.
const AFTER_MARK: f64 = 8.0;

/// A line of marks and words, which is written from left to right.
pub struct Key<'a> {
    sheet: &'a mut Sheet,
    left: f64,
    baseline: f64,
}

impl<'a> Key<'a> {
    /// Begins a key at the left end of a baseline.
    pub fn new(sheet: &'a mut Sheet, left: f64, baseline: f64) -> Self {
        Key {
            sheet,
            left,
            baseline,
        }
    }

    /// Adds a mark of a given width. `draw` receives the left end of the mark, at half the height of the letters.
    pub fn mark(&mut self, width: f64, draw: impl FnOnce(&mut Sheet, [f64; 2])) -> &mut Self {
        draw(self.sheet, [self.left, self.baseline - 4.0]);
        self.left += width + AFTER_MARK;
        self
    }

    /// Adds a filled box, for the meaning of an area.
    pub fn shade(&mut self, colour: Colour) -> &mut Self {
        let width = 16.0;
        self.mark(width, |sheet, [x, y]| {
            let frame = Frame {
                left: x,
                top: y - 6.0,
                right: x + width,
                bottom: y + 6.0,
            };
            sheet.fill(frame, colour);
        })
    }

    /// Adds a horizontal line.
    pub fn line(&mut self, width: f64, stroke: Stroke) -> &mut Self {
        self.mark(width, |sheet, [x, y]| {
            sheet.line([[x, y], [x + width, y]], stroke)
        })
    }

    /// Adds a vertical line of twice the length `half` at the left end of a width.
    pub fn upright(&mut self, width: f64, half: f64, stroke: Stroke) -> &mut Self {
        self.mark(width, |sheet, [x, y]| {
            sheet.line([[x, y - half], [x, y + half]], stroke);
        })
    }

    /// Adds a dot in the middle of a width.
    pub fn dot(&mut self, width: f64, radius: f64, colour: Colour) -> &mut Self {
        self.mark(width, |sheet, [x, y]| {
            sheet.disc([x + 0.5 * width, y], radius, colour)
        })
    }

    /// Adds a ring in the middle of a width.
    pub fn ring(&mut self, width: f64, radius: f64, stroke: Stroke) -> &mut Self {
        self.mark(width, |sheet, [x, y]| {
            sheet.ring([x + 0.5 * width, y], radius, stroke);
        })
    }

    /// Adds a word, with or without a mark before it.
    pub fn word(&mut self, text: &str) -> &mut Self {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        self.sheet.text([self.left, self.baseline], letters, text);
        self.left += label_width(text) + AFTER_WORD;
        self
    }
}
