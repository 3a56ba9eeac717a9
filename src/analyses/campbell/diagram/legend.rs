//! The lines below the figure that explain colours and styles, and state which contents have no label.

use super::band_labels::BandLabels;
use super::contents::WINDOW;
use super::growth;
use super::plan::{Chart, HEIGHT, LEGEND_ABOVE_FOOT, NOTES_ABOVE_FOOT, PLOT_LEFT, WIDTH};
use super::view::left_out;
use super::waves::measured_source;
use crate::page::figure::canvas::{Anchor, Lettering, Sheet};
use crate::page::figure::items::{Item, Line, Shape};
use crate::page::figure::key;
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{
    BETWEEN_FACTS, CURVE, LABEL_SIZE, MARGIN, MEASURED_SIZE, QUIET, shorten_label,
};

/// Largest width of the source of measured frequencies, which leaves all samples on one line.
const LONGEST_SOURCE: f64 = 215.0;

/// Writes the legend of the colours and styles that the figure contains, and a line of notes.
pub fn draw(sheet: &mut Sheet, chart: &Chart, labels: &BandLabels) {
    let ground = chart.upper_ground();
    let branches = chart.lines().filter(|line| line.branch.is_some());
    let shown: Vec<&Line> = branches
        .filter(|line| !ground.parts(line).is_empty())
        .collect();
    let hues = [
        (Hue::Forward, "forward wave"),
        (Hue::Backward, "backward wave"),
        (Hue::Standing, "standing or mixed"),
    ]
    .into_iter()
    .filter(|(hue, _)| shown.iter().any(|line| line.colour == *hue));
    let mut samples: Vec<Item> = hues
        .map(|(hue, word)| Item::line_sample(CURVE, false, hue, word))
        .collect();
    let reflected = shown.iter().find(|line| line.dashed);
    samples.extend(reflected.map(|line| {
        let word = "reflected: backward above its critical speed";
        Item::line_sample(line.width, true, Hue::Standing, word)
    }));
    let unstable = shown.iter().find(|line| line.width > CURVE);
    samples.extend(
        unstable.map(|line| Item::line_sample(line.width, line.dashed, Hue::Standing, "unstable")),
    );
    samples.extend(measured_source(chart).map(|source| {
        let source = shorten_label(source, LONGEST_SOURCE);
        Item::points_sample(MEASURED_SIZE, Shape::Ring, Hue::Ink, &source)
    }));
    let at = [PLOT_LEFT, f64::from(HEIGHT) - LEGEND_ABOVE_FOOT - 14.0];
    key::draw(sheet, &samples, at, f64::from(WIDTH) - PLOT_LEFT);
    draw_notes(sheet, chart, labels);
}

fn draw_notes(sheet: &mut Sheet, chart: &Chart, labels: &BandLabels) {
    let mut notes =
        vec!["at the lines, branch: nodal diameters/circles at its first speed".to_owned()];
    if chart.lines().any(|line| line.name.starts_with(WINDOW)) {
        notes.push(format!("grey along the axis: {WINDOW}"));
    }
    let shown = chart.speed.values();
    notes.extend(left_out(chart.report, shown, labels.count()));
    if growth::hides_decay(chart.report) {
        notes.push("decaying mirror images not shown".to_owned());
    }
    let room = f64::from(WIDTH) - MARGIN - PLOT_LEFT;
    let note_line = shorten_label(&notes.join(BETWEEN_FACTS), room);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let baseline = f64::from(HEIGHT) - NOTES_ABOVE_FOOT;
    sheet.text([PLOT_LEFT, baseline], letters, &note_line);
}
