//! Colours, sizes and fonts of all figures.

use plotters::style::RGBColor;

pub use super::letters::{Weight, text_width};

/// A colour: red, green and blue from 0 to 255.
pub type Colour = RGBColor;

/// Background of a figure.
pub const PAPER: Colour = RGBColor(255, 255, 255);
/// Colour of titles, of the zero line and of important text.
pub const INK: Colour = RGBColor(32, 36, 42);
/// Colour of axis lines, of dashed guide lines and of numbers at the ticks.
pub const QUIET: Colour = RGBColor(105, 111, 120);
/// Colour of grid lines.
pub const GRID: Colour = RGBColor(233, 235, 238);
/// Colour of saws without a result in maps.
pub const BLANK: Colour = RGBColor(214, 216, 220);

// Blue and red, and violet and amber, are distinguishable with the common kinds of colour blindness; each
// pair also differs in lightness.
/// Colour of waves that run with the rotation.
pub const FORWARD: Colour = RGBColor(31, 95, 168);
/// Colour of waves that run against the rotation.
pub const BACKWARD: Colour = RGBColor(192, 69, 45);
/// Colour of waves without direction.
pub const STANDING: Colour = RGBColor(118, 124, 133);
/// Colour of lines and letters for growth without oscillation.
pub const DIVERGENCE: Colour = RGBColor(104, 71, 153);
/// Colour of lines and letters for growing oscillation.
pub const FLUTTER: Colour = RGBColor(163, 98, 0);

/// Colour of broken limits and of the ends of models.
pub const ALARM: Colour = RGBColor(200, 16, 46);

/// Colour of areas of divergence.
pub const DIVERGENCE_SHADE: Colour = RGBColor(226, 217, 241);
/// Colour of areas of flutter.
pub const FLUTTER_SHADE: Colour = RGBColor(255, 229, 173);
/// Stronger colour of areas of divergence, for bands so narrow that their shade would not be visible.
pub const DIVERGENCE_STREAK: Colour = RGBColor(158, 132, 203);
/// Stronger colour of areas of flutter, for bands so narrow that their shade would not be visible.
pub const FLUTTER_STREAK: Colour = RGBColor(240, 178, 62);

/// Space at the edges of a figure, in figure units.
pub const MARGIN: f64 = 28.0;
/// Separator of facts, with wide spaces, because SVG collapses ordinary ones.
pub const BETWEEN_FACTS: &str = "\u{2002}·\u{2002}";

/// Size of the title: height of an em, in figure units, as of the following sizes.
pub const TITLE_SIZE: f64 = 20.0;
/// Size of the line below the title.
pub const SUBTITLE_SIZE: f64 = 13.0;
/// Size of axis names and of the numbers at the ticks.
pub const AXIS_SIZE: f64 = 13.0;
/// Size of labels within the plot and of notes below it.
pub const LABEL_SIZE: f64 = 12.0;

/// Width of thin straight lines, in figure units, as of the following widths.
pub const HAIRLINE: f64 = 1.0;
/// Width of curves.
pub const CURVE: f64 = 1.6;
/// Width of the most important parts of a curve.
pub const STRONG_CURVE: f64 = 3.4;
/// Lengths of dash and gap of curves, in figure units.
pub const DASH: [f64; 2] = [6.0, 4.0];
/// Lengths of dash and gap of guide lines, in figure units.
pub const FINE_DASH: [f64; 2] = [4.0, 4.0];

/// Diameter of the rings at measured frequencies.
pub const MEASURED_SIZE: f64 = 6.0;

/// Width of a label in figure units.
pub fn label_width(label: &str) -> f64 {
    text_width(label, LABEL_SIZE, Weight::Regular)
}

/// A label on one line, truncated with an ellipsis if it is wider than `room`.
pub fn shorten_label(label: &str, room: f64) -> String {
    shorten(label, LABEL_SIZE, Weight::Regular, room)
}

/// Mixes a colour with white; `share` is the share of the colour, from 0 to 1.
pub fn tint(colour: Colour, share: f64) -> Colour {
    let mix = |channel: u8| (255.0 - share * (255.0 - f64::from(channel))).round() as u8;
    RGBColor(mix(colour.0), mix(colour.1), mix(colour.2))
}

/// The lines of a label that is broken at ordinary spaces where it would be wider than `room`.
pub fn broken(label: &str, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in label.split(' ') {
        let longer = |line: &String| format!("{line} {word}");
        let fits = |line: &&mut String| label_width(&longer(line)) <= room;
        match lines.last_mut().filter(fits) {
            Some(line) => *line = longer(line),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The text on one line, truncated with an ellipsis if it is wider than `room`.
pub fn shorten(text: &str, em: f64, weight: Weight, room: f64) -> String {
    let line = one_line(text);
    if text_width(&line, em, weight) <= room {
        return line;
    }
    let letters: Vec<char> = line.chars().collect();
    let cut = |kept: usize| {
        let start: String = letters[..kept].iter().collect();
        format!("{}…", start.trim_end())
    };
    let (mut fits, mut too_long) = (0, letters.len());
    while too_long - fits > 1 {
        let middle = (fits + too_long) / 2;
        if text_width(&cut(middle), em, weight) <= room {
            fits = middle;
        } else {
            too_long = middle;
        }
    }
    cut(fits)
}

/// Replaces control characters, which SVG does not allow, and line breaks, which it ignores, by spaces.
pub fn one_line(text: &str) -> String {
    text.chars()
        .map(|c| if is_printable(c) { c } else { ' ' })
        .collect()
}

fn is_printable(c: char) -> bool {
    !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_text_is_cut_to_the_room() {
        let long = "Säge ".repeat(100);
        let short = shorten(&long, TITLE_SIZE, Weight::SemiBold, 300.0);
        assert!(short.ends_with('…'));
        let width = text_width(&short, TITLE_SIZE, Weight::SemiBold);
        assert!(width > 250.0 && width <= 300.0, "{width}");
    }

    #[test]
    fn text_stays_on_one_line() {
        assert_eq!(shorten_label("a\n\u{0}b", 100.0), "a  b");
        assert_eq!(shorten_label("wide", 0.0), "…");
    }
}
