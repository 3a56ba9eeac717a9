//! Run time over true error, both on logarithmic scales.

use super::axis::{Axis, Spread, extremes, name_below, name_upright, number_beside, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use super::heading;
use super::key::Key;
use super::style::{
    AXIS_SIZE, BACKWARD, CURVE, Colour, DASH, DIVERGENCE, FORWARD, GRID, HAIRLINE, LABEL_SIZE,
    PAPER, QUIET, STRONG_CURVE, tint,
};
use crate::analyses::tradeoff::{Method, Setting};

const WIDTH: u32 = 900;
const HEIGHT: u32 = 660;
const PANEL: Frame = Frame {
    left: 92.0,
    top: 100.0,
    right: 860.0,
    bottom: 560.0,
};

/// Smallest relative error and smallest time in s on the axes; smaller values are rounding errors.
const LEAST: f64 = 1e-12;

const METHODS: [Method; 3] = [Method::Reduced, Method::Dense, Method::CriticalSpeeds];

pub fn sheet(scene: &str, settings: &[Setting]) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, "Computing time over true error", scene);
    let decades = |value: fn(&Setting) -> f64| {
        let logs = settings.iter().map(|s| value(s).max(LEAST).log10());
        let [low, high] = extremes(logs);
        let low = low.floor();
        [low, high.max(low + 1.0).ceil()].map(|log| 10f64.powf(log))
    };
    let errors = decades(|s| s.error).map(|share| 100.0 * share);
    let error = Axis::new(errors, PANEL.across(), Spread::Logarithmic);
    // The factor leaves room for a number above the slowest setting.
    let [least, most] = decades(|s| s.seconds);
    let time = Axis::new([least, 2.0 * most], PANEL.upwards(), Spread::Logarithmic);
    draw_axes(&mut sheet, &error, &time);
    draw_front(&mut sheet, settings, &error, &time);
    draw_key(&mut sheet);
    // The labels cover the dashed lines of the accuracies, but not the dots, so that the background of the
    // labels is drawn before the dots.
    for (at, letters, label) in labels(settings, &error, &time) {
        sheet.fill(text_frame(at, &letters, &label), PAPER);
    }
    for method in METHODS {
        let own: Vec<&Setting> = settings.iter().filter(|s| s.method == method).collect();
        draw_method(&mut sheet, method, &own, &error, &time);
    }
    for (at, letters, label) in labels(settings, &error, &time) {
        sheet.text(at, letters, &label);
    }
    sheet
}

/// Position of a setting on the sheet.
fn place(setting: &Setting, error: &Axis, time: &Axis) -> [f64; 2] {
    let percent = 100.0 * setting.error.max(LEAST);
    [error.at(percent), time.at(setting.seconds.max(LEAST))]
}

fn look(method: Method) -> (Colour, &'static str) {
    match method {
        Method::Reduced => (FORWARD, "chart, projected"),
        Method::Dense => (BACKWARD, "chart, full model"),
        Method::CriticalSpeeds => (DIVERGENCE, "critical speeds"),
    }
}

/// Labels of the complete charts at 51 speeds: numbers of functions above the dots. The dots of the critical speeds
/// have the same numbers in the same order, and no labels.
fn labels(settings: &[Setting], error: &Axis, time: &Axis) -> Vec<([f64; 2], Lettering, String)> {
    let charts = settings.iter().filter(|s| s.is_chart() && s.speeds == 51);
    let label = |setting: &Setting| {
        let [x, y] = place(setting, error, time);
        let (colour, _) = look(setting.method);
        let letters = Lettering::regular(LABEL_SIZE, tint(colour, 0.8), Anchor::Middle);
        // The dots of settings with the same basis and other numbers of speeds may be close to this dot: the
        // label is above the highest of them.
        let alike = settings
            .iter()
            .filter(|s| s.method == setting.method && s.functions == setting.functions);
        let close = alike.map(|s| place(s, error, time));
        let close = close.filter(|[_, other]| (y - 16.0..y).contains(other));
        let y = close.fold(y, |top, [_, other]| top.min(other));
        ([x, y - 11.0], letters, setting.functions.to_string())
    };
    charts.map(label).collect()
}

/// Draws the dots of a method, connected for one number of speeds.
fn draw_method(sheet: &mut Sheet, method: Method, own: &[&Setting], error: &Axis, time: &Axis) {
    let (colour, _) = look(method);
    for setting in own {
        let at = place(setting, error, time);
        sheet.disc(at, 4.0, colour);
    }
    let line = own.iter().filter(|s| s.speeds == 51 || !s.is_chart());
    let line = line.map(|s| place(s, error, time));
    sheet.line(line, Stroke::solid(tint(colour, 0.6), CURVE));
}

