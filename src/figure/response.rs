//! Steady-state amplitude, phase and deviation of the board over the speed; amplitude and phase over the frequency.

use super::axis::{
    Axis, SPEED, Spread, draw_horizontal, draw_named, draw_vertical, extremes, name_upright,
    number_beside, tick_label,
};
use super::bands::places;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::heading;
use super::key::Key;
use super::palette::Hue;
use super::style::{
    ALARM, BACKWARD, BETWEEN_FACTS, CURVE, Colour, DIVERGENCE, FINE_DASH, FLUTTER, FORWARD, GRID,
    HAIRLINE, INK, LABEL_SIZE, QUIET, STANDING,
};
use crate::report::{FrequencyResponseEntry, InstabilityKind, ResponseReport};
use crate::text::shown_to;

const WIDTH: u32 = 1100;
const HEIGHT: u32 = 1040;
const AMPLITUDE: Frame = Frame {
    left: 104.0,
    top: 100.0,
    right: 1064.0,
    bottom: 460.0,
};
const PHASE: Frame = Frame {
    top: 510.0,
    bottom: 650.0,
    ..AMPLITUDE
};
const BOARD: Frame = Frame {
    top: 700.0,
    bottom: 900.0,
    ..AMPLITUDE
};
/// Height of the sheet of the frequency response.
const POINTS_HEIGHT: u32 = 760;
/// Colours of the excitations.
const COLOURS: [Colour; 6] = [INK, FORWARD, BACKWARD, DIVERGENCE, FLUTTER, STANDING];
/// Largest number of decades between the lower end of an axis of amplitudes and the largest amplitude.
const DECADES: i32 = 6;
/// Ends of the axis of phases in degrees.
const PHASES: [f64; 2] = [-180.0, 180.0];

pub fn sheet(report: &ResponseReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let speed = Axis::linear([report.from_rpm, report.to_rpm], AMPLITUDE.across());
    for panel in [&AMPLITUDE, &PHASE, &BOARD] {
        shade_bands(&mut sheet, report, &speed, panel);
    }
    draw_amplitudes(&mut sheet, report, &speed);
    let phase = phase_axis(&mut sheet);
    for (line, colour) in report.lines.iter().zip(COLOURS) {
        let points = report.rpm.iter().zip(&line.phase_deg);
        let stroke = Stroke::solid(colour, CURVE);
        draw_phase(&mut sheet, points, (&speed, &phase), stroke);
    }
    draw_horizontal(&mut sheet, &speed, PHASE.bottom, false);
    draw_board(&mut sheet, report, &speed);
    draw_key(&mut sheet, report);
    sheet
}

fn facts(report: &ResponseReport) -> String {
    let probe = format!(
        "probe at {} mm, {}°",
        shown_to(4, 1e3 * report.probe_radius_m),
        shown_to(4, report.probe_angle_deg)
    );
    let cut = format!("cut at {}°", shown_to(4, report.cut_angle_deg));
    let damping = match report.damped {
        true => "damped",
        false => "without damping: no amplitude at a resonance",
    };
    [report.condition.as_str(), &probe, &cut, damping].join(BETWEEN_FACTS)
}

/// Shades the speeds at which a growth exceeds the threshold.
fn shade_bands(sheet: &mut Sheet, report: &ResponseReport, speed: &Axis, panel: &Frame) {
    for band in &report.instabilities {
        let [_, shade, _] = Hue::of_kind(band.kind);
        for ends in band
            .counted_rpm
            .iter()
            .filter_map(|range| places(speed, *range))
        {
            sheet.fill(panel.between(ends), shade.colour());
        }
    }
}

/// A logarithmic axis for amplitudes, over at least one decade and at most [`DECADES`].
fn amplitudes(values: impl Iterator<Item = f64>, panel: &Frame) -> Axis {
    let [low, high] = extremes(values.filter(|value| *value > 0.0));
    let ends = match high > 0.0 {
        true => [
            low.max(high * 10f64.powi(-DECADES)).min(0.1 * high) / 1.5,
            1.5 * high,
        ],
        false => [1e-3, 1.0],
    };
    Axis::new(ends, panel.upwards(), Spread::Logarithmic)
}

