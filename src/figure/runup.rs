//! The deflection over speed while the saw runs up, as in the paper's Figure 13.

use super::axis::{Axis, Spread, draw_horizontal, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::clip;
use super::declutter::{Wish, push_apart};
use super::key::Key;
use super::style::{
    ALARM, AXIS_SIZE, CURVE, DIVERGENCE_SHADE, FINE_DASH, FLUTTER_SHADE, FORWARD, HAIRLINE, INK,
    LABEL_SIZE, QUIET, Weight, text_width,
};
use super::{FigureError, bands, heading, render};
use crate::report::RunUpReport;

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 640;
const PANEL: Frame = Frame {
    left: 92.0,
    top: 130.0,
    right: 1160.0,
    bottom: 540.0,
};
/// The scale ends at this many thicknesses of the blade.
const BELIEVABLE_THICKNESSES: f64 = 5.0;

/// The run-up as PNG, 1200 × 640 pixels.
pub fn runup_png(report: &RunUpReport) -> Result<Vec<u8>, FigureError> {
    render::png(&sheet(report))
}

/// The run-up as SVG.
pub fn runup_svg(report: &RunUpReport) -> Result<String, FigureError> {
    render::svg(&sheet(report))
}

pub(super) fn sheet(report: &RunUpReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let title = format!(
        "Deflection at the probe in a run-up at {:.1} rpm/s",
        report.rate_rpm_per_s
    );
    heading::draw(&mut sheet, &title, &report.scene.name);
    let ends = |values: &[f64]| {
        let first = values.first().copied().unwrap_or(0.0);
        [first, values.last().copied().unwrap_or(1.0)]
    };
    let speed = Axis::new(ends(&report.rpm), [PANEL.left, PANEL.right], Spread::Linear);
    let largest_mm = report
        .deflection_m
        .iter()
        .fold(0.0_f64, |max, w| max.max(w.abs()))
        * 1e3;
    // Past some thicknesses of the blade the linear model only knows that it grows.
    let believable_mm = BELIEVABLE_THICKNESSES * 1e3 * report.scene.blade.thickness_m;
    let reach = 1.1 * largest_mm.clamp(1e-6, believable_mm);
    let deflection = Axis::new(
        [-reach, reach],
        [PANEL.bottom, PANEL.top],
        Spread::SignedRoot,
    );
    let found = report.bands.iter().map(|entry| &entry.band);
    bands::shade(&mut sheet, &speed, found, &[PANEL]);
    draw_vertical(
        &mut sheet,
        &deflection,
        &PANEL,
        "deflection\u{2003}[mm], root scale",
    );
    draw_horizontal(&mut sheet, &speed, PANEL.bottom, true);
    let letters = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    let centre = (PANEL.left + PANEL.right) / 2.0;
    let name = "rotation speed Ω\u{2003}[rpm]";
    sheet.text([centre, PANEL.bottom + 42.0], letters, name);
    label_critical_speeds(&mut sheet, report, &speed);
    let lost_at = report
        .rpm
        .iter()
        .zip(&report.deflection_m)
        .find(|(_, w)| 1e3 * w.abs() > believable_mm)
        .map(|(rpm, _)| *rpm);
    draw_record(&mut sheet, report, (&speed, &deflection), lost_at);
    if let Some(lost_at) = lost_at {
        draw_end_of_model(&mut sheet, speed.at(lost_at));
    }
    draw_key(&mut sheet);
    sheet
}

/// Thousands of samples fall on one pixel: a stroke from the least to the greatest of each
/// shows what a line through all of them would.
fn draw_record(
    sheet: &mut Sheet,
    report: &RunUpReport,
    (speed, deflection): (&Axis, &Axis),
    until_rpm: Option<f64>,
) {
    let columns = (PANEL.right - PANEL.left) as usize;
    let mut extremes = vec![None::<[f64; 2]>; columns + 1];
    let record = report.rpm.iter().zip(&report.deflection_m);
    for (rpm, w) in record.take_while(|(rpm, _)| until_rpm.is_none_or(|until| **rpm <= until)) {
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
            // Up and down in turn, so that the line does not jump back.
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

/// What follows is growth upon growth, of which a linear model knows the rate alone.
fn draw_end_of_model(sheet: &mut Sheet, x: f64) {
    let line = [[x, PANEL.top], [x, PANEL.bottom]];
    sheet.line(line, Stroke::solid(ALARM, 1.5 * HAIRLINE));
    let text =
        format!("more than {BELIEVABLE_THICKNESSES} thicknesses: the linear model ends here");
    let length = text_width(&text, LABEL_SIZE, Weight::Regular) + 16.0;
    let (anchor, x) = match PANEL.right - x < length {
        true => (Anchor::End, x - 8.0),
        false => (Anchor::Start, x + 8.0),
    };
    let letters = Lettering::regular(LABEL_SIZE, ALARM, anchor);
    sheet.text([x, PANEL.bottom - 10.0], letters, &text);
}

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
        let dashed = Stroke {
            dash: Some(FINE_DASH),
            ..Stroke::solid(QUIET, HAIRLINE)
        };
        sheet.line([[*x, PANEL.top], [*x, PANEL.bottom]], dashed);
        if let Some(place) = place {
            let leader = [[*x, PANEL.top], [place, PANEL.top - 12.0]];
            sheet.line(leader, Stroke::solid(QUIET, HAIRLINE));
            sheet.text([place, PANEL.top - 17.0], letters, text);
        }
    }
}

fn draw_key(sheet: &mut Sheet) {
    Key::new(sheet, PANEL.left, f64::from(HEIGHT) - 26.0)
        .shade(DIVERGENCE_SHADE)
        .word("divergence")
        .shade(FLUTTER_SHADE)
        .word("flutter")
        .word("dashed: critical speeds [rpm]");
}
