//! The Campbell diagram: frequencies and growth rates over rotation speed.

mod band_labels;
mod certificate;
mod excitation;
mod growth;
mod legend;
mod speeds;
mod view;
mod waves;

#[cfg(test)]
pub(super) use growth::curve;
pub use view::CampbellView;
pub(super) use waves::draw_measured_mark;

use band_labels::BandLabels;

use super::axis::{Axis, Spread, draw_horizontal, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::style::{AXIS_SIZE, BETWEEN_FACTS, HAIRLINE, INK, MARGIN, QUIET};
use super::{bands, heading};
use crate::report::{InstabilityKind, Report};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 918;
const PLOT_LEFT: f64 = 92.0;
const PLOT_TOP: f64 = 122.0;
const PLOT_BOTTOM: f64 = 788.0;
const BETWEEN_PANELS: f64 = 16.0;
const GROWTH_HEIGHT: f64 = 236.0;
/// Height of the lower panel when there is nothing to see in it.
const EMPTY_GROWTH_HEIGHT: f64 = 48.0;

/// Baselines of the lines at the foot.
const LEGEND_ABOVE_FOOT: f64 = 70.0;
const NOTES_ABOVE_FOOT: f64 = 51.0;
const CERTIFICATE_ABOVE_FOOT: f64 = 32.0;
const FACTS_ABOVE_FOOT: f64 = 14.0;

/// Smaller growth rates are taken for rounding errors of the eigenvalues.
const NEGLIGIBLE_PER_S: f64 = 1e-3;

/// What the parts of the figure share.
struct Chart<'a> {
    report: &'a Report,
    speed: Axis,
    frequency: Axis,
    upper: Frame,
    lower: Frame,
}

pub fn sheet(report: &Report, view: CampbellView) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let chart = Chart::new(report, view);
    heading::draw(&mut sheet, &report.scene.name, &key_facts(report));

    let labels = BandLabels::new(&chart);
    let growth_axis = growth::axis(&chart, labels.height());
    let bands = chart.report.instabilities.iter();
    bands::shade(&mut sheet, &chart.speed, bands, &[chart.upper, chart.lower]);
    draw_axes(&mut sheet, &chart, growth_axis.as_ref());
    speeds::draw_critical(&mut sheet, &chart);
    speeds::draw_operating(&mut sheet, &chart);

    waves::draw_branches(&mut sheet, &chart);
    excitation::draw(&mut sheet, &chart);
    waves::draw_measured(&mut sheet, &chart);
    speeds::dot_critical(&mut sheet, &chart);
    match growth_axis {
        Some(axis) => growth::draw(&mut sheet, &chart, &axis),
        None => growth::say_stable(&mut sheet, &chart),
    }
    labels.draw(&mut sheet);
    waves::label_branches(&mut sheet, &chart);
    speeds::label_operating(&mut sheet, &chart);
    legend::draw(&mut sheet, &chart, &labels);
    certificate::draw(&mut sheet, report);
    sheet
}

impl<'a> Chart<'a> {
    fn new(report: &'a Report, view: CampbellView) -> Self {
        let shown = view.of(report);
        let right = f64::from(WIDTH) - MARGIN - waves::end_label_room(report);
        let growth_height = match growth::is_worth_showing(report) {
            true => GROWTH_HEIGHT,
            false => EMPTY_GROWTH_HEIGHT,
        };
        let between = PLOT_BOTTOM - growth_height;
        let panel = |top, bottom| Frame {
            left: PLOT_LEFT,
            top,
            right,
            bottom,
        };
        let upper = panel(PLOT_TOP, between - BETWEEN_PANELS);
        let lower = panel(between, PLOT_BOTTOM);

        Self {
            report,
            speed: Axis::new(shown.rpm, [PLOT_LEFT, right], Spread::Linear),
            frequency: Axis::new([0.0, shown.hz], [upper.bottom, upper.top], Spread::Linear),
            upper,
            lower,
        }
    }
}

fn draw_axes(sheet: &mut Sheet, chart: &Chart, growth: Option<&Axis>) {
    draw_vertical(
        sheet,
        &chart.frequency,
        &chart.upper,
        "Im λ / 2π\u{2003}[Hz]",
    );
    if let Some(axis) = growth {
        draw_vertical(sheet, axis, &chart.lower, growth::axis_name(axis));
    }
    for panel in [&chart.upper, &chart.lower] {
        let side = [[panel.left, panel.top], [panel.left, panel.bottom]];
        sheet.line(side, Stroke::solid(QUIET, HAIRLINE));
    }
    draw_horizontal(sheet, &chart.speed, chart.upper.bottom, false);
    draw_horizontal(sheet, &chart.speed, chart.lower.bottom, true);
    let middle = (chart.upper.left + chart.upper.right) / 2.0;
    let letters = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    let name = "rotation speed Ω\u{2003}[rpm]";
    sheet.text([middle, PLOT_BOTTOM + 37.0], letters, name);
}

fn key_facts(report: &Report) -> String {
    let blade = &report.scene.blade;
    let (least, largest) = blade.thickness_range_m();
    let [diameter, least, largest] = [blade.outer_diameter_m, least, largest].map(millimetres);
    let size = match least == largest {
        true => format!("{diameter} mm diameter, {largest} mm thick"),
        false => format!("{diameter} mm diameter, {least} to {largest} mm thick"),
    };
    let guides = count(report.scene.guides.len(), "guide", "guides");
    let critical = match report.critical_speeds.first() {
        Some(lowest) if report.critical_speeds_without_damping => {
            format!(
                "lowest critical speed without damping {:.0} rpm",
                lowest.rpm
            )
        }
        Some(lowest) => format!("lowest critical speed {:.0} rpm", lowest.rpm),
        None => "no critical speed".to_owned(),
    };
    let bands = count(
        report.instabilities.len(),
        "band of instability",
        "bands of instability",
    );
    [size, guides, critical, bands, verdict(report)].join(BETWEEN_FACTS)
}

fn verdict(report: &Report) -> String {
    let is_flutter = |kind| kind == InstabilityKind::Flutter;
    let merges = report
        .instabilities
        .iter()
        .any(|band| is_flutter(band.kind));
    let last = report.campbell.to_rpm;
    match report.flutter_speed_rpm {
        Some(rpm) => format!("flutter from {rpm:.0} rpm"),
        // Slow flutter is in the figure, so the verdict must not deny it.
        None if merges => {
            let threshold = report.flutter_threshold_per_s;
            format!("no flutter above {threshold} 1/s up to {last:.0} rpm")
        }
        None => format!("no flutter up to {last:.0} rpm"),
    }
}

fn millimetres(metres: f64) -> f64 {
    (metres * 1e5).round() / 100.0
}

fn count(number: usize, one: &str, many: &str) -> String {
    match number {
        0 => format!("no {many}"),
        1 => format!("1 {one}"),
        _ => format!("{number} {many}"),
    }
}

#[cfg(test)]
mod tests;
