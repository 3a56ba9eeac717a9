//! Unstable speeds of a saw, idling and under the forces of a cut, one above the other.

use super::{InCut, InstabilityBand, Report};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Points, Role, Shape, Upright};
use crate::page::figure::palette::Hue;

/// Height of a row, relative to a panel of usual height.
const ROW: f64 = 0.24;
/// Place of the critical speeds in a row, from its upper end, and of its name.
const CRITICAL: f64 = 0.8;
const NAME: f64 = 0.45;
const CRITICAL_SIZE: f64 = 7.0;

/// A saw in one of the two states.
struct Row<'a> {
    name: &'static str,
    critical_rpm: Vec<f64>,
    bands: &'a [InstabilityBand],
    flutter_rpm: Option<f64>,
}

/// Both rows, as numbers; `None` if the report contains no comparison with the idling saw.
pub fn chart(report: &Report) -> Option<ChartData> {
    let in_cut = report.in_cut.as_ref()?;
    let idling = in_cut.idling.as_ref()?;
    let critical = report.critical_speeds.iter().map(|critical| critical.rpm);
    let rows = [
        Row {
            name: "idling",
            critical_rpm: idling.critical_rpm.clone(),
            bands: &idling.instabilities,
            flutter_rpm: idling.flutter_rpm,
        },
        Row {
            name: "in the cut",
            critical_rpm: critical.collect(),
            bands: &report.instabilities,
            flutter_rpm: report.flutter_rpm,
        },
    ];
    let panels = rows
        .iter()
        .enumerate()
        .map(|(k, row)| row.panel(report, k == 0))
        .collect();
    let mut chart = ChartData::new(&report.scene.name, facts(report, in_cut), panels);
    chart.key = vec![
        Item::area_sample(Hue::DivergenceShade, "divergence"),
        Item::area_sample(Hue::FlutterShade, "flutter"),
        Item::Upright(flutter_speed(0.0)),
        Item::points_sample(CRITICAL_SIZE, Shape::Disc, Hue::Ink, "critical speed"),
    ];
    Some(chart)
}

fn facts(report: &Report, in_cut: &InCut) -> Vec<String> {
    let forces = format!(
        "{:.0} N against the rotation and {:.0} N inwards on each tooth, at every speed",
        in_cut.tangential_n_per_tooth, in_cut.radial_n_per_tooth
    );
    vec![report.condition.clone(), forces]
}

fn flutter_speed(rpm: f64) -> Upright {
    Upright {
        x: rpm,
        role: Role::Guide,
        colour: Hue::Flutter,
        dashed: false,
        label: String::new(),
        name: "flutter speed".to_owned(),
    }
}

impl Row<'_> {
    fn panel(&self, report: &Report, is_first: bool) -> PanelData {
        let speeds = [report.campbell.from_rpm, report.campbell.to_rpm];
        let bands = self
            .bands
            .iter()
            .map(|band| Item::Band(Band::new(band, speeds)));
        let places = self.critical_rpm.iter().map(|rpm| [*rpm, CRITICAL]);
        let critical = Points::new(places, Hue::Ink, CRITICAL_SIZE, "critical speed");
        let operating = report.scene.operating_rpm.map(|rpm| {
            let label = format!("operating {rpm:.0}");
            Upright {
                x: rpm,
                role: Role::Operating,
                colour: Hue::Ink,
                dashed: false,
                name: format!("{label} rpm"),
                label: if is_first { label } else { String::new() },
            }
        });
        let uprights = self
            .flutter_rpm
            .map(flutter_speed)
            .into_iter()
            .chain(operating)
            .map(Item::Upright);
        PanelData {
            share: ROW,
            ..PanelData::new(
                AxisData::speed().within(speeds),
                AxisData::new("", "")
                    .within([0.0, 1.0])
                    .named([(NAME, self.describe())]),
                bands
                    .chain(uprights)
                    .chain([Item::Points(critical)])
                    .collect(),
            )
        }
    }

    fn describe(&self) -> String {
        let said = |name: &str, rpm: Option<f64>| match rpm {
            Some(rpm) => format!("{name} {rpm:.0} rpm"),
            None => format!("no {name} in the sweep"),
        };
        format!(
            "{}: {}, {}",
            self.name,
            said("critical speed", self.critical_rpm.first().copied()),
            said("flutter speed", self.flutter_rpm)
        )
    }
}
