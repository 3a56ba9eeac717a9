//! Lines and labels of the critical speeds and of the operating speed.

use super::plan::{Chart, WIDTH};
use super::waves;
use crate::analyses::campbell::CriticalSpeed;
use crate::page::figure::bands::places;
use crate::page::figure::canvas::{Anchor, Frame, Lettering, Mark, Sheet, Stroke, text_frame};
use crate::page::figure::items::{Role, Upright};
use crate::page::figure::label_placement::{Cluster, join_close};
use crate::page::figure::style::{
    FINE_DASH, HAIRLINE, INK, LABEL_SIZE, MARGIN, PAPER, QUIET, label_width,
};

/// Baseline of the critical speeds above the diagram.
const CRITICAL_BASELINE: f64 = 83.0;
/// Baseline of the names of their waves.
const WAVES_BASELINE: f64 = 97.0;
/// Upper end of their dashed lines.
const CRITICAL_TOP: f64 = 101.0;
/// Smallest width of a label, which the name of the wave needs.
const LEAST_WIDTH: f64 = 44.0;

/// Critical speeds on the axis in rpm, ascending.
fn critical_shown(chart: &Chart) -> Vec<f64> {
    let all = chart.uprights(Role::Critical).map(|upright| upright.x);
    let mut shown: Vec<f64> = all.filter(|rpm| chart.speed.shows(*rpm)).collect();
    shown.sort_by(f64::total_cmp);
    shown
}

pub fn draw_critical(sheet: &mut Sheet, chart: &Chart) {
    let speeds = critical_shown(chart);
    let dashed = Stroke::dashed(QUIET, HAIRLINE, FINE_DASH);
    for &rpm in &speeds {
        let x = chart.speed.at(rpm);
        sheet.line([[x, chart.upper.bottom], [x, CRITICAL_TOP]], dashed);
    }
    label_critical(sheet, chart, &speeds);
}

fn label_critical(sheet: &mut Sheet, chart: &Chart, speeds: &[f64]) {
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Middle);
    let gap = 12.0;
    let width = |label: &str| label_width(label).max(LEAST_WIDTH) + gap;
    let ends = [MARGIN, f64::from(WIDTH) - MARGIN];
    let clusters = join_close(speeds, |rpm| chart.speed.at(rpm), width, ends);
    for Cluster {
        centre,
        label,
        values,
    } in &clusters
    {
        sheet.text([*centre, CRITICAL_BASELINE], letters, label);
        let waves = waves_at(chart, values);
        sheet.text([*centre, WAVES_BASELINE], letters, &waves);
    }
    let Some(first) = clusters.first() else {
        return;
    };
    let of_speeds = if chart.report.critical_speeds_without_damping {
        "undamped critical [rpm]"
    } else {
        "critical [rpm]"
    };
    let captions = [of_speeds, "nodal diameters"];
    if MARGIN + width(captions[0]).max(width(captions[1]))
        < first.centre - width(&first.label) / 2.0
    {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
        for (caption, baseline) in captions
            .into_iter()
            .zip([CRITICAL_BASELINE, WAVES_BASELINE])
        {
            sheet.text([MARGIN, baseline], letters, caption);
        }
    }
}

/// Names of the waves that stand still at some critical speeds, in the order of the speeds: "n = 2", "n = 3 · 2",
/// "n = 2 … 13".
fn waves_at(chart: &Chart, speeds: &[f64]) -> String {
    let entries = &chart.report.critical_speeds;
    let at = |rpm: &f64| entries.iter().find(|entry| entry.rpm == *rpm);
    let mut waves: Vec<String> = speeds.iter().filter_map(at).map(wave).collect();
    if waves.windows(2).all(|pair| pair[0] == pair[1]) {
        waves.truncate(1);
    }
    match &waves[..] {
        [first, .., last] if waves.len() > 3 => format!("n = {first} … {last}"),
        _ => format!("n = {}", waves.join(" · ")),
    }
}

