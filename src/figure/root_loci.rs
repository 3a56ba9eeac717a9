//! Root loci: the two eigenvalues that meet at the flutter onset, in the complex
//! plane, and beside it over rotation speed.

mod labels;
mod plane;
mod tracks;

use super::axis::{Axis, Spread, draw_horizontal, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use super::declutter::{Wish, push_apart};
use super::style::{
    AXIS_SIZE, BACKWARD, BETWEEN_FACTS, Colour, FINE_DASH, FLUTTER, FLUTTER_SHADE, FORWARD, GRID,
    HAIRLINE, INK, LABEL_SIZE, MARGIN, QUIET, STANDING, Weight, tint,
};
use super::{heading, is_damped};
use crate::report::Report;
use tracks::{Loci, Look, Sample, Track};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 800;
const PLOT_TOP: f64 = 110.0;
const PLOT_BOTTOM: f64 = 706.0;
const PLANE: [f64; 2] = [92.0, 772.0];
const SPEED: [f64; 2] = [812.0, 1152.0];
const SIGN_SIZE: f64 = 15.0;
/// Smaller growth rates are taken for rounding errors of the eigenvalues.
const NEGLIGIBLE_PER_S: f64 = 1e-3;

/// What the parts of the figure share.
struct Chart {
    loci: Loci,
    growth: Axis,
    frequency: Axis,
    speed: Axis,
    plane: Frame,
    over_speed: Frame,
    /// Decimals that tell the speeds apart.
    decimals: usize,
}

pub fn sheet(report: &Report) -> Option<Sheet> {
    let entry = report.root_loci.as_ref()?;
    let chart = Chart::new(Loci::new(entry, is_damped(report))?);
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let title = format!(
        "Root loci around the flutter onset at {:.0} rpm",
        entry.onset_rpm
    );
    heading::draw(&mut sheet, &title, &report.scene.name);
    draw_axes(&mut sheet, &chart);
    draw_over_speed(&mut sheet, &chart);
    plane::draw(&mut sheet, &chart);
    labels::draw(&mut sheet, &chart);
    draw_notes(&mut sheet, &chart);
    Some(sheet)
}

impl Chart {
    fn new(loci: Loci) -> Self {
        let range = |of: fn(&Sample) -> f64| {
            let values = loci.samples().map(of);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            })
        };
        let [low, high] = range(|s| s.growth).map(|v| if v.is_finite() { v } else { 0.0 });
        let (low, high) = (low.min(0.0), high.max(0.0));
        // Room for the labels at the outermost points.
        let room = 0.62 * high.max(-low).max(NEGLIGIBLE_PER_S);
        let [bottom, top] = range(|s| s.hz);
        let air = (0.08 * (top - bottom)).max(1e-3 * top.abs());
        let speeds = range(|s| s.rpm);
        let panel = |[left, right]: [f64; 2]| Frame {
            left,
            top: PLOT_TOP,
            right,
            bottom: PLOT_BOTTOM,
        };
        let upwards = [PLOT_BOTTOM, PLOT_TOP];
        let band = loci.end.rpm - loci.onset.rpm;
        Self {
            growth: Axis::new([low - room, high + room], PLANE, Spread::Linear),
            frequency: Axis::new([bottom - air, top + air], upwards, Spread::Linear),
            speed: Axis::new(speeds, SPEED, Spread::Linear),
            plane: panel(PLANE),
            over_speed: panel(SPEED),
            decimals: (5.0 / band).log10().ceil().clamp(0.0, 3.0) as usize,
            loci,
        }
    }

    fn rpm(&self, rpm: f64) -> String {
        format!("{rpm:.*}", self.decimals)
    }
}

fn colour(look: Look) -> Colour {
    match look {
        Look::Plus => FORWARD,
        Look::Minus => BACKWARD,
        Look::Damped(0) => INK,
        Look::Damped(_) => STANDING,
        Look::Growing => FLUTTER,
        Look::Decaying => tint(FLUTTER, 0.5),
    }
}

fn draw_axes(sheet: &mut Sheet, chart: &Chart) {
    draw_vertical(
        sheet,
        &chart.frequency,
        &chart.plane,
        "Im λ / 2π\u{2003}[Hz]",
    );
    let Frame { left, right, .. } = chart.over_speed;
    for tick in chart.frequency.ticks(40.0) {
        let y = chart.frequency.at(tick);
        sheet.line([[left, y], [right, y]], Stroke::solid(GRID, HAIRLINE));
    }
    for panel in [&chart.plane, &chart.over_speed] {
        let side = [[panel.left, panel.top], [panel.left, panel.bottom]];
        sheet.line(side, Stroke::solid(QUIET, HAIRLINE));
    }
    draw_horizontal(sheet, &chart.growth, PLOT_BOTTOM, true);
    draw_horizontal(sheet, &chart.speed, PLOT_BOTTOM, true);
    let letters = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    let names = [
        (PLANE, "Re λ\u{2003}[1/s]"),
        (SPEED, "rotation speed Ω\u{2003}[rpm]"),
    ];
    for ([left, right], name) in names {
        sheet.text([(left + right) / 2.0, PLOT_BOTTOM + 42.0], letters, name);
    }
}

