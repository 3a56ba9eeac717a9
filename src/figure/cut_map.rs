//! The verdict over guide angle and load level, one panel a speed.

use super::axis::{Axis, Spread, draw_horizontal, draw_vertical, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::heat::{draw_grid, draw_scale, ramp};
use super::style::{
    AXIS_SIZE, Colour, HAIRLINE, INK, LABEL_SIZE, PAPER, QUIET, SUBTITLE_SIZE, Weight,
};
use super::{FigureError, heading, render};
use crate::report::{CutReport, CutRunEntry};

const WIDTH: u32 = 1200;
const ROW: f64 = 450.0;
const FIRST_TOP: f64 = 124.0;
const PLOT_HEIGHT: f64 = 320.0;
const COLUMNS: [[f64; 2]; 2] = [[92.0, 530.0], [610.0, 1048.0]];
const SCALE: [f64; 2] = [1088.0, 1108.0];

/// Stable, and from slow to fast growth: pale to dark, so that grey prints read too.
const STABLE: Colour = plotters::style::RGBColor(226, 234, 242);
const GROWING: [Colour; 4] = [
    plotters::style::RGBColor(255, 236, 190),
    plotters::style::RGBColor(240, 178, 62),
    plotters::style::RGBColor(190, 84, 30),
    plotters::style::RGBColor(92, 18, 32),
];

/// The map as PNG, 1200 pixels wide.
pub fn cut_map_png(report: &CutReport) -> Result<Vec<u8>, FigureError> {
    render::png(&sheet(report))
}

/// The map as SVG.
pub fn cut_map_svg(report: &CutReport) -> Result<String, FigureError> {
    render::svg(&sheet(report))
}

pub(super) fn sheet(report: &CutReport) -> Sheet {
    let rows = report.runs.len().div_ceil(2).max(1);
    let mut sheet = Sheet::new(WIDTH, (60.0 + ROW * rows as f64) as u32);
    heading::draw(
        &mut sheet,
        "Growth in the cut over the angle of the guides and the load",
        &report.scene.name,
    );
    let growths = report
        .runs
        .iter()
        .flat_map(|run| run.map.growth_per_s.iter().flatten());
    let fastest = growths.fold(0.0_f64, |max, growth| max.max(*growth));
    let fastest = fastest.max(4.0 * report.flutter_threshold_per_s);
    let shade = |growth: f64| {
        if growth < report.flutter_threshold_per_s {
            STABLE
        } else {
            ramp(&GROWING, growth / fastest)
        }
    };
    for (index, run) in report.runs.iter().enumerate() {
        let top = FIRST_TOP + ROW * (index / 2) as f64;
        let [left, right] = COLUMNS[index % 2];
        let panel = Frame {
            left,
            top,
            right,
            bottom: top + PLOT_HEIGHT,
        };
        draw_map(&mut sheet, &panel, run, index % 2 == 0, shade);
        draw_own_point(&mut sheet, &panel, report, run);
    }
    let scale = Frame {
        left: SCALE[0],
        top: FIRST_TOP + 10.0,
        right: SCALE[1],
        bottom: FIRST_TOP + PLOT_HEIGHT,
    };
    let axis = Axis::new([0.0, fastest], [scale.bottom, scale.top], Spread::Linear);
    draw_scale(
        &mut sheet,
        &scale,
        &axis,
        "growth [1/s]",
        (shade, |v| Some(tick_label(v))),
    );
    sheet
}

/// Axes of a map: guide angle and load level.
fn axes(panel: &Frame, run: &CutRunEntry) -> (Axis, Axis) {
    let ends = |values: &[f64]| {
        let first = values.first().copied().unwrap_or(0.0);
        [first, values.last().copied().unwrap_or(1.0)]
    };
    (
        Axis::new(
            ends(&run.map.guide_angle_deg),
            [panel.left, panel.right],
            Spread::Linear,
        ),
        Axis::new(
            ends(&run.map.load_level),
            [panel.bottom, panel.top],
            Spread::Linear,
        ),
    )
}

fn draw_map(
    sheet: &mut Sheet,
    panel: &Frame,
    run: &CutRunEntry,
    first: bool,
    shade: impl Fn(f64) -> Colour,
) {
    let (angle, level) = axes(panel, run);
    let name = if first {
        "load\u{2003}[of the scene's]"
    } else {
        ""
    };
    draw_vertical(sheet, &level, panel, name);
    draw_grid(
        sheet,
        (&angle, &run.map.guide_angle_deg),
        (&level, &run.map.load_level),
        |column, row| {
            let growth = run
                .map
                .growth_per_s
                .get(row)
                .and_then(|row| row.get(column));
            growth.map_or(PAPER, |growth| shade(*growth))
        },
    );
    draw_horizontal(sheet, &angle, panel.bottom, true);
    let letters = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    let centre = (panel.left + panel.right) / 2.0;
    let name = "angle of the first guide, the cut at its own\u{2003}[°]";
    sheet.text([centre, panel.bottom + 42.0], letters, name);
    let title = Lettering {
        weight: Weight::SemiBold,
        ..Lettering::regular(SUBTITLE_SIZE, INK, Anchor::Start)
    };
    let text = format!(
        "{:.0} rpm, {:.0} N against and {:.0} N inwards a tooth at load 1",
        run.rpm, run.tangential_n_per_tooth, run.radial_n_per_tooth
    );
    sheet.text([panel.left, panel.top - 14.0], title, &text);
}

/// The scene itself, and the force that its power allows.
fn draw_own_point(sheet: &mut Sheet, panel: &Frame, report: &CutReport, run: &CutRunEntry) {
    let (angle, level) = axes(panel, run);
    let own_deg = report
        .scene
        .guides
        .first()
        .map_or(0.0, |guide| guide.angle_deg);
    let x = angle.at(own_deg);
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Start);
    let stroke = Stroke::solid(INK, 1.5 * HAIRLINE);
    sheet.ring([x, level.at(1.0)], 5.0, stroke, PAPER);
    sheet.text([x + 11.0, level.at(1.0) + 4.0], letters, "this saw");
    if let Some(by_power) = &run.by_power {
        let share = by_power.tangential_n_per_tooth / run.tangential_n_per_tooth;
        if share < 0.9 {
            let y = level.at(share);
            sheet.ring([x, y], 4.0, Stroke::solid(QUIET, HAIRLINE), PAPER);
            sheet.text([x + 11.0, y + 4.0], letters, "force that the power allows");
        }
    }
}