fn draw_amplitudes(sheet: &mut Sheet, report: &ResponseReport, speed: &Axis) {
    let all = report.lines.iter().flat_map(|line| &line.amplitude_m);
    let axis = amplitudes(all.flatten().map(|m| 1e3 * m), &AMPLITUDE);
    draw_vertical(
        sheet,
        &axis,
        &AMPLITUDE,
        "amplitude at the probe\u{2003}[mm]",
    );
    for (line, colour) in report.lines.iter().zip(COLOURS) {
        let points = report.rpm.iter().zip(&line.amplitude_m);
        let stroke = Stroke::solid(colour, CURVE);
        draw_curve(sheet, points, (speed, &axis, 1e3), stroke, &AMPLITUDE);
        // A resonance of unknown amplitude has a mark at the upper edge.
        let unknown = line.resonances.iter().filter(|r| r.amplitude_m.is_none());
        for resonance in unknown {
            let x = speed.at(resonance.rpm);
            let ends = [[x, AMPLITUDE.top], [x, AMPLITUDE.top + 12.0]];
            sheet.line(ends, Stroke::solid(colour, 2.0 * HAIRLINE));
        }
    }
    draw_horizontal(sheet, speed, AMPLITUDE.bottom, false);
}

/// Draws the known values of a series, multiplied by a factor.
fn draw_curve<'a>(
    sheet: &mut Sheet,
    points: impl Iterator<Item = (&'a f64, &'a Option<f64>)>,
    (x, y, factor): (&Axis, &Axis, f64),
    stroke: Stroke,
    panel: &Frame,
) {
    let mut run = Vec::new();
    let mut runs = Vec::new();
    for (at, value) in points {
        match value {
            Some(value) => run.push([x.at(*at), y.at(factor * value)]),
            None => runs.push(std::mem::take(&mut run)),
        }
    }
    runs.push(run);
    for run in &runs {
        draw_inside(sheet, panel, run, stroke);
    }
}

/// Draws the axis of phases, with ticks at quarters of a turn, and returns it.
fn phase_axis(sheet: &mut Sheet) -> Axis {
    let axis = Axis::linear(PHASES, PHASE.upwards());
    for degrees in [-180.0, -90.0, 0.0, 90.0, 180.0] {
        let y = axis.at(degrees);
        sheet.horizontal(y, &PHASE, Stroke::solid(GRID, HAIRLINE));
        number_beside(sheet, &PHASE, y, &tick_label(degrees));
    }
    name_upright(sheet, 28.0, &PHASE, "phase\u{2003}[°]");
    axis
}

/// Draws the known phases of a series. Neighbours that differ by half a turn or more are not connected: the phase
/// passes from one end of the axis to the other there.
fn draw_phase<'a>(
    sheet: &mut Sheet,
    points: impl Iterator<Item = (&'a f64, &'a Option<f64>)>,
    (x, y): (&Axis, &Axis),
    stroke: Stroke,
) {
    let points: Vec<(f64, Option<f64>)> = points.map(|(at, value)| (*at, *value)).collect();
    for pair in points.windows(2) {
        if let [(from, Some(a)), (to, Some(b))] = pair
            && (a - b).abs() < 180.0
        {
            let ends = [[x.at(*from), y.at(*a)], [x.at(*to), y.at(*b)]];
            draw_inside(sheet, &PHASE, &ends, stroke);
        }
    }
}

/// Draws the deviation of the board, and the operating speed in all panels.
fn draw_board(sheet: &mut Sheet, report: &ResponseReport, speed: &Axis) {
    let known = report.board_deviation_m.iter().flatten().map(|m| 1e3 * m);
    let axis = amplitudes(known, &BOARD);
    draw_vertical(sheet, &axis, &BOARD, "board, sum\u{2003}[mm]");
    let points = report.rpm.iter().zip(&report.board_deviation_m);
    let stroke = Stroke::solid(INK, CURVE);
    draw_curve(sheet, points, (speed, &axis, 1e3), stroke, &BOARD);
    draw_named(sheet, speed, BOARD.bottom, SPEED);
    if let Some(rpm) = report.scene.operating_rpm.filter(|rpm| speed.shows(*rpm)) {
        for panel in [&AMPLITUDE, &PHASE, &BOARD] {
            let dashed = Stroke::dashed(ALARM, HAIRLINE, FINE_DASH);
            sheet.vertical(speed.at(rpm), panel, dashed);
        }
    }
}

