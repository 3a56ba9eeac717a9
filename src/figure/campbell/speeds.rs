//! What belongs to single speeds: bands, critical speeds, the operating speed.

use super::super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use super::super::declutter::{Cluster, join_close};
use super::super::style::{
    Colour, DIVERGENCE, DIVERGENCE_SHADE, DIVERGENCE_STREAK, FINE_DASH, FLUTTER, FLUTTER_SHADE,
    FLUTTER_STREAK, HAIRLINE, INK, LABEL_SIZE, PAPER, QUIET, Weight, text_width,
};
use super::{Chart, MARGIN, WIDTH};
use crate::report::{InstabilityEntry, InstabilityKind};

/// Narrower bands get a stronger colour, and at least `STREAK_WIDTH`.
const NARROW: f64 = 4.0;
const STREAK_WIDTH: f64 = 1.5;
const CRITICAL_BASELINE: f64 = 90.0;

pub fn line_colour(kind: InstabilityKind) -> Colour {
    match kind {
        InstabilityKind::Divergence => DIVERGENCE,
        InstabilityKind::Flutter => FLUTTER,
    }
}

fn shade(kind: InstabilityKind, narrow: bool) -> Colour {
    match (kind, narrow) {
        (InstabilityKind::Divergence, false) => DIVERGENCE_SHADE,
        (InstabilityKind::Divergence, true) => DIVERGENCE_STREAK,
        (InstabilityKind::Flutter, false) => FLUTTER_SHADE,
        (InstabilityKind::Flutter, true) => FLUTTER_STREAK,
    }
}

/// Left and right edge of a band on the sheet, or `None` outside the sweep.
pub fn band_places(chart: &Chart, band: &InstabilityEntry) -> Option<[f64; 2]> {
    let [first, last] = chart.speed.values();
    let (from, to) = (band.from_rpm.max(first), band.to_rpm.min(last));
    if !(from <= to) {
        return None;
    }
    let [left, right] = [from, to].map(|rpm| chart.speed.at(rpm));
    let missing = (STREAK_WIDTH - (right - left)).max(0.0);
    Some([left - missing / 2.0, right + missing / 2.0])
}

pub fn shade_bands(sheet: &mut Sheet, chart: &Chart) {
    // Streaks last: a wide band must not hide a narrow one within it.
    for narrow in [false, true] {
        for band in &chart.report.instabilities {
            let Some([left, right]) = band_places(chart, band) else {
                continue;
            };
            if (right - left < NARROW) != narrow {
                continue;
            }
            for panel in [chart.upper, chart.lower] {
                sheet.fill(
                    Frame {
                        left,
                        right,
                        ..panel
                    },
                    shade(band.kind, narrow),
                );
            }
        }
    }
}

pub fn draw_critical(sheet: &mut Sheet, chart: &Chart) {
    let mut speeds: Vec<f64> = chart.report.critical_speeds.iter().map(|c| c.rpm).collect();
    speeds.retain(|rpm| chart.speed.shows(*rpm));
    speeds.sort_by(f64::total_cmp);
    let dashed = Stroke {
        colour: QUIET,
        width: HAIRLINE,
        dash: Some(FINE_DASH),
    };
    for &rpm in &speeds {
        let x = chart.speed.at(rpm);
        sheet.line(
            [[x, chart.upper.bottom], [x, CRITICAL_BASELINE + 5.0]],
            dashed,
        );
        sheet.disc([x, chart.upper.bottom], 3.5, INK);
    }
    label_critical(sheet, chart, &speeds);
}

fn label_critical(sheet: &mut Sheet, chart: &Chart, speeds: &[f64]) {
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Middle);
    let gap = 12.0;
    let width = |label: &str| text_width(label, LABEL_SIZE, Weight::Regular) + gap;
    let ends = [MARGIN, f64::from(WIDTH) - MARGIN];
    let clusters = join_close(speeds, |rpm| chart.speed.at(rpm), width, ends);
    for Cluster { centre, label, .. } in &clusters {
        sheet.text([*centre, CRITICAL_BASELINE], letters, label);
    }
    let Some(first) = clusters.first() else {
        return;
    };
    let caption = "critical [rpm]";
    if MARGIN + width(caption) < first.centre - width(&first.label) / 2.0 {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        sheet.text([MARGIN, CRITICAL_BASELINE], letters, caption);
    }
}

/// Place of the operating speed on the sheet.
pub fn operating_place(chart: &Chart) -> Option<f64> {
    let rpm = chart.report.scene.operating_rpm?;
    chart.speed.shows(rpm).then(|| chart.speed.at(rpm))
}

pub fn draw_operating(sheet: &mut Sheet, chart: &Chart) {
    if let Some(x) = operating_place(chart) {
        for panel in [&chart.upper, &chart.lower] {
            let line = [[x, panel.top], [x, panel.bottom]];
            sheet.line(line, Stroke::solid(INK, HAIRLINE));
        }
    }
}

pub fn label_operating(sheet: &mut Sheet, chart: &Chart) {
    let (Some(x), Some(rpm)) = (operating_place(chart), chart.report.scene.operating_rpm) else {
        return;
    };
    let label = format!("operating {rpm:.0}");
    let room = text_width(&label, LABEL_SIZE, Weight::Regular) + 10.0;
    let (at, anchor) = match x + room < chart.upper.right {
        true => (x + 5.0, Anchor::Start),
        false => (x - 5.0, Anchor::End),
    };
    let letters = Lettering::regular(LABEL_SIZE, INK, anchor);
    let at = [at, chart.upper.top + 16.0];
    let Frame {
        left,
        top,
        right,
        bottom,
    } = text_frame(at, &letters, &label);
    let cleared = Frame {
        left: left - 3.0,
        right: right + 3.0,
        top: top - 1.0,
        bottom: bottom + 1.0,
    };
    sheet.fill(cleared, PAPER);
    sheet.text(at, letters, &label);
}
