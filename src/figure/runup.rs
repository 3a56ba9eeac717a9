//! The deflection over speed during a run-up, as in the paper's Figure 13.

use super::axis::{Axis, Spread, draw_named, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::clip;
use super::columns::draw_end_of_model;
use super::declutter::{Wish, push_apart};
use super::key::Key;
use super::style::{
    ALARM, CURVE, DIVERGENCE_SHADE, FINE_DASH, FLUTTER_SHADE, FORWARD, HAIRLINE, LABEL_SIZE, QUIET,
    Weight, text_width,
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
    heading::draw(&mut sheet, &title, &report.scene.name);
    let speeds = [report.from_rpm, report.to_rpm];
    let speed = Axis::new(speeds, [PANEL.left, PANEL.right], Spread::Linear);
    let largest_mm = report
        .deflection_m
        .iter()
        .fold(0.0_f64, |max, w| max.max(w.abs()))
        * 1e3;
    let reach = 1.1 * largest_mm.max(1e-6);
    let deflection = Axis::new([-reach, reach], [PANEL.bottom, PANEL.top], Spread::Linear);
    let found = report.bands.iter().map(|entry| &entry.band);
    bands::shade(&mut sheet, &speed, found, &[PANEL]);
    draw_vertical(&mut sheet, &deflection, &PANEL, "deflection\u{2003}[mm]");
    let name = "rotation speed Ω\u{2003}[rpm]";
    draw_named(&mut sheet, &speed, PANEL.bottom, name);
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
            // Strokes alternate in direction, so that the line does not jump back.
            if column % 2 == 0 {
                ends
            } else {
                [ends[1], ends[0]]
            }
        })
        .collect();
    for part in clip(&places, &PANEL) {
        sheet.line(part, Stroke::solid(FORWARD, 0.75 * CURVE));
    }
}

/// Draws the critical speeds as dashed lines, with their numbers above.
fn label_critical_speeds(sheet: &mut Sheet, report: &RunUpReport, speed: &Axis) {
    let labels: Vec<(f64, String)> = report
        .critical_speeds
        .iter()
        .filter(|critical| speed.shows(critical.rpm))
        .map(|critical| (speed.at(critical.rpm), format!("{:.0}", critical.rpm)))
        .collect();
    let wishes: Vec<Wish> = labels
        .iter()
        .map(|(x, text)| Wish {
            centre: *x,
            length: text_width(text, LABEL_SIZE, Weight::Regular) + 8.0,
        })
        .collect();
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    let places = push_apart(&wishes, PANEL.left, PANEL.right);
    for ((x, text), place) in labels.iter().zip(places) {
        let dashed = Stroke::dashed(QUIET, HAIRLINE, FINE_DASH);
        sheet.line([[*x, PANEL.top], [*x, PANEL.bottom]], dashed);
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
        let line = |sheet: &mut Sheet, [x, y]: [f64; 2]| {
            sheet.line(
                [[x, y - 7.0], [x, y + 7.0]],
                Stroke::solid(ALARM, 1.5 * HAIRLINE),
            );
        };
        key.mark(2.0, line).word(&format!(
            "more than {LINEAR_THICKNESSES} thicknesses: the linear model ends"
        ));
    }
}
