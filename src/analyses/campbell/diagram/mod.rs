//! The Campbell diagram: frequencies and growth rates over rotation speed.

mod band_labels;
mod branch_line;
mod certificate;
mod contents;
mod excitation;
mod facts;
mod growth;
mod legend;
mod meeting;
mod plan;
mod speeds;
mod view;
mod waves;

#[cfg(test)]
pub(super) use growth::curve;
pub use view::CampbellView;

use band_labels::BandLabels;
use contents::describe;
use facts::facts;
pub use plan::NEGLIGIBLE_PER_S;
use plan::{
    BETWEEN_PANELS, Chart, EMPTY_GROWTH_HEIGHT, GROWTH_HEIGHT, HEIGHT, PLOT_BOTTOM, PLOT_LEFT,
    PLOT_TOP, WIDTH,
};

use super::Report;
use crate::page::figure::axis::{Axis, SPEED};
use crate::page::figure::axis_drawing::{draw_horizontal, draw_vertical, name_below};
use crate::page::figure::canvas::{Frame, Sheet, Stroke};
use crate::page::figure::chart_data::ChartData;
use crate::page::figure::style::{BETWEEN_FACTS, HAIRLINE, MARGIN, QUIET};
use crate::page::figure::tidiness::tidy;
use crate::page::figure::{bands, heading};

pub fn sheet(report: &Report, view: CampbellView) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let chart = planned(report, view);
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
    tidy(sheet)
}

/// The whole sweep as numbers. Descriptions of the points, which are most of the data, are included only if `said`.
pub fn chart(report: &Report, said: bool) -> ChartData {
    let whole = CampbellView {
        to_rpm: Some(f64::INFINITY),
        ..CampbellView::default()
    };
    describe(report, &whole.of(report), said)
}

/// The figure of a part of the sweep.
fn planned(report: &Report, view: CampbellView) -> Chart<'_> {
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

    Chart {
        report,
        data: describe(report, &shown, false),
        speed: Axis::linear(shown.rpm, [PLOT_LEFT, right]),
        frequency: Axis::linear([0.0, shown.hz], upper.upwards()),
        upper,
        lower,
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

#[cfg(test)]
mod tests;
