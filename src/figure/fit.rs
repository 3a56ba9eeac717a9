//! Measured points over the fitted curves, and residuals.

use super::axis::{Axis, SPEED, draw_horizontal, draw_named, draw_vertical, round_up};
use super::campbell::draw_measured_mark;
use super::canvas::{Frame, Sheet, Stroke};
use super::clip::draw_inside;
use super::heading;
use super::key::Key;
use super::style::{
    ALARM, BACKWARD, BETWEEN_FACTS, CURVE, Colour, DASH, DIVERGENCE, FORWARD, HAIRLINE, INK, QUIET,
    STANDING, shorten_label,
};
use super::written::in_words;
use crate::analyses::fit::{FitReport, Residual};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 820;
const UPPER: Frame = Frame {
    left: 92.0,
    top: 92.0,
    right: 1172.0,
    bottom: 560.0,
};
const LOWER: Frame = Frame {
    top: 584.0,
    bottom: 722.0,
    ..UPPER
};
const BEFORE: Colour = STANDING;
const FITTED: Colour = FORWARD;
/// Shapes and colours of the residuals of the lowest measured frequency of a speed, the second, and so on; from the
/// fifth on they repeat. Shapes distinguish the marks in grey prints.
const PLACES: [(Shape, Colour); 4] = [
    (Shape::Disc, FORWARD),
    (Shape::Ring, BACKWARD),
    (Shape::Square, DIVERGENCE),
    (Shape::Cross, INK),
];

/// Shape of the mark of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Disc,
    Ring,
    Square,
    Cross,
}

pub fn sheet(report: &FitReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let last = report.curves.rpm.last().copied().unwrap_or(1.0);
    // The axis begins below zero, which leaves room for measured points at rest.
    let speed = Axis::linear([-0.025 * last, last], UPPER.across());
    let shown = report.residuals.iter().filter(|r| speed.shows(r.rpm));
    let shown: Vec<&Residual> = shown.collect();
    let fitted = || shown.iter().filter(|r| r.fitted);
    let highest = fitted().fold(1.0_f64, |top, r| top.max(r.measured_hz).max(r.fitted_hz));
    let frequency = Axis::linear([0.0, 1.12 * highest], UPPER.upwards());
    let off = |r: &Residual| r.fitted_hz - r.measured_hz;
    let largest = fitted().fold(1e-3_f64, |top, r| top.max(off(r).abs()));
    // The axis ends at round numbers, so that both signs have a tick.
    let reach = round_up(1.05 * largest);
    let residual = Axis::linear([-reach, reach], LOWER.upwards());
    draw_axes(&mut sheet, &speed, &frequency, &residual);
    let before = Stroke::dashed(BEFORE, HAIRLINE, DASH);
    let after = Stroke::solid(FITTED, CURVE);
    let curves = &report.curves;
    for (rows, stroke) in [(&curves.before_hz, before), (&curves.fitted_hz, after)] {
        draw_curves(&mut sheet, report, rows, (&speed, &frequency), stroke);
    }
    for r in &shown {
        draw_pair(&mut sheet, r, &speed, &frequency, &residual);
    }
    draw_key(&mut sheet, report, shown.iter().any(|r| !r.fitted));
    sheet
}

fn draw_axes(sheet: &mut Sheet, speed: &Axis, frequency: &Axis, residual: &Axis) {
    draw_vertical(sheet, frequency, &UPPER, "frequency in space\u{2003}[Hz]");
    draw_vertical(sheet, residual, &LOWER, "model − measured\u{2003}[Hz]");
    sheet.horizontal(residual.at(0.0), &LOWER, Stroke::solid(QUIET, HAIRLINE));
    draw_horizontal(sheet, speed, UPPER.bottom, false);
    draw_named(sheet, speed, LOWER.bottom, SPEED);
}

fn facts(report: &FitReport) -> String {
    let found = report.parameters.iter();
    let found = found.map(|p| in_words(&p.path, p.value));
    let rms = format!(
        "{:.3} Hz rms over {} frequencies",
        report.rms_hz, report.measured_frequencies
    );
    [report.condition.clone(), rms]
        .into_iter()
        .chain(found)
        .collect::<Vec<_>>()
        .join(BETWEEN_FACTS)
}

