//! Effects of the numbers of the scene on the first critical speed and on the flutter speed, the strongest at the top.

use super::{Report, Sensitivity};
use crate::analyses::scene_number;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Role, Upright};
use crate::page::figure::palette::Hue;

/// Width of a bar, and height of a row relative to a panel of usual height.
const BAR: f64 = 12.0;
const ROW: f64 = 0.13;
/// Distance of the bars of a row from its middle.
const ASIDE: f64 = 0.16;
/// Effects below this, in percent, are not drawn.
const LEAST: f64 = 0.005;
/// Half width of the axis, relative to the longest bar.
const FREE: f64 = 1.05;

/// The effects, as numbers; `None` if the report has no sensitivities.
pub fn chart(report: &Report) -> Option<ChartData> {
    let mut rows: Vec<Row> = report
        .sensitivities
        .iter()
        .map(Row::new)
        .filter(|row| row.strength() >= LEAST)
        .collect();
    rows.sort_by(|one, other| other.strength().total_cmp(&one.strength()));
    let longest = rows.first()?.strength();
    let count = rows.len() as f64;
    let places = (1..).map(f64::from);
    let names = places.clone().zip(rows.iter().map(|row| row.name.clone()));
    let bars = places.zip(&rows).flat_map(|(place, row)| row.bars(place));
    let zero = Item::Upright(Upright {
        x: 0.0,
        role: Role::Guide,
        colour: Hue::Quiet,
        dashed: false,
        label: String::new(),
        name: "no change".to_owned(),
    });
    let panel = PanelData {
        share: ROW * (count + 0.5),
        ..PanelData::new(
            AxisData::new("change of the speed", "%").within([-FREE * longest, FREE * longest]),
            AxisData::new("", "")
                .within([0.4, count + 0.6])
                .named(names),
            std::iter::once(zero).chain(bars).collect(),
        )
    };
    let key =
        [CRITICAL, FLUTTER].map(|speed| Item::line_sample(BAR, false, speed.colour, speed.name));
    Some(ChartData {
        key: key.into(),
        ..ChartData::new(
            &report.scene.name,
            vec![report.condition.clone()],
            vec![panel],
        )
    })
}

/// A speed with its bars.
struct Speed {
    name: &'static str,
    colour: Hue,
    aside: f64,
}

const CRITICAL: Speed = Speed {
    name: "first critical speed",
    colour: Hue::Ink,
    aside: -ASIDE,
};
const FLUTTER: Speed = Speed {
    name: "flutter speed",
    colour: Hue::Flutter,
    aside: ASIDE,
};

/// A number of the scene, with its effects in percent.
struct Row {
    name: String,
    critical: Option<f64>,
    flutter: Option<f64>,
}

impl Row {
    fn new(sensitivity: &Sensitivity) -> Self {
        Row {
            name: format!(
                "{} + {}",
                scene_number::name(&sensitivity.parameter),
                sensitivity.change
            ),
            critical: sensitivity.of_first_critical(),
            flutter: sensitivity.flutter_speed_percent,
        }
    }

    fn strength(&self) -> f64 {
        let [critical, flutter] = [self.critical, self.flutter].map(Option::unwrap_or_default);
        critical.abs().max(flutter.abs())
    }

    fn bars(&self, place: f64) -> impl Iterator<Item = Item> {
        let critical = self.critical.map(|percent| CRITICAL.bar(place, percent));
        let flutter = self.flutter.map(|percent| FLUTTER.bar(place, percent));
        critical.into_iter().chain(flutter)
    }
}

impl Speed {
    fn bar(&self, place: f64, percent: f64) -> Item {
        let at = place + self.aside;
        let name = format!("{} {percent:+.2} %", self.name);
        Item::Line(Line {
            width: BAR,
            ..Line::new([[0.0, at], [percent, at]], self.colour, &name)
        })
    }
}
