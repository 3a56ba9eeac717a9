//! The deflection over speed during a run-up, as in the paper's Figure 13.

use super::RunUpReport;
use crate::motion::transient::LINEAR_THICKNESSES;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Band, Item, Line, Role, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::CURVE;

/// The deflection, critical speeds and bands.
pub fn chart(report: &RunUpReport) -> ChartData {
    let speeds = [report.from_rpm, report.to_rpm];
    let largest_m = report
        .deflection_m
        .iter()
        .fold(1e-9_f64, |m, w| m.max(w.abs()));
    let reach = 1.1e3 * largest_m;
    let bands = report
        .bands
        .iter()
        .map(|entry| &entry.band)
        .map(|band| Item::Band(Band::new(band, speeds)));
    let critical = report
        .critical_speeds
        .iter()
        .map(|entry| Item::Upright(Upright::critical(entry.rpm, &entry.name)));
    let samples = report.rpm.iter().zip(&report.deflection_m);
    let record = Line {
        width: 0.75 * CURVE,
        ..Line::new(
            samples.map(|(rpm, w)| [*rpm, 1e3 * w]),
            Hue::Forward,
            "deflection",
        )
    };
    let end = report.linear_until_rpm.map(end_of_model);
    let items = bands
        .chain(critical)
        .chain([Item::Line(record)])
        .chain(end.clone());
    let dashed = Item::Upright(Upright {
        name: "critical speed [rpm]".to_owned(),
        ..Upright::critical(0.0, "")
    });
    let key = [
        Item::area_sample(Hue::DivergenceShade, "divergence"),
        Item::area_sample(Hue::FlutterShade, "flutter"),
        dashed,
    ];
    ChartData {
        title: format!(
            "Deflection at the probe in a run-up at {:.1} rpm/s",
            report.rate_rpm_per_s
        ),
        facts: vec![heading::of_saw(&report.scene.name, &report.condition)],
        panels: vec![PanelData::new(
            AxisData::speed().within(speeds),
            AxisData::new("deflection", "mm").within([-reach, reach]),
            items.collect(),
        )],
        columns: 1,
        key: key.into_iter().chain(end).collect(),
    }
}

/// The line of the speed above which the linear model is not valid.
fn end_of_model(rpm: f64) -> Item {
    Item::Upright(Upright {
        x: rpm,
        role: Role::Guide,
        colour: Hue::Alarm,
        dashed: false,
        label: String::new(),
        name: format!("more than {LINEAR_THICKNESSES} thicknesses: the linear model ends"),
    })
}
