//! Oscillation of the blade between guides with a gap, over the speed: amplitudes of the harmonics at the probe, and
//! mean and amplitude of the deflection at the cut.

use super::axis::{Axis, SPEED, Spread, draw_horizontal, draw_named, draw_vertical, extremes};
use super::canvas::{Frame, Sheet, Stroke};
use super::clip::draw_inside;
use super::heading;
use super::key::Key;
use super::style::{
    ALARM, BACKWARD, BETWEEN_FACTS, CURVE, Colour, DASH, DIVERGENCE, FINE_DASH, FLUTTER, FORWARD,
    HAIRLINE, INK, STANDING, tint,
};
use crate::analyses::gap::{GapReport, Oscillation, OscillationLine};
use crate::text::shown_to;

const WIDTH: u32 = 1100;
const HEIGHT: u32 = 840;
const PARTS: Frame = Frame {
    left: 104.0,
    top: 100.0,
    right: 1064.0,
    bottom: 400.0,
};
const CUT: Frame = Frame {
    top: 450.0,
    bottom: 710.0,
    ..PARTS
};
/// Colour of speeds without a motion.
const UNKNOWN: Colour = plotters::style::RGBColor(240, 241, 243);
/// Colours of the harmonics.
const COLOURS: [Colour; 6] = [FORWARD, BACKWARD, DIVERGENCE, FLUTTER, STANDING, INK];
/// Largest number of decades between the lower end of the axis of amplitudes and the largest amplitude.
const DECADES: i32 = 4;
/// Number of harmonics in a row of the key.
const IN_A_ROW: usize = 3;

/// Draws both panels; `None` without an oscillation.
pub fn sheet(report: &GapReport) -> Option<Sheet> {
    let found = report.oscillation.as_ref()?;
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(
        &mut sheet,
        "Oscillation between guides with a gap",
        &facts(report, found).join(BETWEEN_FACTS),
    );
    let last = found.rpm.last().copied().unwrap_or(1.0);
    let speed = Axis::linear([0.0, last], PARTS.across());
    for panel in [&PARTS, &CUT] {
        shade_unknown(&mut sheet, found, &speed, panel);
    }
    draw_parts(&mut sheet, found, &speed);
    draw_cut(&mut sheet, report, found, &speed);
    let x = speed.at(report.deviation.rpm);
    for panel in [&PARTS, &CUT] {
        sheet.vertical(x, panel, Stroke::dashed(ALARM, HAIRLINE, FINE_DASH));
    }
    draw_key(&mut sheet, report, found);
    Some(sheet)
}

fn facts(report: &GapReport, found: &Oscillation) -> Vec<String> {
    let force = (found.oscillating_order > 0).then(|| {
        format!(
            "{} N oscillating with {}×",
            shown_to(3, found.oscillating_force_n),
            found.oscillating_order
        )
    });
    let place = report.scene.side_force_place_in_words();
    let steady = format!("{} N steady {place}", shown_to(3, found.force_n));
    let gap = format!(
        "smallest gap {} mm",
        shown_to(3, 1e3 * report.smallest_gap_m)
    );
    let all = [
        Some(heading::of_saw(&report.scene.name, &report.condition)),
        Some(gap),
        Some(steady),
        force,
    ];
    all.into_iter().flatten().collect()
}

/// Shades speeds without a motion, half way to their neighbours.
fn shade_unknown(sheet: &mut Sheet, found: &Oscillation, speed: &Axis, panel: &Frame) {
    let rpm = &found.rpm;
    for (k, own) in rpm.iter().enumerate() {
        let beside = |other: Option<&f64>| speed.at(other.map_or(*own, |rpm| 0.5 * (rpm + own)));
        if found.probe_mean_m.get(k).copied().flatten().is_none() {
            let left = beside(k.checked_sub(1).and_then(|k| rpm.get(k)));
            let right = beside(rpm.get(k + 1));
            sheet.fill(panel.between([left, right]), UNKNOWN);
        }
    }
}

/// Points of a series, divided at speeds without a value; `of` returns the point of a speed.
fn pieces(found: &Oscillation, of: impl Fn(usize) -> Option<[f64; 2]>) -> Vec<Vec<[f64; 2]>> {
    let mut all = vec![Vec::new()];
    for k in 0..found.rpm.len() {
        match (of(k), all.last_mut()) {
            (Some(point), Some(piece)) => piece.push(point),
            _ => all.push(Vec::new()),
        }
    }
    all
}

/// Draws the pieces of a series; a piece of one point is drawn as a dot.
fn draw(sheet: &mut Sheet, panel: &Frame, pieces: &[Vec<[f64; 2]>], stroke: Stroke) {
    for piece in pieces {
        if let [point] = piece[..] {
            sheet.disc(point, 0.5 * stroke.width + 0.6, stroke.colour);
        }
        draw_inside(sheet, panel, piece, stroke);
    }
}

