//! Unstable speeds of a saw, idling and under the forces of a cut, one above the other.

use super::axis::{Axis, SPEED, draw_named};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::key::Key;
use super::style::{
    BETWEEN_FACTS, DIVERGENCE_SHADE, FLUTTER, FLUTTER_SHADE, GRID, HAIRLINE, INK, LABEL_SIZE,
    MARGIN, QUIET, STRONG_CURVE,
};
use super::{bands, heading};
use crate::report::{InCut, InstabilityBand, Report};

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 420;
const LEFT: f64 = 300.0;
const RIGHT: f64 = 1160.0;
const TOP: f64 = 104.0;
const ROW: f64 = 96.0;
/// Distance of the shaded areas of the two rows.
const GAP: f64 = 14.0;

/// Contents of the row of one of the two saws.
struct Row<'a> {
    name: String,
    critical_rpm: Vec<f64>,
    bands: &'a [InstabilityBand],
    flutter_rpm: Option<f64>,
}

/// Draws both rows; `None` if the report contains no comparison with the idling saw.
pub fn sheet(report: &Report) -> Option<Sheet> {
    let in_cut = report.in_cut.as_ref()?;
    let idling = in_cut.idling.as_ref()?;
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report, in_cut));
    let range = [report.campbell.from_rpm, report.campbell.to_rpm];
    let speed = Axis::linear(range, [LEFT, RIGHT]);
    let critical = report.critical_speeds.iter().map(|critical| critical.rpm);
    let rows = [
        Row {
            name: "idling".to_owned(),
            critical_rpm: idling.critical_speeds_rpm.clone(),
            bands: &idling.instabilities,
            flutter_rpm: idling.flutter_speed_rpm,
        },
        Row {
            name: "in the cut".to_owned(),
            critical_rpm: critical.collect(),
            bands: &report.instabilities,
            flutter_rpm: report.flutter_speed_rpm,
        },
    ];
    for (k, row) in rows.iter().enumerate() {
        let top = TOP + ROW * k as f64;
        let frame = Frame {
            left: LEFT,
            top,
            right: RIGHT,
            bottom: top + ROW - GAP,
        };
        row.draw(&mut sheet, &speed, frame);
    }
    let bottom = TOP + 2.0 * ROW;
    if let Some(rpm) = report.scene.operating_rpm.filter(|rpm| speed.shows(*rpm)) {
        let x = speed.at(rpm);
        sheet.line([[x, TOP - 6.0], [x, bottom]], Stroke::solid(INK, HAIRLINE));
        let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Middle);
        sheet.text([x, TOP - 10.0], letters, &format!("operating {rpm:.0}"));
    }
    draw_named(&mut sheet, &speed, bottom, SPEED);
    draw_key(&mut sheet);
    Some(sheet)
}

fn facts(report: &Report, in_cut: &InCut) -> String {
    [
        report.condition.clone(),
        format!(
            "{:.0} N against the rotation and {:.0} N inwards on each tooth, at every speed",
            in_cut.tangential_n_per_tooth, in_cut.radial_n_per_tooth
        ),
    ]
    .join(BETWEEN_FACTS)
}

impl Row<'_> {
    fn draw(&self, sheet: &mut Sheet, speed: &Axis, frame: Frame) {
        bands::shade(sheet, speed, self.bands.iter(), &[frame]);
        sheet.horizontal(frame.bottom, &frame, Stroke::solid(GRID, HAIRLINE));
        let shown = self.critical_rpm.iter().filter(|rpm| speed.shows(**rpm));
        for rpm in shown {
            sheet.disc([speed.at(*rpm), frame.bottom], 3.5, INK);
        }
        let shown = self.flutter_rpm.filter(|rpm| speed.shows(*rpm));
        if let Some(x) = shown.map(|rpm| speed.at(rpm)) {
            sheet.vertical(x, &frame, Stroke::solid(FLUTTER, STRONG_CURVE));
        }
        let [_, middle] = frame.centre();
        let letters = |colour| Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        sheet.text([MARGIN, middle - 16.0], letters(INK), &self.name);
        let lines = [
            ("critical speed", self.critical_rpm.first().copied(), 2.0),
            ("flutter speed", self.flutter_rpm, 20.0),
        ];
        for (name, rpm, below) in lines {
            let line = match rpm {
                Some(rpm) => format!("{name} {rpm:.0} rpm"),
                None => format!("no {name} in the sweep"),
            };
            sheet.text([MARGIN, middle + below], letters(QUIET), &line);
        }
    }
}

fn draw_key(sheet: &mut Sheet) {
    Key::new(sheet, MARGIN, f64::from(HEIGHT) - 20.0)
        .shade(DIVERGENCE_SHADE)
        .word("divergence")
        .shade(FLUTTER_SHADE)
        .word("flutter")
        .upright(4.0, 8.0, Stroke::solid(FLUTTER, STRONG_CURVE))
        .word("flutter speed")
        .dot(8.0, 3.5, INK)
        .word("critical speed");
}
