//! The lobe diagram: from which cutting stiffness on a motion grows, over the speed, and at which
//! frequency.

use super::axis::{Axis, Spread, draw_horizontal, draw_named, draw_vertical};
use super::canvas::{Frame, Sheet, Stroke};
use super::clip::clip;
use super::heading;
use super::key::Key;
use super::style::{
    ALARM, BETWEEN_FACTS, CURVE, DASH, FLUTTER, FLUTTER_SHADE, HAIRLINE, INK, PAPER, QUIET,
};
use crate::report::{Verdict, WashboardReport};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 780;
const LOBES: Frame = Frame {
    left: 104.0,
    top: 92.0,
    right: 1160.0,
    bottom: 440.0,
};
const FREQUENCY: Frame = Frame {
    top: 480.0,
    bottom: 680.0,
    ..LOBES
};
/// Decades shown at most above the cut's own stiffness, or the least at which a motion grows.
const DECADES: f64 = 2.5;
/// Room below and above what is shown, in decades.
const ROOM: f64 = 0.3;

pub fn sheet(report: &WashboardReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let lobes = &report.lobes;
    let ends = [lobes.rpm.first(), lobes.rpm.last()].map(|rpm| rpm.copied().unwrap_or(0.0));
    let speed = Axis::new(ends, [LOBES.left, LOBES.right], Spread::Linear);
    let decades = decades(report);
    let stiffness = Axis::new(decades, [LOBES.bottom, LOBES.top], Spread::Logarithmic);
    draw_unstable(&mut sheet, report, &speed, &stiffness);
    let name = "lateral cutting stiffness\u{2003}[N/m]";
    draw_vertical(&mut sheet, &stiffness, &LOBES, name);
    draw_boundary(&mut sheet, report, &speed, &stiffness);
    draw_horizontal(&mut sheet, &speed, LOBES.bottom, false);
    draw_frequencies(&mut sheet, report, &speed);
    draw_own(&mut sheet, report, &speed, &stiffness);
    draw_key(&mut sheet, report);
    sheet
}

fn facts(report: &WashboardReport) -> String {
    let verdict = match report.growing_mode() {
        Some(mode) => format!(
            "{:.0} rpm: unstable at {:.1} Hz, {:.2} 1/s",
            report.rpm, mode.frequency_hz, mode.growth_per_s
        ),
        None if report.verdict == Verdict::Unstable => format!("{:.0} rpm: unstable", report.rpm),
        None => format!("{:.0} rpm: stable", report.rpm),
    };
    let pitch = report.growing_mode().and_then(|mode| mode.pattern_pitch_m);
    let pitch = pitch.map(|metres| format!("waves of {:.1} mm along the feed", 1e3 * metres));
    let teeth = format!("{:.0} teeth pass in a second", report.tooth_passing_hz);
    let all = [Some(verdict), pitch, Some(teeth)];
    all.into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(BETWEEN_FACTS)
}

/// Whole decades about the boundary and the stiffness of the cut.
fn decades(report: &WashboardReport) -> [f64; 2] {
    let known = report.lobes.critical_stiffness_n_per_m.iter();
    let known = known.flatten().filter(|k| **k > 0.0).map(|k| k.log10());
    let own = report.stiffness_n_per_m.log10();
    let least = known.clone().fold(f64::INFINITY, f64::min);
    let highest = own.max(if least.is_finite() { least } else { own }) + DECADES;
    let most = known.filter(|k| *k <= highest).fold(own, f64::max);
    [(own.min(least) - ROOM).floor(), (most + ROOM).ceil()].map(|log| 10f64.powf(log))
}

/// A column from the boundary upwards at every speed, half way to the next ones.
fn draw_unstable(sheet: &mut Sheet, report: &WashboardReport, speed: &Axis, stiffness: &Axis) {
    let lobes = &report.lobes;
    let places: Vec<f64> = lobes.rpm.iter().map(|rpm| speed.at(*rpm)).collect();
    for (k, critical) in lobes.critical_stiffness_n_per_m.iter().enumerate() {
        let Some(critical) = critical else {
            continue;
        };
        let y = stiffness.at(critical.max(stiffness.values()[0]));
        let x = places[k];
        let before = k.checked_sub(1).map_or(x, |before| places[before]);
        let after = places.get(k + 1).copied().unwrap_or(x);
        let frame = Frame {
            left: 0.5 * (x + before),
            right: 0.5 * (x + after),
            top: LOBES.top,
            bottom: y.min(LOBES.bottom),
        };
        if frame.bottom > frame.top {
            sheet.fill(frame, FLUTTER_SHADE);
        }
    }
}