fn draw_parts(sheet: &mut Sheet, found: &Oscillation, speed: &Axis) {
    let all = found.lines.iter().flat_map(|line| &line.probe_m).flatten();
    let [low, high] = extremes(all.map(|m| 1e3 * m).filter(|mm| *mm > 0.0));
    let ends = match high > 0.0 {
        true => [low.max(high * 10f64.powi(-DECADES)) / 1.5, 1.5 * high],
        false => [1e-3, 1.0],
    };
    let axis = Axis::new(ends, PARTS.upwards(), Spread::Logarithmic);
    draw_vertical(sheet, &axis, &PARTS, "parts at the probe\u{2003}[mm]");
    for (line, colour) in found.lines.iter().zip(COLOURS) {
        let points = pieces(found, |k| {
            let mm = 1e3 * line.probe_m.get(k).copied().flatten()?;
            Some([speed.at(found.rpm[k]), axis.at(mm)])
        });
        draw(sheet, &PARTS, &points, stroke_of(line, colour));
    }
    draw_horizontal(sheet, speed, PARTS.bottom, false);
}

/// Style of a harmonic: dashed if it is caused by contact alone.
fn stroke_of(line: &OscillationLine, colour: Colour) -> Stroke {
    match line.name == "contact" {
        true => Stroke::dashed(colour, CURVE, DASH),
        false => Stroke::solid(colour, 1.4 * CURVE),
    }
}

fn draw_cut(sheet: &mut Sheet, report: &GapReport, found: &Oscillation, speed: &Axis) {
    let limit_mm = report.deviation.max_deflection_m.map(|m| 1e3 * m);
    let both = found.cut_mean_m.iter().zip(&found.cut_amplitude_m);
    let ends = both.filter_map(|(mean, amplitude)| {
        let [mean, amplitude] = [1e3 * (*mean)?, 1e3 * (*amplitude)?];
        Some([mean - amplitude, mean + amplitude])
    });
    let ends = ends.fold([0.0_f64, 0.0_f64], |[low, high], [from, to]| {
        [low.min(from), high.max(to)]
    });
    let size = 0.08 * (ends[1] - ends[0]).max(1e-6);
    let ends = [ends[0] - size, ends[1] + size];
    let axis = Axis::linear(ends, CUT.upwards());
    let at = |k: usize, side: f64| {
        let [mean, amplitude] = [&found.cut_mean_m, &found.cut_amplitude_m].map(|all| all[k]);
        let mm = 1e3 * (mean? + side * amplitude?);
        Some([speed.at(found.rpm[k]), axis.at(mm)])
    };
    let [upper, lower] = [1.0, -1.0].map(|side| pieces(found, |k| at(k, side)));
    for (upper, lower) in upper.iter().zip(&lower) {
        let around = upper.iter().chain(lower.iter().rev()).copied();
        sheet.polygon(around.collect::<Vec<_>>(), tint(FORWARD, 0.16));
    }
    draw_vertical(sheet, &axis, &CUT, "deflection at the cut\u{2003}[mm]");
    sheet.horizontal(axis.at(0.0), &CUT, Stroke::solid(INK, HAIRLINE));
    let limits = limit_mm.iter().flat_map(|limit| [*limit, -limit]);
    for limit in limits.filter(|limit| axis.shows(*limit)) {
        sheet.horizontal(axis.at(limit), &CUT, Stroke::dashed(ALARM, CURVE, DASH));
    }
    for edge in [&upper, &lower] {
        let stroke = Stroke::solid(tint(FORWARD, 0.6), HAIRLINE);
        draw(sheet, &CUT, edge, stroke);
    }
    let mean = pieces(found, |k| at(k, 0.0));
    draw(sheet, &CUT, &mean, Stroke::solid(FORWARD, 1.4 * CURVE));
    draw_named(sheet, speed, CUT.bottom, SPEED);
}

fn draw_key(sheet: &mut Sheet, report: &GapReport, found: &Oscillation) {
    let y = f64::from(HEIGHT) - 66.0;
    let lines: Vec<(&OscillationLine, Colour)> = found.lines.iter().zip(COLOURS).collect();
    for (row, some) in lines.chunks(IN_A_ROW).enumerate() {
        let mut key = Key::new(sheet, PARTS.left, y + 20.0 * row as f64);
        for (line, colour) in some {
            key.line(24.0, stroke_of(line, *colour))
                .word(&format!("{}× {}", line.order, line.name));
        }
    }
    let mut key = Key::new(sheet, PARTS.left, y + 42.0);
    key.line(24.0, Stroke::solid(FORWARD, 1.4 * CURVE))
        .word("mean at the cut")
        .shade(tint(FORWARD, 0.16))
        .word("mean ± amplitude")
        .line(24.0, Stroke::dashed(ALARM, HAIRLINE, FINE_DASH))
        .word("speed of the map")
        .shade(UNKNOWN)
        .word("no stable motion, or beyond the thickness");
    if report.deviation.max_deflection_m.is_some() {
        key.line(24.0, Stroke::dashed(ALARM, CURVE, DASH))
            .word("largest deflection allowed");
    }
}
