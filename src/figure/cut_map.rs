//! The verdict over guide angle and load level, one panel for each speed.

use super::axis::{Axis, Spread, draw_named, draw_vertical, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::columns::{Columns, name_of_row};
use super::heading::of_saw;
use super::heat::{draw_grid, draw_scale, ramp};
use super::style::{
    CURVE, Colour, FINE_DASH, FORWARD, HAIRLINE, INK, LABEL_SIZE, PAPER, QUIET, SUBTITLE_SIZE,
    Weight, shorten,
};
use crate::analyses::cut::{CutAtSpeed, CutReport};
use crate::report::Verdict;

const PANELS: Columns = Columns {
    lefts: [92.0, 610.0],
    top: 124.0,
    width: 438.0,
    alone: 956.0,
    height: 320.0,
    row: 450.0,
};
const SCALE: [f64; 2] = [1088.0, 1108.0];

/// Name of the axis of the load.
const LOAD: &str = "load\u{2003}[of the scene's]";

/// Colour of stability.
const STABLE: Colour = plotters::style::RGBColor(226, 234, 242);
/// Colours from slow to fast growth: pale to dark, so that grey prints are legible too.
const GROWING: [Colour; 4] = [
    plotters::style::RGBColor(255, 236, 190),
    plotters::style::RGBColor(240, 178, 62),
    plotters::style::RGBColor(190, 84, 30),
    plotters::style::RGBColor(92, 18, 32),
];

pub fn sheet(report: &CutReport) -> Sheet {
    if report.scene.guides.is_empty() {
        return over_load(report);
    }
    let title = "Growth in the cut over the angle of the guides and the load";
    let panels = report.runs.len();
    let mut sheet = PANELS.sheet(
        panels,
        title,
        &of_saw(&report.scene.name, &report.condition),
    );
    let fastest = fastest_growth(report);
    let shade = |growth: f64| ramp(&GROWING, growth / fastest);
    let on_scale = |growth: f64| match growth < report.flutter_threshold_per_s {
        true => STABLE,
        false => shade(growth),
    };
    for (index, run) in report.runs.iter().enumerate() {
        let panel = PANELS.panel(index, panels);
        draw_map(&mut sheet, (&panel, name_of_row(index, LOAD)), run, shade);
        draw_own_point(&mut sheet, &panel, report, run);
    }
    draw_scale(
        &mut sheet,
        (&PANELS.panel(0, panels), 10.0, SCALE),
        ([0.0, fastest], Spread::Linear),
        "growth [1/s]",
        (on_scale, |v| Some(tick_label(v))),
    );
    sheet
}

/// Upper end of the scale of growth in 1/s, at least four times the threshold.
fn fastest_growth(report: &CutReport) -> f64 {
    let maps = report.runs.iter().map(|run| &run.map.growth_per_s);
    let fastest = maps.flatten().flatten().copied().fold(0.0_f64, f64::max);
    fastest.max(4.0 * report.flutter_threshold_per_s)
}

/// Lower end of the axis of growth in 1/s: negative if every motion decays at some load, otherwise zero.
fn slowest_growth(report: &CutReport) -> f64 {
    let maps = report.runs.iter().map(|run| &run.map.growth_per_s);
    let own = report.runs.iter().map(|run| run.growth_per_s);
    let all = maps.flatten().flatten().copied().chain(own);
    // The factor leaves room for the ring at the load of the scene.
    1.2 * all.fold(0.0, f64::min)
}

/// Axes of a map: guide angle and load level.
fn axes(panel: &Frame, run: &CutAtSpeed) -> (Axis, Axis) {
    (
        Axis::over(&run.map.guide_angle_deg, panel.across()),
        Axis::over(&run.map.load_level, panel.upwards()),
    )
}

fn draw_map(
    sheet: &mut Sheet,
    (panel, load): (&Frame, &str),
    run: &CutAtSpeed,
    shade: impl Fn(f64) -> Colour,
) {
    let (angle, level) = axes(panel, run);
    draw_vertical(sheet, &level, panel, load);
    draw_grid(
        sheet,
        (&angle, &run.map.guide_angle_deg),
        (&level, &run.map.load_level),
        |column, row| {
            let cell = |row: &Vec<f64>| row.get(column).copied();
            let growth = run.map.growth_per_s.get(row).and_then(cell);
            let verdict = run.map.verdict.get(row).and_then(|row| row.get(column));
            match (verdict, growth) {
                (Some(Verdict::Stable), _) => STABLE,
                (_, Some(growth)) => shade(growth),
                (_, None) => PAPER,
            }
        },
    );
    let name = "angle of the first guide, the cut at its own\u{2003}[°]";
    draw_named(sheet, &angle, panel.bottom, name);
    draw_forces(sheet, panel, run);
}

/// Writes speed and forces of a panel as its title.
fn draw_forces(sheet: &mut Sheet, panel: &Frame, run: &CutAtSpeed) {
    let title = Lettering::title(SUBTITLE_SIZE, INK);
    let text = format!(
        "{} rpm, {:.0} N against and {:.0} N inwards a tooth at load 1",
        run.rpm, run.tangential_n_per_tooth, run.radial_n_per_tooth
    );
    let room = panel.right - panel.left;
    let text = shorten(&text, SUBTITLE_SIZE, Weight::SemiBold, room);
    sheet.text([panel.left, panel.top - 14.0], title, &text);
}

/// Growth over the load, for a saw without guides.
fn over_load(report: &CutReport) -> Sheet {
    let title = "Growth in the cut over the load";
    let panels = report.runs.len();
    let mut sheet = PANELS.sheet(
        panels,
        title,
        &of_saw(&report.scene.name, &report.condition),
    );
    let fastest = fastest_growth(report);
    for (index, run) in report.runs.iter().enumerate() {
        let panel = &PANELS.panel(index, panels);
        let level = Axis::over(&run.map.load_level, panel.across());
        let growth = Axis::linear([slowest_growth(report), fastest], panel.upwards());
        draw_vertical(
            &mut sheet,
            &growth,
            panel,
            name_of_row(index, "growth\u{2003}[1/s]"),
        );
        draw_named(&mut sheet, &level, panel.bottom, LOAD);
        let threshold = growth.at(report.flutter_threshold_per_s);
        let dashed = Stroke::dashed(QUIET, HAIRLINE, FINE_DASH);
        sheet.horizontal(threshold, panel, dashed);
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::End);
        let at = [panel.right - 4.0, threshold - 6.0];
        sheet.text(at, letters, "unstable above");
        let points = run.map.load_level.iter().zip(&run.map.growth_per_s);
        let places: Vec<[f64; 2]> = points
            .filter_map(|(load, row)| Some([level.at(*load), growth.at(*row.first()?)]))
            .collect();
        draw_inside(&mut sheet, panel, &places, Stroke::solid(FORWARD, CURVE));
        let [x, y] = [level.at(1.0), growth.at(run.growth_per_s)];
        sheet.ring([x, y], 5.0, Stroke::solid(INK, 1.5 * HAIRLINE));
        let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Start);
        sheet.text_on_paper([x + 11.0, y + 4.0], letters, "this saw");
        draw_forces(&mut sheet, panel, run);
    }
    sheet
}

/// Marks angle and load of the scene, and the load that the power of the saw allows.
fn draw_own_point(sheet: &mut Sheet, panel: &Frame, report: &CutReport, run: &CutAtSpeed) {
    let (angle, level) = axes(panel, run);
    let own_deg = report
        .scene
        .guides
        .first()
        .map_or(0.0, |guide| guide.angle_deg);
    let x = angle.at(own_deg);
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Start);
    let stroke = Stroke::solid(INK, 1.5 * HAIRLINE);
    sheet.ring([x, level.at(1.0)], 5.0, stroke);
    sheet.text([x + 11.0, level.at(1.0) + 4.0], letters, "this saw");
    if let Some(by_power) = &run.by_power {
        let share = by_power.tangential_n_per_tooth / run.tangential_n_per_tooth;
        if share < 0.9 {
            let y = level.at(share);
            sheet.ring([x, y], 4.0, Stroke::solid(QUIET, HAIRLINE));
            sheet.text([x + 11.0, y + 4.0], letters, "force that the power allows");
        }
    }
}
