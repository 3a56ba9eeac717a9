//! Title and subtitle of a figure.

use super::canvas::{Anchor, Lettering, Sheet};
use super::style::{BETWEEN_FACTS, INK, MARGIN, QUIET, SUBTITLE_SIZE, TITLE_SIZE, Weight, shorten};

/// The subtitle of a figure whose title does not name the saw: its name, and whether it idles or is in its cut.
pub fn of_saw(name: &str, condition: &str) -> String {
    [condition, name].join(BETWEEN_FACTS)
}

/// Writes title and subtitle at the upper left, shortened to the width of the sheet.
pub fn draw(sheet: &mut Sheet, title: &str, subtitle: &str) {
    let room = f64::from(sheet.size()[0]) - 2.0 * MARGIN;
    let title = shorten(title, TITLE_SIZE, Weight::SemiBold, room);
    sheet.text([MARGIN, 38.0], Lettering::title(TITLE_SIZE, INK), &title);
    let letters = Lettering::regular(SUBTITLE_SIZE, QUIET, Anchor::Start);
    let subtitle = shorten(subtitle, SUBTITLE_SIZE, Weight::Regular, room);
    sheet.text([MARGIN, 61.0], letters, &subtitle);
}