fn draw_boundary(sheet: &mut Sheet, report: &WashboardReport, speed: &Axis, stiffness: &Axis) {
    let lobes = &report.lobes;
    let [least, most] = stiffness.values();
    let points: Vec<[f64; 2]> = lobes
        .rpm
        .iter()
        .zip(&lobes.critical_stiffness_n_per_m)
        .map(|(rpm, critical)| {
            // Beyond the frame where there is none, below it where it is zero.
            let k = critical.unwrap_or(10.0 * most);
            [speed.at(*rpm), stiffness.at(k.max(0.1 * least))]
        })
        .collect();
    for part in clip(&points, &LOBES) {
        sheet.line(part, Stroke::solid(FLUTTER, CURVE));
    }
}

fn draw_frequencies(sheet: &mut Sheet, report: &WashboardReport, speed: &Axis) {
    let lobes = &report.lobes;
    let per_rpm = report.tooth_passing_hz / report.rpm;
    let shown = lobes.frequency_hz.iter().flatten().copied();
    let top = shown.fold(per_rpm * speed.values()[1], f64::max);
    let places = [FREQUENCY.bottom, FREQUENCY.top];
    let frequency = Axis::new([0.0, 1.05 * top], places, Spread::Linear);
    let name = "frequency there\u{2003}[Hz]";
    draw_vertical(sheet, &frequency, &FREQUENCY, name);
    let dashed = Stroke {
        dash: Some(DASH),
        ..Stroke::solid(QUIET, HAIRLINE)
    };
    for multiple in [0.5, 1.0] {
        let line = speed.values().map(|rpm| {
            let hz = multiple * per_rpm * rpm;
            [speed.at(rpm), frequency.at(hz)]
        });
        for part in clip(&line, &FREQUENCY) {
            sheet.line(part, dashed);
        }
    }
    for (rpm, hz) in lobes.rpm.iter().zip(&lobes.frequency_hz) {
        if let Some(hz) = hz.filter(|hz| frequency.shows(*hz)) {
            sheet.disc([speed.at(*rpm), frequency.at(hz)], 2.2, FLUTTER);
        }
    }
    let name = "rotation speed Ω\u{2003}[rpm]";
    draw_named(sheet, speed, FREQUENCY.bottom, name);
}

/// The saw at its speed with its cutting stiffness.
fn draw_own(sheet: &mut Sheet, report: &WashboardReport, speed: &Axis, stiffness: &Axis) {
    let at = [speed.at(report.rpm), stiffness.at(report.stiffness_n_per_m)];
    sheet.ring(at, 6.0, Stroke::solid(own_colour(report), 2.5), PAPER);
}

fn own_colour(report: &WashboardReport) -> super::style::Colour {
    match report.verdict {
        Verdict::Stable => INK,
        Verdict::Unstable => ALARM,
    }
}

fn draw_key(sheet: &mut Sheet, report: &WashboardReport) {
    let colour = own_colour(report);
    let dashes = |sheet: &mut Sheet, [x, y]: [f64; 2]| {
        let dashed = Stroke {
            dash: Some(DASH),
            ..Stroke::solid(QUIET, HAIRLINE)
        };
        sheet.line([[x, y], [x + 26.0, y]], dashed);
    };
    Key::new(sheet, LOBES.left, f64::from(HEIGHT) - 24.0)
        .shade(FLUTTER_SHADE)
        .word("above the least stiffness at which a motion grows")
        .mark(12.0, |sheet, [x, y]| {
            sheet.ring([x + 6.0, y], 6.0, Stroke::solid(colour, 2.5), PAPER);
        })
        .word("this cut")
        .mark(26.0, dashes)
        .word("tooth passing frequency, and half of it");
}