fn draw_key(sheet: &mut Sheet) {
    let mut key = Key::new(sheet, PANEL.left, f64::from(HEIGHT) - 22.0);
    for method in METHODS {
        let (colour, name) = look(method);
        key.dot(8.0, 4.0, colour).word(name);
    }
}

/// Connects the settings than which no other is both faster and more accurate.
fn draw_front(sheet: &mut Sheet, settings: &[Setting], error: &Axis, time: &Axis) {
    let mut front: Vec<[f64; 2]> = settings
        .iter()
        .filter(|s| s.on_front)
        .map(|s| place(s, error, time))
        .collect();
    front.sort_by(|x, y| x[0].total_cmp(&y[0]));
    sheet.line(
        front,
        Stroke::solid(tint(FORWARD, 0.25), 2.0 * STRONG_CURVE),
    );
}

fn draw_axes(sheet: &mut Sheet, error: &Axis, time: &Axis) {
    let letters = Lettering::regular(AXIS_SIZE, QUIET, Anchor::Middle);
    for tick in error.ticks(90.0) {
        let x = error.at(tick);
        sheet.vertical(x, &PANEL, Stroke::solid(GRID, HAIRLINE));
        let share = format!("{} %", error.label(tick));
        sheet.text([x, PANEL.bottom + 20.0], letters, &share);
    }
    for tick in time.ticks(40.0) {
        let y = time.at(tick);
        sheet.horizontal(y, &PANEL, Stroke::solid(GRID, HAIRLINE));
        number_beside(sheet, &PANEL, y, &seconds(tick));
    }
    sheet.horizontal(PANEL.bottom, &PANEL, Stroke::solid(QUIET, HAIRLINE));
    let name = "true error of critical speeds and onsets; numbers of functions at the dots";
    name_below(sheet, PANEL.across(), PANEL.bottom + 44.0, name);
    name_upright(sheet, 28.0, &PANEL, "time");
    // Dashed lines are at the largest errors that the named accuracies allow.
    for (percent, word) in [(1.0, "draft"), (0.1, "design"), (0.01, "reference")] {
        if error.shows(percent) {
            let x = error.at(percent);
            sheet.vertical(x, &PANEL, Stroke::dashed(QUIET, HAIRLINE, DASH));
            let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
            sheet.text([x, PANEL.top - 7.0], letters, word);
        }
    }
}

/// A time in s, or in ms if it is shorter than a second.
fn seconds(value: f64) -> String {
    match value < 1.0 {
        true => format!("{} ms", tick_label(1e3 * value)),
        false => format!("{} s", tick_label(value)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::canvas::Mark;
    use super::*;

    /// Eight sizes of the basis, for a diagram and for critical speeds, and two diagrams on the full model.
    #[test]
    fn no_label_lies_on_another() {
        let setting = |method, k: u32, seconds: f64| Setting {
            method,
            max_diameters: 6,
            radial_functions: 4,
            functions: 52 * (k as usize + 1),
            speeds: 51,
            seconds,
            error: 1e-2 * 0.4_f64.powi(k as i32),
            on_front: method == Method::Reduced,
        };
        let settings: Vec<Setting> = (0..8)
            .flat_map(|k| {
                let time = 1.6_f64.powi(k as i32);
                let dense = (k < 2).then(|| setting(Method::Dense, k, 4.0 * time));
                [
                    setting(Method::Reduced, k, 0.1 * time),
                    setting(Method::CriticalSpeeds, k, 1e-3 * time),
                ]
                .into_iter()
                .chain(dense)
            })
            .collect();
        let drawn = sheet("A saw", &settings);
        super::super::tidy::assert_tidy(&drawn);
        // Where a label crosses a dashed line, there is a white ground between them.
        let marks = drawn.marks();
        let is_fill = |m: &&Mark| matches!(m, Mark::Fill(_, colour) if *colour == PAPER);
        let papered = marks.iter().filter(is_fill).count();
        let charts = settings.iter().filter(|s| s.is_chart()).count();
        assert_eq!(papered, charts);
        let last_dashed = marks
            .iter()
            .rposition(|m| matches!(m, Mark::Line(_, s) if s.dash.is_some()));
        assert!(last_dashed < marks.iter().position(|m| is_fill(&m)));
    }

    #[test]
    fn ticks_are_written_in_seconds() {
        assert_eq!([1e-3, 0.1, 10.0].map(seconds), ["1 ms", "100 ms", "10 s"]);
    }

    /// The errors extend from rounding to a percent.
    #[test]
    fn ticks_over_many_decades_keep_apart() {
        let settings = [1e-12, 1e-9, 1e-2].map(|error| Setting {
            method: Method::Reduced,
            max_diameters: 6,
            radial_functions: 4,
            functions: 52,
            speeds: 51,
            seconds: 9.9,
            error,
            on_front: true,
        });
        super::super::tidy::assert_tidy(&sheet("A saw", &settings));
    }
}
