//! The deflection over speed during a run-up, as in the paper's Figure 13.

use super::axis::{Axis, SPEED, draw_named, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::columns::draw_end_of_model;
use super::declutter::{Extent, push_apart};
use super::key::Key;
use super::style::{
    ALARM, CURVE, DIVERGENCE_SHADE, FINE_DASH, FLUTTER_SHADE, FORWARD, HAIRLINE, LABEL_SIZE, QUIET,
};
use super::{bands, heading};
use crate::report::RunUpReport;
use crate::transient::LINEAR_THICKNESSES;

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 640;
const PANEL: Frame = Frame {
    left: 92.0,
    top: 130.0,
    right: 1160.0,
    bottom: 540.0,
};

pub fn sheet(report: &RunUpReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let title = format!(
        "Deflection at the probe in a run-up at {:.1} rpm/s",
        report.rate_rpm_per_s
    );
    heading::draw(
        &mut sheet,
        &title,
        &heading::of_saw(&report.scene.name, &report.condition),
    );
    let speed = Axis::linear([report.from_rpm, report.to_rpm], PANEL.across());
    let sizes = report.deflection_m.iter().map(|w| w.abs());
    let largest_mm = 1e3 * sizes.fold(0.0, f64::max);
    let reach = 1.1 * largest_mm.max(1e-6);
    let deflection = Axis::linear([-reach, reach], PANEL.upwards());
    let found = report.bands.iter().map(|entry| &entry.band);
    bands::shade(&mut sheet, &speed, found, &[PANEL]);
    draw_vertical(&mut sheet, &deflection, &PANEL, "deflection\u{2003}[mm]");
    draw_named(&mut sheet, &speed, PANEL.bottom, SPEED);
    label_critical_speeds(&mut sheet, report, &speed);
    draw_record(&mut sheet, report, &speed, &deflection);
    if let Some(until_rpm) = report.linear_until_rpm {
        draw_end_of_model(&mut sheet, &PANEL, speed.at(until_rpm));
    }
    draw_key(&mut sheet, report.linear_until_rpm.is_some());
    sheet
}

/// Draws the deflection. Thousands of samples have the same pixel as abscissa; a stroke from the smallest to the
/// largest of them looks like a line through all of them.
fn draw_record(sheet: &mut Sheet, report: &RunUpReport, speed: &Axis, deflection: &Axis) {
    let columns = (PANEL.right - PANEL.left) as usize;
    let mut extremes = vec![None::<[f64; 2]>; columns + 1];
    for (rpm, w) in report.rpm.iter().zip(&report.deflection_m) {
        let column = (speed.at(*rpm) - PANEL.left).clamp(0.0, columns as f64) as usize;
        let millimetres = 1e3 * w;
        extremes[column] = Some(extremes[column].map_or([millimetres; 2], |[low, high]| {
            [low.min(millimetres), high.max(millimetres)]
        }));
    }
    let places: Vec<[f64; 2]> = extremes
        .iter()
        .enumerate()
        .filter_map(|(column, extreme)| extreme.map(|ends| (column, ends)))
        .flat_map(|(column, [low, high])| {
            let x = PANEL.left + column as f64;
            let ends = [[x, deflection.at(low)], [x, deflection.at(high)]];
            // The strokes of neighbouring columns alternate in direction, because one line connects all of
            // them.
            match column % 2 == 0 {
                true => ends,
                false => [ends[1], ends[0]],
            }
        })
        .collect();
    draw_inside(sheet, &PANEL, &places, Stroke::solid(FORWARD, 0.75 * CURVE));
}

/// Draws the critical speeds as dashed lines, with their numbers above.
fn label_critical_speeds(sheet: &mut Sheet, report: &RunUpReport, speed: &Axis) {
    let labels: Vec<(f64, String)> = report
        .critical_speeds
        .iter()
        .filter(|critical| speed.shows(critical.rpm))
        .map(|critical| (speed.at(critical.rpm), format!("{:.0}", critical.rpm)))
        .collect();
    let extents = labels
        .iter()
        .map(|(x, text)| Extent::of_label(*x, text, 8.0));
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    let places = push_apart(extents, PANEL.across());
    for ((x, text), place) in labels.iter().zip(places) {
        sheet.vertical(*x, &PANEL, Stroke::dashed(QUIET, HAIRLINE, FINE_DASH));
        if let Some(place) = place {
            let leader = [[*x, PANEL.top], [place, PANEL.top - 12.0]];
            sheet.line(leader, Stroke::solid(QUIET, HAIRLINE));
            sheet.text([place, PANEL.top - 17.0], letters, text);
        }
    }
}

fn draw_key(sheet: &mut Sheet, model_ends: bool) {
    let mut key = Key::new(sheet, PANEL.left, f64::from(HEIGHT) - 26.0);
    key.shade(DIVERGENCE_SHADE)
        .word("divergence")
        .shade(FLUTTER_SHADE)
        .word("flutter")
        .word("dashed: critical speeds [rpm]");
    if model_ends {
        let text = format!("more than {LINEAR_THICKNESSES} thicknesses: the linear model ends");
        key.upright(2.0, 7.0, Stroke::solid(ALARM, 1.5 * HAIRLINE))
            .word(&text);
    }
}