/// Draws a curve through the lowest frequencies of all speeds, through the second ones, and so on. `rows` contains
/// the frequencies of each speed in Hz, ascending.
fn draw_curves(
    sheet: &mut Sheet,
    report: &FitReport,
    rows: &[Vec<f64>],
    (speed, frequency): (&Axis, &Axis),
    stroke: Stroke,
) {
    let depth = rows.iter().map(Vec::len).max().unwrap_or(0);
    for place in 0..depth {
        let points = report.curves.rpm.iter().zip(rows);
        let places: Vec<[f64; 2]> = points
            .filter_map(|(rpm, row)| Some([speed.at(*rpm), frequency.at(*row.get(place)?)]))
            .collect();
        draw_inside(sheet, &UPPER, &places, stroke);
    }
}

/// Draws a measured point, a line to the fitted frequency, and the residual.
fn draw_pair(sheet: &mut Sheet, r: &Residual, speed: &Axis, frequency: &Axis, residual: &Axis) {
    let x = speed.at(r.rpm);
    if !frequency.shows(r.measured_hz) {
        return;
    }
    let at = [x, frequency.at(r.measured_hz)];
    if r.fitted && frequency.shows(r.fitted_hz) {
        let way = [at, [x, frequency.at(r.fitted_hz)]];
        sheet.line(way, Stroke::solid(ALARM, HAIRLINE));
        // The residuals of one speed are drawn side by side, so that none hides another.
        let place = (r.place - 1) % PLACES.len();
        let (aside, (shape, colour)) = (7.0 * place as f64 - 10.5, PLACES[place]);
        let x = (x + aside).clamp(LOWER.left, LOWER.right);
        let (zero, top) = (residual.at(0.0), residual.at(r.fitted_hz - r.measured_hz));
        sheet.line([[x, zero], [x, top]], Stroke::solid(colour, CURVE));
        draw_shape(sheet, shape, [x, top], colour);
    }
    if r.fitted {
        draw_measured_mark(sheet, at);
    } else {
        sheet.disc(at, 2.0, QUIET);
    }
}

fn draw_shape(sheet: &mut Sheet, shape: Shape, [x, y]: [f64; 2], colour: Colour) {
    let stroke = Stroke::solid(colour, 1.4);
    match shape {
        Shape::Disc => sheet.disc([x, y], 3.2, colour),
        Shape::Ring => sheet.ring([x, y], 3.2, stroke),
        Shape::Square => sheet.fill(Frame::around([x, y], 3.0), colour),
        Shape::Cross => {
            for side in [-3.2, 3.2] {
                sheet.line([[x - 3.2, y - side], [x + 3.2, y + side]], stroke);
            }
        }
    }
}

fn draw_key(sheet: &mut Sheet, report: &FitReport, some_left_out: bool) {
    let source = shorten_label(&report.source, 260.0);
    let mut key = Key::new(sheet, UPPER.left, f64::from(HEIGHT) - 22.0);
    key.mark(8.0, |sheet, [x, y]| draw_measured_mark(sheet, [x + 4.0, y]))
        .word(&source);
    if some_left_out {
        key.dot(6.0, 2.0, QUIET).word("not fitted");
    }
    let before = Stroke::dashed(BEFORE, HAIRLINE, DASH);
    for (stroke, text) in [(Stroke::solid(FITTED, CURVE), "fitted"), (before, "before")] {
        key.line(22.0, stroke).word(text);
    }
    let deepest = report.residuals.iter().map(|r| r.place).max().unwrap_or(0);
    for (place, (shape, colour)) in PLACES.into_iter().enumerate().take(deepest) {
        key.mark(6.0, |sheet, [x, y]| {
            draw_shape(sheet, shape, [x + 3.0, y], colour)
        })
        .word(["lowest", "second", "third", "fourth, …"][place]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_are_distinguished_without_colours() {
        for (k, (shape, _)) in PLACES.iter().enumerate() {
            assert!(PLACES[..k].iter().all(|(other, _)| other != shape));
            let mut sheet = Sheet::new(WIDTH, HEIGHT);
            draw_shape(&mut sheet, *shape, [100.0, 100.0], INK);
            assert!(!sheet.marks().is_empty());
        }
    }
}
