//! Speeds over the amplitude at guides with a gap, and the deflection at the cut over the gap.

use super::axis::{Axis, Spread, draw_vertical, extremes, name_below, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::heading;
use super::key::Key;
use super::palette::Hue;
use super::style::{
    ALARM, AXIS_SIZE, BETWEEN_FACTS, CURVE, DASH, DIVERGENCE_STREAK, FLUTTER_STREAK, FORWARD, GRID,
    HAIRLINE, LABEL_SIZE, QUIET, tint,
};
use crate::analyses::gap::{AtAmplitude, GapReport};
use crate::text::shown_to;

const WIDTH: u32 = 1000;
const HEIGHT: u32 = 980;
const SPEEDS: Frame = Frame {
    left: 92.0,
    top: 92.0,
    right: 940.0,
    bottom: 480.0,
};
const DEFLECTION: Frame = Frame {
    top: 570.0,
    bottom: 850.0,
    right: 880.0,
    ..SPEEDS
};
/// Width beside a logarithmic axis for the free blade and for linear guides, which have no place on the axis.
const BESIDE: f64 = 80.0;
/// Every third force has a curve, and every third gap has a label.
const EVERY: usize = 3;
/// Width of the stroke of a band.
const BAND: f64 = 7.0;

pub fn sheet(report: &GapReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(
        &mut sheet,
        &report.scene.name,
        &facts(report).join(BETWEEN_FACTS),
    );
    draw_speeds(&mut sheet, report);
    draw_deflections(&mut sheet, report);
    draw_key(&mut sheet, report.deviation.max_deflection_m.is_some());
    sheet
}

fn facts(report: &GapReport) -> Vec<String> {
    let gap = format!(
        "smallest gap {} mm",
        shown_to(3, 1e3 * report.smallest_gap_m)
    );
    let half = report.half_way_amplitude_m.map(|m| {
        format!(
            "first critical speed half way at an amplitude of {} mm",
            shown_to(4, 1e3 * m)
        )
    });
    let map = format!(
        "deflection of the rim at {}°, {:.0} rpm",
        report.deviation.angle_deg, report.deviation.rpm
    );
    let saw = report.condition.clone();
    [Some(saw), Some(gap), half, Some(map)]
        .into_iter()
        .flatten()
        .collect()
}

/// Difference of the amplitude and the smallest gap in µm; `None` without an amplitude.
fn beyond_um(report: &GapReport, at: &AtAmplitude) -> Option<f64> {
    Some(1e6 * (at.amplitude_m? - report.smallest_gap_m))
}

fn draw_speeds(sheet: &mut Sheet, report: &GapReport) {
    let panel = &SPEEDS;
    let beyond = report
        .amplitudes
        .iter()
        .filter_map(|at| beyond_um(report, at));
    let places = [panel.left + BESIDE, panel.right - BESIDE];
    let amplitude = Axis::new(extremes(beyond), places, Spread::Logarithmic);
    let speed = Axis::linear([report.from_rpm, report.to_rpm], panel.upwards());
    draw_vertical(sheet, &speed, panel, "rotation speed [rpm]");
    let grid = Stroke::solid(GRID, HAIRLINE);
    for tick in amplitude.ticks(60.0) {
        let x = amplitude.at(tick);
        sheet.vertical(x, panel, grid);
        label_x(sheet, panel, x, &tick_label(tick));
    }
    let (free, linear) = (panel.left + 0.4 * BESIDE, panel.right - 0.4 * BESIDE);
    label_x(sheet, panel, free, "free");
    label_x(sheet, panel, linear, "linear");
    name_x(sheet, panel, "amplitude at the guides beyond the gap [µm]");
    if let Some(half) = report.half_way_amplitude_m {
        let x = amplitude
            .at(1e6 * (half - report.smallest_gap_m))
            .clamp(places[0], places[1]);
        sheet.vertical(x, panel, Stroke::dashed(QUIET, HAIRLINE, DASH));
    }
    let place = |at: &AtAmplitude, fallback: f64| {
        beyond_um(report, at).map_or(fallback, |um| amplitude.at(um))
    };
    let columns = report.amplitudes.iter().map(|at| (place(at, free), at));
    let columns: Vec<(f64, &AtAmplitude)> = [(free, &report.free)]
        .into_iter()
        .chain(columns)
        .chain([(linear, &report.linear)])
        .collect();
    for (x, at) in &columns {
        for band in &at.instabilities {
            let [_, _, streak] = Hue::of_kind(band.kind);
            let [from, to] = [band.from_rpm, band.to_rpm].map(|rpm| speed.at(rpm));
            // A band is at least one pixel high.
            let half = (0.5 * (from - to)).max(0.5);
            let middle = 0.5 * (from + to);
            let ends = [[*x, middle - half], [*x, middle + half]];
            sheet.line(ends, Stroke::solid(streak.colour(), BAND));
        }
    }
    let most = columns.iter().map(|(_, at)| at.critical_rpm.len()).max();
    for k in 0..most.unwrap_or_default() {
        let points = columns.iter().filter_map(|(x, at)| {
            let rpm = at.critical_rpm.get(k)?;
            Some([*x, speed.at(*rpm)])
        });
        let points: Vec<[f64; 2]> = points.collect();
        sheet.line(points.clone(), Stroke::solid(tint(FORWARD, 0.5), HAIRLINE));
        for point in points {
            sheet.disc(point, 2.6, FORWARD);
        }
    }
    for (x, at) in &columns {
        if let Some(rpm) = at.flutter_speed_rpm {
            sheet.ring([*x, speed.at(rpm)], 4.5, Stroke::solid(ALARM, CURVE));
        }
    }
}

fn draw_deflections(sheet: &mut Sheet, report: &GapReport) {
    let (panel, map) = (&DEFLECTION, &report.deviation);
    let gaps_mm: Vec<f64> = map
        .gap_factors
        .iter()
        .map(|factor| 1e3 * factor * report.smallest_gap_m)
        .collect();
    let all = map
        .deflection_m
        .iter()
        .flatten()
        .flatten()
        .map(|m| 1e3 * m.abs());
    let all = all.chain(map.max_deflection_m.map(|m| 1e3 * m));
    let [low, high] = match extremes(all.filter(|mm| *mm > 0.0)) {
        ends if ends[0].is_finite() => ends,
        _ => [1e-3, 1.0],
    };
    let deflection = Axis::new(
        [low / 1.3, 1.3 * high],
        panel.upwards(),
        Spread::Logarithmic,
    );
    let above_zero = gaps_mm.iter().copied().filter(|mm| *mm > 0.0);
    let places = [panel.left + BESIDE, panel.right];
    let gap = Axis::new(extremes(above_zero.clone()), places, Spread::Logarithmic);
    draw_vertical(sheet, &deflection, panel, "deflection at the cut [mm]");
    let linear = panel.left + 0.4 * BESIDE;
    label_x(sheet, panel, linear, "linear");
    for mm in above_zero.step_by(EVERY) {
        label_x(sheet, panel, gap.at(mm), &shown_to(2, mm));
    }
    name_x(sheet, panel, "smallest gap [mm]; all gaps in proportion");
    if let Some(limit) = map.max_deflection_m {
        let stroke = Stroke::dashed(ALARM, CURVE, DASH);
        sheet.horizontal(deflection.at(1e3 * limit), panel, stroke);
    }
    for k in (0..map.forces_n.len()).step_by(EVERY) {
        let at = |row: usize| map.deflection_m[row][k].map(|m| deflection.at(1e3 * m.abs()));
        let rows = 0..gaps_mm.len();
        let lifting = rows.clone().filter(|row| gaps_mm[*row] > 0.0);
        let points = lifting.filter_map(|row| Some([gap.at(gaps_mm[row]), at(row)?]));
        let points: Vec<[f64; 2]> = points.collect();
        let colour = tint(FORWARD, 0.4 + 0.6 * k as f64 / (map.forces_n.len() as f64));
        sheet.line(points.clone(), Stroke::solid(colour, CURVE));
        for point in &points {
            sheet.disc(*point, 2.6, colour);
        }
        for row in rows.filter(|row| gaps_mm[*row] == 0.0) {
            if let Some(y) = at(row) {
                sheet.ring([linear, y], 3.0, Stroke::solid(colour, CURVE));
            }
        }
    }
    label_forces(sheet, report, (&gap, &deflection));
}

/// Writes the forces beside the ends of their curves, without overlap.
fn label_forces(sheet: &mut Sheet, report: &GapReport, (gap, deflection): (&Axis, &Axis)) {
    let map = &report.deviation;
    let Some(last) = map.deflection_m.last() else {
        return;
    };
    let mut ends: Vec<(f64, f64)> = map
        .forces_n
        .iter()
        .zip(last)
        .step_by(EVERY)
        .filter_map(|(force, m)| Some((deflection.at(1e3 * (*m)?.abs()), *force)))
        .collect();
    ends.sort_by(|x, y| y.0.total_cmp(&x.0));
    let mut below = f64::INFINITY;
    for (y, force) in ends {
        let y = y.min(below - 1.3 * LABEL_SIZE);
        below = y;
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        let at = [gap.places()[1] + 10.0, y + 0.36 * LABEL_SIZE];
        sheet.text(at, letters, &format!("{} N", shown_to(3, force)));
    }
}

fn label_x(sheet: &mut Sheet, panel: &Frame, x: f64, label: &str) {
    let letters = Lettering::regular(AXIS_SIZE, QUIET, Anchor::Middle);
    sheet.text([x, panel.bottom + 20.0], letters, label);
}

fn name_x(sheet: &mut Sheet, panel: &Frame, name: &str) {
    sheet.horizontal(panel.bottom, panel, Stroke::solid(QUIET, HAIRLINE));
    name_below(sheet, panel.across(), panel.bottom + 46.0, name);
}

fn draw_key(sheet: &mut Sheet, has_limit: bool) {
    let y = f64::from(HEIGHT) - 50.0;
    Key::new(sheet, SPEEDS.left, y)
        .dot(6.0, 2.6, FORWARD)
        .word("critical speeds")
        .shade(DIVERGENCE_STREAK)
        .word("divergence")
        .shade(FLUTTER_STREAK)
        .word("flutter")
        .ring(9.0, 4.5, Stroke::solid(ALARM, CURVE))
        .word("flutter speed");
    if has_limit {
        Key::new(sheet, DEFLECTION.left, y + 26.0)
            .line(24.0, Stroke::dashed(ALARM, CURVE, DASH))
            .word("largest deflection allowed");
    }
}
