//! The Campbell diagram: frequencies and growth rates over rotation speed.

mod band_labels;
mod certificate;
mod describe;
mod excitation;
mod growth;
mod legend;
mod meeting;
mod speeds;
mod view;
mod waves;

#[cfg(test)]
pub(super) use growth::curve;
pub use view::CampbellView;

use band_labels::BandLabels;
use describe::describe;

use super::{InstabilityKind, Report};
use crate::page::figure::axis::{Axis, SPEED, draw_horizontal, draw_vertical, name_below};
use crate::page::figure::canvas::{Frame, Sheet, Stroke};
use crate::page::figure::chart_data::{ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Role, Upright};
use crate::page::figure::paint::Ground;
use crate::page::figure::style::{BETWEEN_FACTS, HAIRLINE, MARGIN, QUIET};
use crate::page::figure::{bands, heading};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 918;
const PLOT_LEFT: f64 = 92.0;
const PLOT_TOP: f64 = 122.0;
const PLOT_BOTTOM: f64 = 788.0;
const BETWEEN_PANELS: f64 = 16.0;
const GROWTH_HEIGHT: f64 = 236.0;
/// Height of the lower panel if nothing grows.
const EMPTY_GROWTH_HEIGHT: f64 = 48.0;

/// Distances of the baselines of the lines below the panels from the lower edge of the sheet.
const LEGEND_ABOVE_FOOT: f64 = 70.0;
const NOTES_ABOVE_FOOT: f64 = 51.0;
const CERTIFICATE_ABOVE_FOOT: f64 = 32.0;
const FACTS_ABOVE_FOOT: f64 = 14.0;

/// Growth rates up to this value, in 1/s, are drawn as zero: they are rounding errors of the eigenvalues.
pub const NEGLIGIBLE_PER_S: f64 = 1e-3;

/// Contents, axes and frames of the figure.
struct Chart<'a> {
    report: &'a Report,
    data: ChartData,
    speed: Axis,
    frequency: Axis,
    /// Panel of the frequencies.
    upper: Frame,
    /// Panel of the growth rates.
    lower: Frame,
}

pub fn sheet(report: &Report, view: CampbellView) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let chart = Chart::new(report, view);
    heading::draw(
        &mut sheet,
        &chart.data.title,
        &facts(report).join(BETWEEN_FACTS),
    );

    let labels = BandLabels::new(&chart);
    let growth_axis = growth::axis(&chart, labels.height());
    let panels = [chart.upper, chart.lower];
    bands::draw(&mut sheet, &chart.speed, chart.bands(), &panels);
    draw_axes(&mut sheet, &chart, growth_axis.as_ref());
    speeds::draw_critical(&mut sheet, &chart);
    speeds::draw_operating(&mut sheet, &chart);

    let (ground, items) = (chart.upper_ground(), &chart.panels()[0].items);
    ground.draw_lines(&mut sheet, items);
    excitation::label(&mut sheet, &chart);
    ground.draw_points(&mut sheet, items);
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

/// The whole sweep as numbers. Descriptions of the points, which are most of the data, are included only if `said`.
pub fn chart(report: &Report, said: bool) -> ChartData {
    let whole = CampbellView {
        to_rpm: Some(f64::INFINITY),
        ..CampbellView::default()
    };
    describe(report, &whole.of(report), said)
}

impl<'a> Chart<'a> {
    fn new(report: &'a Report, view: CampbellView) -> Self {
        let shown = view.of(report);
        let right = f64::from(WIDTH) - MARGIN - waves::end_label_room(report);
        let growth_height = if growth::is_worth_showing(report) {
            GROWTH_HEIGHT
        } else {
            EMPTY_GROWTH_HEIGHT
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
            data: describe(report, &shown, false),
            speed: Axis::linear(shown.rpm, [PLOT_LEFT, right]),
            frequency: Axis::linear([0.0, shown.hz], upper.upwards()),
            upper,
            lower,
        }
    }

    /// Contents of the panel of the frequencies and of the panel of the growth rates.
    fn panels(&self) -> &[PanelData] {
        &self.data.panels
    }

    /// Contents of the panel of the frequencies.
    fn items(&self) -> impl Iterator<Item = &Item> + Clone {
        self.data
            .panels
            .iter()
            .take(1)
            .flat_map(|panel| &panel.items)
    }

    fn bands(&self) -> impl Iterator<Item = &Band> + Clone {
        self.items().filter_map(|item| match item {
            Item::Band(band) => Some(band),
            _ => None,
        })
    }

    fn uprights(&self, role: Role) -> impl Iterator<Item = &Upright> {
        self.items().filter_map(move |item| match item {
            Item::Upright(upright) if upright.role == role => Some(upright),
            _ => None,
        })
    }

    /// Curves of the panel of the frequencies.
    fn lines(&self) -> impl Iterator<Item = &Line> {
        self.items().filter_map(|item| match item {
            Item::Line(line) => Some(line),
            _ => None,
        })
    }

    fn upper_ground(&self) -> Ground<'_> {
        Ground {
            x: &self.speed,
            y: &self.frequency,
            frame: &self.upper,
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
        sheet.vertical(panel.left, panel, Stroke::solid(QUIET, HAIRLINE));
    }
    draw_horizontal(sheet, &chart.speed, chart.upper.bottom, false);
    draw_horizontal(sheet, &chart.speed, chart.lower.bottom, true);
    name_below(sheet, chart.upper.across(), PLOT_BOTTOM + 37.0, SPEED);
}

/// Size of the saw, numbers of its events, and verdict on flutter.
fn facts(report: &Report) -> Vec<String> {
    let blade = &report.scene.blade;
    let (least, largest) = blade.thickness_range_m();
    let [diameter, least, largest] = [blade.outer_diameter_m, least, largest].map(millimetres);
    let size = if least == largest {
        format!("{diameter} mm diameter, {largest} mm thick")
    } else {
        format!("{diameter} mm diameter, {least} to {largest} mm thick")
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
    let saw = report.condition.clone();
    vec![saw, size, guides, critical, bands, verdict(report)]
}

fn verdict(report: &Report) -> String {
    let mut bands = report.instabilities.iter();
    let flutters = bands.any(|band| band.kind == InstabilityKind::Flutter);
    let last = report.campbell.to_rpm;
    match report.flutter_speed_rpm {
        Some(rpm) => format!("flutter from {rpm:.0} rpm"),
        // The figure also shows flutter with growth rates below the threshold, so that the verdict must name
        // the threshold.
        None if flutters => {
            let threshold = report.flutter_threshold_per_s;
            format!("no flutter above {threshold} 1/s up to {last:.0} rpm")
        }
        None => format!("no flutter up to {last:.0} rpm"),
    }
}

/// Millimetres, rounded to two decimals.
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