/// The same two modes over speed, on the same frequency axis.
fn draw_over_speed(sheet: &mut Sheet, chart: &Chart) {
    let Loci {
        onset, end, peak, ..
    } = chart.loci;
    let [left, right] = [onset, end].map(|sample| chart.speed.at(sample.rpm));
    let band = Frame {
        left,
        right,
        ..chart.over_speed
    };
    sheet.fill(band, FLUTTER_SHADE);
    let name = format!("flutter {}–{}", chart.rpm(onset.rpm), chart.rpm(end.rpm));
    let letters = Lettering::regular(LABEL_SIZE, FLUTTER, Anchor::Middle);
    let length = text_frame([0.0, 0.0], &letters, &name).right * 2.0;
    let ends = [
        SPEED[0] + length / 2.0,
        f64::from(WIDTH) - MARGIN - length / 2.0,
    ];
    let middle = ((left + right) / 2.0).min(ends[1]).max(ends[0]);
    sheet.text([middle, PLOT_TOP - 8.0], letters, &name);

    // From panel to panel, so that the eye finds the same event in both.
    let leader = Stroke {
        dash: Some(FINE_DASH),
        ..Stroke::solid(tint(QUIET, 0.6), HAIRLINE)
    };
    for sample in [onset, end] {
        let [x, y] = [chart.speed.at(sample.rpm), chart.frequency.at(sample.hz)];
        sheet.line([[chart.plane.right, y], [x, y]], leader);
    }
    let place = |s: &Sample| [chart.speed.at(s.rpm), chart.frequency.at(s.hz)];
    for track in &chart.loci.tracks {
        let width = plane::width(track.look);
        let line: Vec<_> = track.samples.iter().map(place).collect();
        sheet.line(line, Stroke::solid(colour(track.look), width));
    }
    for sample in [onset, end] {
        sheet.disc(place(&sample), 4.0, INK);
    }
    sheet.disc(place(&peak), 4.0, FLUTTER);
    draw_signs(sheet, chart);
}

/// The Krein signs at the outer ends of the lines over speed.
fn draw_signs(sheet: &mut Sheet, chart: &Chart) {
    let [left, right] = SPEED;
    let first = |track: &Track| track.samples.first().copied();
    let last = |track: &Track| track.samples.last().copied();
    draw_signs_at(sheet, chart, &first, left, (left - 8.0, Anchor::End));
    draw_signs_at(sheet, chart, &last, right, (right + 8.0, Anchor::Start));
}

/// The signs of the tracks of which one end lies at the given edge.
fn draw_signs_at(
    sheet: &mut Sheet,
    chart: &Chart,
    end: &dyn Fn(&Track) -> Option<Sample>,
    edge: f64,
    (x, anchor): (f64, Anchor),
) {
    let signed = chart.loci.tracks.iter().filter_map(|track| {
        let (sign, sample) = (labels::sign(track.look)?, end(track)?);
        let at_edge = (chart.speed.at(sample.rpm) - edge).abs() < 0.5;
        let wish = Wish {
            centre: chart.frequency.at(sample.hz),
            length: SIGN_SIZE,
        };
        at_edge.then_some((sign, colour(track.look), wish))
    });
    let signed: Vec<_> = signed.collect();
    let wishes: Vec<_> = signed.iter().map(|(_, _, wish)| *wish).collect();
    let centres = push_apart(&wishes, PLOT_TOP, PLOT_BOTTOM);
    for ((sign, colour, _), centre) in signed.into_iter().zip(centres) {
        let letters = Lettering {
            weight: Weight::SemiBold,
            ..Lettering::regular(SIGN_SIZE, colour, anchor)
        };
        if let Some(centre) = centre {
            sheet.text([x, centre + 0.36 * SIGN_SIZE], letters, sign);
        }
    }
}

fn draw_notes(sheet: &mut Sheet, chart: &Chart) {
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let baseline = f64::from(HEIGHT) - 16.0;
    let arrows = "arrows: rising rotation speed";
    let notes = match chart.loci.merge {
        true => [
            arrows,
            "+ and − are Krein signs",
            "where Re λ = 0 the two paths are drawn beside the axis, not on each other",
        ]
        .join(BETWEEN_FACTS),
        false => [
            arrows,
            "with damping the modes pass each other without merging",
        ]
        .join(BETWEEN_FACTS),
    };
    sheet.text([PLANE[0], baseline], letters, &notes);
}

#[cfg(test)]
mod tests;
