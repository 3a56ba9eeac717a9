//! The orbit of the centre of the blade on its arbor, one panel a speed.

use super::axis::{Axis, Spread, draw_named, draw_vertical};
use super::canvas::{Anchor, Lettering, Sheet, Stroke};
use super::columns::{Columns, name_of_row};
use super::style::{
    CURVE, FINE_DASH, FORWARD, HAIRLINE, INK, LABEL_SIZE, QUIET, STANDING, SUBTITLE_SIZE, Weight,
    tint,
};
use crate::report::{CutReport, CutRunEntry, SplineEntry};

/// Panels are square: a length is as long in x as in y.
const PANELS: Columns = Columns {
    lefts: [120.0, 700.0],
    top: 140.0,
    width: 420.0,
    height: 420.0,
    row: 560.0,
};

pub fn sheet(report: &CutReport) -> Option<Sheet> {
    let runs: Vec<(&CutRunEntry, &SplineEntry)> = report
        .runs
        .iter()
        .filter_map(|run| run.spline.as_ref().map(|spline| (run, spline)))
        .collect();
    if runs.is_empty() {
        return None;
    }
    let title = "Orbit of the blade's centre on the splined arbor in the cut";
    let mut sheet = PANELS.sheet(runs.len(), title, &report.scene.name);
    for (index, (run, spline)) in runs.into_iter().enumerate() {
        draw_orbit(&mut sheet, index, run, spline);
    }
    Some(sheet)
}

fn draw_orbit(sheet: &mut Sheet, index: usize, run: &CutRunEntry, spline: &SplineEntry) {
    let panel = &PANELS.panel(index);
    let all = spline.x_m.iter().chain(&spline.y_m);
    let largest_mm = 1e3 * all.fold(0.0_f64, |max, value| max.max(value.abs()));
    let clearance_mm = 1e3 * spline.clearance_m;
    let reach = 1.2 * largest_mm.max(clearance_mm).max(1e-6);
    let x = Axis::new([-reach, reach], [panel.left, panel.right], Spread::Linear);
    let y = Axis::new([-reach, reach], [panel.bottom, panel.top], Spread::Linear);
    let name = "a quarter turn further\u{2003}[mm]";
    draw_vertical(sheet, &y, panel, name_of_row(index, name));
    draw_named(
        sheet,
        &x,
        panel.bottom,
        "centre towards the cut\u{2003}[mm]",
    );
    for [from, to] in [
        [[x.at(0.0), panel.top], [x.at(0.0), panel.bottom]],
        [[panel.left, y.at(0.0)], [panel.right, y.at(0.0)]],
    ] {
        sheet.line([from, to], Stroke::solid(tint(STANDING, 0.6), HAIRLINE));
    }
    draw_clearance(sheet, (&x, &y), clearance_mm);
    let places: Vec<[f64; 2]> = spline
        .x_m
        .iter()
        .zip(&spline.y_m)
        .map(|(px, py)| [x.at(1e3 * px), y.at(1e3 * py)])
        .collect();
    let settled = spline.settled_from.min(places.len());
    let pale = Stroke::solid(tint(FORWARD, 0.35), HAIRLINE);
    sheet.line(places[..settled].iter().copied(), pale);
    sheet.line(
        places[settled..].iter().copied(),
        Stroke::solid(FORWARD, CURVE),
    );
    if let Some(last) = places.last() {
        sheet.disc(*last, 3.5, FORWARD);
    }
    let title = Lettering {
        weight: Weight::SemiBold,
        ..Lettering::regular(SUBTITLE_SIZE, INK, Anchor::Start)
    };
    let text = format!(
        "{:.0} rpm: {:.1} spline teeth in contact, {:.0} N at most on one",
        run.rpm, spline.teeth_in_contact, spline.peak_tooth_n
    );
    sheet.text([panel.left, panel.top - 32.0], title, &text);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let text = format!(
        "growth in the cut {:.2} 1/s assumed, {:.2} 1/s with this reaction",
        run.growth_per_s, spline.growth_per_s
    );
    sheet.text([panel.left, panel.top - 12.0], letters, &text);
}

/// What the play of the flanks would let a blade without torque do.
fn draw_clearance(sheet: &mut Sheet, (x, y): (&Axis, &Axis), clearance_mm: f64) {
    if clearance_mm <= 0.0 {
        return;
    }
    let circle = (0..=120).map(|k| {
        let (sin, cos) = (f64::from(k) / 120.0 * std::f64::consts::TAU).sin_cos();
        [x.at(clearance_mm * cos), y.at(clearance_mm * sin)]
    });
    let dashed = Stroke {
        dash: Some(FINE_DASH),
        ..Stroke::solid(QUIET, HAIRLINE)
    };
    sheet.line(circle, dashed);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    let at = [x.at(0.75 * clearance_mm), y.at(-1.08 * clearance_mm)];
    let text = format!("clearance {} mm", super::axis::tick_label(clearance_mm));
    sheet.text(at, letters, &text);
}
