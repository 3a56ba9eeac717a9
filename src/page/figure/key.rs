//! The key below a figure, which explains its marks.

use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::heat::rgb;
use super::items::{Area, Item, Line, Points, Shape};
use super::painting::{draw_mark, stroke, upright_stroke};
use super::palette::Hue;
use super::style::{LABEL_SIZE, PAPER, QUIET, label_width, shorten_label, tint};

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

impl Item {
    /// A sample of a line for the key.
    pub(crate) fn line_sample(width: f64, dashed: bool, colour: Hue, name: &str) -> Self {
        Item::Line(Line {
            width,
            dashed,
            ..Line::new([], colour, name)
        })
    }

    /// A sample of marks for the key.
    pub(crate) fn points_sample(size: f64, shape: Shape, colour: Hue, name: &str) -> Self {
        Item::Points(Points {
            shape,
            ..Points::new([], colour, size, name)
        })
    }

    /// A sample of an area for the key.
    pub(crate) fn area_sample(colour: Hue, name: &str) -> Self {
        Item::tinted_sample(colour, 1.0, name)
    }

    /// A sample of an area in a mixture of a colour with that of the paper, for the key.
    pub(crate) fn tinted_sample(colour: Hue, tint: f64, name: &str) -> Self {
        Item::Area(Area {
            tint,
            ..Area::new([], colour, name)
        })
    }

    /// A sample of the item for the key: the item without its points.
    pub(crate) fn sample(&self) -> Self {
        let mut sample = self.clone();
        match &mut sample {
            Item::Line(line) => (line.x, line.y) = (Vec::new(), Vec::new()),
            Item::Points(points) => (points.x, points.y) = (Vec::new(), Vec::new()),
            Item::Area(area) => (area.x, area.low, area.high) = Default::default(),
            Item::Heat(heat) => (heat.x, heat.y, heat.z) = Default::default(),
            Item::Bars(bars) => (bars.edges, bars.heights) = Default::default(),
            Item::Band(_) | Item::Upright(_) | Item::Label(_) => {}
        }
        sample
    }
}

/// Word of a sample, and width of its mark.
struct Measured<'a> {
    word: &'a str,
    mark: f64,
}

fn measure(sample: &Item) -> Measured<'_> {
    let (word, mark) = match sample {
        Item::Line(line) => (&line.name, SAMPLE),
        Item::Points(points) => (&points.name, points.size),
        Item::Upright(upright) => (&upright.name, 2.0),
        Item::Area(area) => (&area.name, 16.0),
        Item::Band(band) => (&band.name, 16.0),
        Item::Heat(heat) => (&heat.name, 16.0),
        Item::Bars(bars) => (&bars.name, 16.0),
        Item::Label(label) => (&label.text, 0.0),
    };
    Measured { word, mark }
}

/// The samples of each line of a key.
fn lines(samples: &[Item], width: f64) -> Vec<&[Item]> {
    let mut room = 0.0;
    let begins = |sample: &Item| {
        let Measured { word, mark } = measure(sample);
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
        let baseline = top + LINE * row as f64 + 14.0;
        let mut x = left;
        for sample in line {
            let Measured { word: name, mark } = measure(sample);
            draw_sample(sheet, sample, [x, baseline - 4.0]);
            let word = shorten_label(name, width - mark - AFTER_MARK);
            let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
            sheet.text([x + mark + AFTER_MARK, baseline], letters, &word);
            x += mark + AFTER_MARK + label_width(&word) + AFTER_WORD;
        }
    }
}

/// Draws a mark with its left end at a point, at half the height of the letters.
fn draw_sample(sheet: &mut Sheet, sample: &Item, [x, y]: [f64; 2]) {
    let box_of = |colour| (Frame::around([x + 8.0, y], 8.0), colour);
    let (across, colour) = match sample {
        Item::Line(line) => {
            let stroke = stroke(line);
            let width = stroke.width.min(THICKEST);
            return sheet.line([[x, y], [x + SAMPLE, y]], Stroke { width, ..stroke });
        }
        Item::Points(points) => {
            return draw_mark(sheet, [x + 0.5 * points.size, y], points);
        }
        Item::Upright(line) => {
            return sheet.line([[x, y - 7.0], [x, y + 7.0]], upright_stroke(line));
        }
        Item::Label(_) => return,
        Item::Area(area) => box_of(tint(area.colour.colour(), area.tint)),
        Item::Band(band) => box_of(band.shade.colour()),
        Item::Heat(heat) => box_of(heat.colours.first().map_or(PAPER, |c| rgb(*c))),
        Item::Bars(bars) => box_of(tint(bars.colour.colour(), bars.tint)),
    };
    let frame = Frame {
        top: y - 6.0,
        bottom: y + 6.0,
        ..across
    };
    sheet.fill(frame, colour);
}
