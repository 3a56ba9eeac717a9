//! The key below a figure, which explains its marks.

use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::heat::rgb;
use super::items::Item;
use super::paint::{draw_mark, stroke};
use super::panel::upright_stroke;
use super::style::{Colour, LABEL_SIZE, PAPER, QUIET, label_width, shorten_label, tint};

/// Space after each word.
const AFTER_WORD: f64 = 24.0;
/// Space between a mark and its word.
const AFTER_MARK: f64 = 8.0;

/// Height of a line.
const LINE: f64 = 26.0;
/// Space below the last line.
const BELOW: f64 = 12.0;
/// Length of the sample of a line, and its largest width.
const SAMPLE: f64 = 24.0;
const THICKEST: f64 = 12.0;

/// Word of a sample, and width of its mark.
fn measure(sample: &Item) -> (&str, f64) {
    match sample {
        Item::Line(line) => (&line.name, SAMPLE),
        Item::Points(points) => (&points.name, points.size),
        Item::Upright(upright) => (&upright.name, 2.0),
        Item::Area(area) => (&area.name, 16.0),
        Item::Band(band) => (&band.name, 16.0),
        Item::Heat(heat) => (&heat.name, 16.0),
        Item::Bars(bars) => (&bars.name, 16.0),
        Item::Label(label) => (&label.text, 0.0),
    }
}

/// The samples of each line of a key.
fn lines(samples: &[Item], width: f64) -> Vec<&[Item]> {
    let mut room = 0.0;
    let begins = |sample: &Item| {
        let (word, mark) = measure(sample);
        let needed = mark + AFTER_MARK + label_width(word);
        let begins = needed > room;
        room = if begins { width } else { room } - needed - AFTER_WORD;
        begins
    };
    let is_first: Vec<bool> = samples.iter().map(begins).collect();
    let starts = (0..samples.len()).filter(|k| is_first[*k]);
    let ends = starts.clone().skip(1).chain([samples.len()]);
    starts
        .zip(ends)
        .map(|(from, to)| &samples[from..to])
        .collect()
}

/// Height of the key of a chart.
pub fn height(samples: &[Item], width: f64) -> f64 {
    LINE * lines(samples, width).len() as f64 + BELOW
}

/// Draws the key of a chart below an upper left corner.
pub fn draw(sheet: &mut Sheet, samples: &[Item], [left, top]: [f64; 2], width: f64) {
    for (row, line) in lines(samples, width).into_iter().enumerate() {
        let mut key = Key::new(sheet, left, top + LINE * row as f64 + 14.0);
        for sample in line {
            match sample {
                Item::Line(line) => {
                    let stroke = stroke(line);
                    let width = stroke.width.min(THICKEST);
                    key.line(SAMPLE, Stroke { width, ..stroke })
                }
                Item::Points(points) => key.mark(points.size, |sheet, [x, y]| {
                    draw_mark(sheet, [x + 0.5 * points.size, y], points);
                }),
                Item::Upright(line) => key.upright(2.0, 7.0, upright_stroke(line)),
                Item::Area(area) => key.shade(tint(area.colour.colour(), area.tint)),
                Item::Band(band) => key.shade(band.shade.colour()),
                Item::Heat(heat) => key.shade(heat.colours.first().map_or(PAPER, |c| rgb(*c))),
                Item::Bars(bars) => key.shade(tint(bars.colour.colour(), bars.tint)),
                Item::Label(_) => &mut key,
            };
            let (word, mark) = measure(sample);
            key.word(&shorten_label(word, width - mark - AFTER_MARK));
        }
    }
}

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

    /// Adds a word, with or without a mark before it.
    pub fn word(&mut self, text: &str) -> &mut Self {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        self.sheet.text([self.left, self.baseline], letters, text);
        self.left += label_width(text) + AFTER_WORD;
        self
    }
}