fn draw_key(sheet: &mut Sheet, report: &ResponseReport) {
    let baseline = f64::from(HEIGHT) - 50.0;
    let mut key = Key::new(sheet, AMPLITUDE.left, baseline);
    for (line, colour) in report.lines.iter().zip(COLOURS) {
        key.line(24.0, Stroke::solid(colour, CURVE))
            .word(&line.name);
    }
    let mut key = Key::new(sheet, AMPLITUDE.left, baseline + 26.0);
    let mut resonances = report.lines.iter().flat_map(|line| &line.resonances);
    if resonances.any(|resonance| resonance.amplitude_m.is_none()) {
        key.mark(4.0, |sheet, [x, y]| {
            let ends = [[x + 2.0, y - 6.0], [x + 2.0, y + 6.0]];
            sheet.line(ends, Stroke::solid(QUIET, 2.0 * HAIRLINE));
        })
        .word("resonance without an amplitude");
    }
    for kind in [InstabilityKind::Divergence, InstabilityKind::Flutter] {
        if report.instabilities.iter().any(|band| band.kind == kind) {
            let [_, shade, _] = Hue::of_kind(kind);
            let word = format!("{kind}: no steady state");
            key.shade(shade.colour()).word(&word);
        }
    }
}

/// Draws amplitude and phase over the frequency at one speed; `None` if the report contains no frequency response.
pub fn points_sheet(report: &ResponseReport) -> Option<Sheet> {
    let points = report.points.as_ref()?;
    let mut sheet = Sheet::new(WIDTH, POINTS_HEIGHT);
    heading::draw(
        &mut sheet,
        &report.scene.name,
        &points_facts(report, points),
    );
    let end = points.frequency_hz.last().copied().unwrap_or(1.0);
    let frequency = Axis::linear([0.0, end], AMPLITUDE.across());
    let known = points.receptance_m_per_n.iter().flatten();
    let axis = amplitudes(known.map(|m| 1e6 * m), &AMPLITUDE);
    draw_vertical(
        &mut sheet,
        &axis,
        &AMPLITUDE,
        "deflection for 1 N\u{2003}[µm/N]",
    );
    let series = points.frequency_hz.iter().zip(&points.receptance_m_per_n);
    let stroke = Stroke::solid(FORWARD, CURVE);
    draw_curve(
        &mut sheet,
        series,
        (&frequency, &axis, 1e6),
        stroke,
        &AMPLITUDE,
    );
    draw_horizontal(&mut sheet, &frequency, AMPLITUDE.bottom, false);
    let phase = phase_axis(&mut sheet);
    let series = points.frequency_hz.iter().zip(&points.phase_deg);
    draw_phase(&mut sheet, series, (&frequency, &phase), stroke);
    draw_named(
        &mut sheet,
        &frequency,
        PHASE.bottom,
        "frequency\u{2003}[Hz]",
    );
    if points.receptance_m_per_n.iter().all(Option::is_none) {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
        let note = "the saw is unstable at this speed: no steady state";
        sheet.text_on_paper(AMPLITUDE.centre(), letters, note);
    }
    Some(sheet)
}

fn points_facts(report: &ResponseReport, points: &FrequencyResponseEntry) -> String {
    let place = |radius_m: f64, angle_deg: f64| {
        format!(
            "{} mm, {}°",
            shown_to(4, 1e3 * radius_m),
            shown_to(4, angle_deg)
        )
    };
    format!(
        "{}{BETWEEN_FACTS}{} rpm{BETWEEN_FACTS}force at {}{BETWEEN_FACTS}probe at {}",
        report.condition,
        shown_to(6, points.rpm),
        place(points.force_radius_m, points.force_angle_deg),
        place(report.probe_radius_m, report.probe_angle_deg)
    )
}
