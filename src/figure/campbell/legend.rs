//! The lines below the figure that explain colours and styles, and state which contents have no label.

use super::super::canvas::{Anchor, Lettering, Sheet, Stroke};
use super::super::items::Line;
use super::super::key::Key;
use super::super::paint::stroke;
use super::super::palette::Hue;
use super::super::style::{
    BETWEEN_FACTS, CURVE, LABEL_SIZE, MARGIN, QUIET, STANDING, shorten_label,
};
use super::band_labels::BandLabels;
use super::describe::WINDOW;
use super::view::left_out;
use super::waves::{draw_measured_mark, measured_source};
use super::{Chart, HEIGHT, LEGEND_ABOVE_FOOT, NOTES_ABOVE_FOOT, PLOT_LEFT, WIDTH, growth};

/// Length of a line in the legend.
const SAMPLE: f64 = 22.0;

/// Writes the legend of the colours and styles that the figure contains, and a line of notes.
pub fn draw(sheet: &mut Sheet, chart: &Chart, labels: &BandLabels) {
    let ground = chart.upper_ground();
    let branches = chart.lines().filter(|line| line.branch.is_some());
    let shown: Vec<&Line> = branches
        .filter(|line| !ground.parts(line).is_empty())
        .collect();
    let mut key = Key::new(sheet, PLOT_LEFT, f64::from(HEIGHT) - LEGEND_ABOVE_FOOT);
    let hues = [
        (Hue::Forward, "forward wave"),
        (Hue::Backward, "backward wave"),
        (Hue::Standing, "standing or mixed"),
    ];
    for (hue, word) in hues {
        if shown.iter().any(|line| line.colour == hue) {
            key.line(SAMPLE, Stroke::solid(hue.colour(), CURVE))
                .word(word);
        }
    }
    if let Some(reflected) = shown.iter().find(|line| line.dashed) {
        let word = "reflected: a backward wave above its critical speed";
        key.line(SAMPLE, grey(reflected)).word(word);
    }
    if let Some(unstable) = shown.iter().find(|line| line.width > CURVE) {
        key.line(SAMPLE, grey(unstable)).word("unstable");
    }
    if let Some(source) = measured_source(chart) {
        let mark = |sheet: &mut Sheet, [x, y]: [f64; 2]| draw_measured_mark(sheet, [x + 4.0, y]);
        key.mark(8.0, mark).word(&shorten_label(source, 250.0));
    }
    draw_notes(sheet, chart, labels);
}

/// The style of a line, in the colour of waves without direction.
fn grey(line: &Line) -> Stroke {
    Stroke {
        colour: STANDING,
        ..stroke(line)
    }
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
    let notes = shorten_label(&notes.join(BETWEEN_FACTS), room);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let baseline = f64::from(HEIGHT) - NOTES_ABOVE_FOOT;
    sheet.text([PLOT_LEFT, baseline], letters, &notes);
}