/// Nodal diameters of a wave: "2", with nodal circles "2/1", or, if no wave dominates, "4+3".
fn wave(entry: &CriticalSpeed) -> String {
    let shares = entry.name.split(" + ");
    let first = |share: &str| share.split(' ').next().unwrap_or_default().to_owned();
    match entry.nodal_circles {
        _ if entry.name.contains('%') => shares.map(first).collect::<Vec<_>>().join("+"),
        0 => entry.nodal_diameters.to_string(),
        circles => format!("{}/{circles}", entry.nodal_diameters),
    }
}

/// The operating speed, if it is on the axis.
fn operating<'a>(chart: &'a Chart) -> Option<&'a Upright> {
    let upright = chart.uprights(Role::Operating).next()?;
    chart.speed.shows(upright.x).then_some(upright)
}

/// Position of the operating speed on the sheet, if it is on the axis.
pub fn operating_place(chart: &Chart) -> Option<f64> {
    operating(chart).map(|upright| chart.speed.at(upright.x))
}

pub fn draw_operating(sheet: &mut Sheet, chart: &Chart) {
    if let Some(x) = operating_place(chart) {
        for panel in [&chart.upper, &chart.lower] {
            sheet.vertical(x, panel, Stroke::solid(INK, HAIRLINE));
        }
    }
}

/// Writes the operating speed above its line, or beside the line at the highest position that is free of other text
/// and of curves.
pub fn label_operating(sheet: &mut Sheet, chart: &Chart) {
    let Some(upright) = operating(chart) else {
        return;
    };
    let (label, x) = (&upright.label, chart.speed.at(upright.x));
    let above = ([x, chart.upper.top - 6.0], Anchor::Middle);
    let sides = [(x + 6.0, Anchor::Start), (x - 6.0, Anchor::End)];
    let rows = (0..)
        .map(|row| chart.upper.top + 16.0 + 4.0 * f64::from(row))
        .take_while(|baseline| *baseline < chart.upper.bottom - 6.0);
    let beside = rows.flat_map(|baseline| sides.map(|(x, anchor)| ([x, baseline], anchor)));
    let candidates = std::iter::once(above).chain(beside).map(|(at, anchor)| {
        let letters = Lettering::regular(LABEL_SIZE, INK, anchor);
        (at, letters, text_frame(at, &letters, label))
    });
    let cost = |frame: &Frame| {
        let outside = frame.left < chart.upper.left || frame.right > chart.upper.right;
        let crossed = waves::is_crossed(chart, frame);
        let upright = is_on_upright(chart, frame);
        (outside, hides_text(sheet, frame), crossed, upright)
    };
    let best = candidates.min_by_key(|(_, _, frame)| cost(frame));
    let Some((at, letters, frame)) = best else {
        return;
    };
    if waves::is_crossed(chart, &frame) || is_on_upright(chart, &frame) {
        sheet.fill(frame, PAPER);
    }
    sheet.text(at, letters, label);
}

/// Whether the frame overlaps a text of the sheet.
fn hides_text(sheet: &Sheet, frame: &Frame) -> bool {
    sheet.marks().iter().any(|mark| match mark {
        Mark::Text(at, letters, text) => text_frame(*at, letters, text).overlaps(frame),
        _ => false,
    })
}

/// Whether the frame overlaps a band or the dashed line of a critical speed.
fn is_on_upright(chart: &Chart, frame: &Frame) -> bool {
    // Bands extend up to the upper edge of the panel, the lines of critical speeds beyond it.
    let within = frame.bottom > chart.upper.top;
    let bands = chart
        .bands()
        .filter(|_| within)
        .filter_map(|band| places(&chart.speed, [band.from, band.to]));
    let critical = critical_shown(chart)
        .into_iter()
        .map(|rpm| [chart.speed.at(rpm); 2]);
    bands
        .chain(critical)
        .any(|[left, right]| left < frame.right + 2.0 && frame.left - 2.0 < right)
}
