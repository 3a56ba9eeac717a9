//! The lines at the foot that explain what is not labelled in place.

use super::super::canvas::{Anchor, Lettering, Sheet, Stroke};
use super::super::key::Key;
use super::super::style::{
    BETWEEN_FACTS, CURVE, DASH, LABEL_SIZE, MARGIN, QUIET, STANDING, STRONG_CURVE, Weight, shorten,
};
use super::band_labels::BandLabels;
use super::view::left_out;
use super::waves::{Stretch, direction_colour, draw_measured_mark, looks_shown, measured_source};
use super::{Chart, HEIGHT, LEGEND_ABOVE_FOOT, NOTES_ABOVE_FOOT, PLOT_LEFT, WIDTH, growth};
use crate::report::Direction;

/// Length of a line in the legend.
const SAMPLE: f64 = 22.0;

/// Writes both lines.
pub fn draw(sheet: &mut Sheet, chart: &Chart, labels: &BandLabels) {
    let looks = looks_shown(chart);
    let mut key = Key::new(sheet, PLOT_LEFT, f64::from(HEIGHT) - LEGEND_ABOVE_FOOT);
    let directions = [
        (Direction::Forward, "forward wave"),
        (Direction::Backward, "backward wave"),
        (Direction::Standing, "standing or mixed"),
    ];
    for (direction, word) in directions {
        if looks.iter().any(|look| look.1 == direction) {
            line(
                &mut key,
                Stroke::solid(direction_colour(direction), CURVE),
                word,
            );
        }
    }
    let dashed = Stroke {
        dash: Some(DASH),
        ..Stroke::solid(STANDING, CURVE)
    };
    let stretches = [
        (
            Stretch::Reflected,
            dashed,
            "reflected: a backward wave past its critical speed",
        ),
        (
            Stretch::Unstable,
            Stroke::solid(STANDING, STRONG_CURVE),
            "unstable",
        ),
    ];
    for (stretch, stroke, word) in stretches {
        if looks.iter().any(|look| look.0 == stretch) {
            line(&mut key, stroke, word);
        }
    }
    if let Some(source) = measured_source(chart) {
        let source = shorten(source, LABEL_SIZE, Weight::Regular, 250.0);
        let mark = |sheet: &mut Sheet, [x, y]: [f64; 2]| draw_measured_mark(sheet, [x + 4.0, y]);
        key.mark(8.0, mark).word(&source);
    }
    draw_notes(sheet, chart, labels);
}

fn line(key: &mut Key, stroke: Stroke, word: &str) {
    key.mark(SAMPLE, |sheet, [x, y]| {
        sheet.line([[x, y], [x + SAMPLE, y]], stroke)
    });
    key.word(word);
}

fn draw_notes(sheet: &mut Sheet, chart: &Chart, labels: &BandLabels) {
    let mut notes =
        vec!["at the lines, branch: nodal diameters/circles at its first speed".to_owned()];
    let shown = chart.speed.values();
    notes.extend(left_out(chart.report, shown, labels.count()));
    if growth::hides_decay(chart.report) {
        notes.push("decaying mirror images not shown".to_owned());
    }
    let room = f64::from(WIDTH) - MARGIN - PLOT_LEFT;
    let notes = shorten(
        &notes.join(BETWEEN_FACTS),
        LABEL_SIZE,
        Weight::Regular,
        room,
    );
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let baseline = f64::from(HEIGHT) - NOTES_ABOVE_FOOT;
    sheet.text([PLOT_LEFT, baseline], letters, &notes);
}
