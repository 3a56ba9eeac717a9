//! Requirements on all figures, which tests check wherever a sheet is drawn.

use super::canvas::{Frame, Mark, Sheet, text_frame};
#[cfg(test)]
use super::style::PAPER;

/// The sheet; in tests every text must be inside it and overlap no other.
pub fn tidy(sheet: Sheet) -> Sheet {
    if cfg!(test) {
        assert_tidy(&sheet);
    }
    sheet
}

fn assert_tidy(sheet: &Sheet) {
    let [width, height] = sheet.size();
    let framed = |mark: &Mark| match mark {
        Mark::Text(at, letters, text) => Some((text_frame(*at, letters, text), text.clone())),
        _ => None,
    };
    let texts: Vec<(Frame, String)> = sheet.marks().iter().filter_map(framed).collect();
    for (i, (frame, text)) in texts.iter().enumerate() {
        let inside = frame.left >= 0.0
            && frame.top >= 0.0
            && frame.right <= f64::from(width)
            && frame.bottom <= f64::from(height);
        assert!(inside, "'{text}' is cut off: {frame:?}");
        for (other, second) in &texts[..i] {
            assert!(!frame.overlaps(other), "'{text}' lies on '{second}'");
        }
    }
}

/// Requires that no vertical line crosses a text, unless a white ground covers the line there.
#[cfg(test)]
pub fn assert_unstruck(sheet: &Sheet) {
    let marks = sheet.marks();
    for (above, mark) in marks.iter().enumerate() {
        let Mark::Text(at, letters, text) = mark else {
            continue;
        };
        let frame = text_frame(*at, letters, text);
        for (below, line) in marks.iter().enumerate() {
            let Some([x, top, bottom]) = upright(line) else {
                continue;
            };
            let crosses = frame.left + 1.0 < x && x < frame.right - 1.0;
            if !crosses || bottom < frame.top + 2.0 || frame.bottom - 2.0 < top {
                continue;
            }
            let is_paper = |mark: &Mark| match mark {
                Mark::Fill(paper, colour) => {
                    let across = paper.left <= x && x <= paper.right;
                    let upwards = paper.top < frame.top + 1.0 && frame.bottom - 1.0 < paper.bottom;
                    *colour == PAPER && across && upwards
                }
                _ => false,
            };
            let papered = below < above && marks[below..above].iter().any(is_paper);
            assert!(
                papered,
                "'{text}' at {frame:?} is struck through by {line:?}"
            );
        }
    }
}

/// Abscissa, upper and lower end of a vertical line between two points.
#[cfg(test)]
fn upright(mark: &Mark) -> Option<[f64; 3]> {
    match mark {
        Mark::Line(points, _) => match points[..] {
            [[x, a], [other, b]] if x == other => Some([x, a.min(b), a.max(b)]),
            _ => None,
        },
        _ => None,
    }
}

/// Texts of a sheet.
#[cfg(test)]
pub fn texts(sheet: &Sheet) -> Vec<&str> {
    let texts = sheet.marks().iter().filter_map(|mark| match mark {
        Mark::Text(.., text) => Some(text.as_str()),
        _ => None,
    });
    texts.collect()
}
