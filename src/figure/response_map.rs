//! The response at the probe over speed and frequency, with the branches, as in the paper's Figure 15.

use super::axis::{Axis, SPEED, Spread, draw_named, draw_vertical, extremes, tick_label};
use super::campbell::draw_measured_mark;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::heading;
use super::heat::{draw_grid, draw_scale, ramp};
use super::style::{Colour, HAIRLINE, LABEL_SIZE, PAPER, QUIET, shorten_label};
use crate::analyses::runup::RunUpReport;

const WIDTH: u32 = 1200;
const HEIGHT: u32 = 760;
const PANEL: Frame = Frame {
    left: 92.0,
    top: 96.0,
    right: 1060.0,
    bottom: 660.0,
};
const SCALE: [f64; 2] = [1092.0, 1112.0];
/// Range of the colours in decades.
const DECADES: f64 = 3.0;
/// Colours from weak to strong; lightness falls evenly, so that grey prints are legible too.
const RESPONSE: [Colour; 5] = [
    plotters::style::RGBColor(250, 251, 253),
    plotters::style::RGBColor(196, 216, 236),
    plotters::style::RGBColor(104, 152, 204),
    plotters::style::RGBColor(38, 84, 152),
    plotters::style::RGBColor(12, 24, 64),
];
const BRANCH: Colour = plotters::style::RGBColor(216, 96, 60);

/// Draws the response of the linear model.
pub fn sheet(report: &RunUpReport) -> Sheet {
    let response = &report.response;
    let map = Map {
        title: "Response at the probe over speed and frequency",
        unit: "mm/N",
        rpm: &response.rpm,
        frequency_hz: &response.frequency_hz,
        rows: &response.receptance_m_per_n,
    };
    map.sheet(report)
}

/// Draws the spectrum of the deflection of a blade that stretches; `None` without stretching.
pub fn stretched_sheet(report: &RunUpReport) -> Option<Sheet> {
    let found = report.stretching.as_ref()?;
    let map = Map {
        title: "Deflection at the probe over speed and frequency, with stretching",
        unit: "mm",
        rpm: &found.rpm,
        frequency_hz: &found.frequency_hz,
        rows: &found.amplitude_m,
    };
    Some(map.sheet(report))
}

/// A map of a deflection, or of a deflection per unit of a load, over speed and frequency.
struct Map<'a> {
    title: &'a str,
    /// Unit of the colour bar, in which the values are multiplied by 1000.
    unit: &'a str,
    rpm: &'a [f64],
    frequency_hz: &'a [f64],
    /// Values in a row for each speed.
    rows: &'a [Vec<f64>],
}

impl Map<'_> {
    fn sheet(&self, report: &RunUpReport) -> Sheet {
        let mut sheet = Sheet::new(WIDTH, HEIGHT);
        heading::draw(
            &mut sheet,
            self.title,
            &heading::of_saw(&report.scene.name, &report.condition),
        );
        let speed = Axis::over(self.rpm, PANEL.across());
        let frequency = Axis::over(self.frequency_hz, PANEL.upwards());
        // The level is the decimal logarithm of the value in millimetres.
        let level = |value: f64| (1e3 * value.max(f64::MIN_POSITIVE)).log10();
        let [_, strongest] = extremes(self.rows.iter().flatten().map(|value| level(*value)));
        let strongest = match strongest.is_finite() {
            true => strongest,
            false => 0.0,
        };
        let shade = |level: f64| ramp(&RESPONSE, (level - strongest) / DECADES + 1.0);
        draw_vertical(
            &mut sheet,
            &frequency,
            &PANEL,
            "frequency in space\u{2003}[Hz]",
        );
        draw_grid(
            &mut sheet,
            (&speed, self.rpm),
            (&frequency, self.frequency_hz),
            |column, row| {
                let of_speed = self.rows.get(column);
                let value = of_speed.and_then(|of_speed| of_speed.get(row));
                value.map_or(PAPER, |value| shade(level(*value)))
            },
        );
        draw_branches(&mut sheet, report, &speed, &frequency);
        draw_named(&mut sheet, &speed, PANEL.bottom, SPEED);
        let (place, ends) = ((&PANEL, 20.0, SCALE), [strongest - DECADES, strongest]);
        draw_scale(
            &mut sheet,
            place,
            (ends, Spread::Linear),
            self.unit,
            (shade, decade),
        );
        draw_key(&mut sheet, report);
        sheet
    }
}

/// Number at a tick of the colour bar, if its level is that of a power of ten.
fn decade(level: f64) -> Option<String> {
    let whole = level.round();
    ((level - whole).abs() < 1e-6).then(|| tick_label(10f64.powf(whole)))
}

fn draw_branches(sheet: &mut Sheet, report: &RunUpReport, speed: &Axis, frequency: &Axis) {
    for branch in &report.campbell.branches {
        let samples = branch.rpm.iter().zip(&branch.frequency_hz);
        let places: Vec<[f64; 2]> = samples
            .map(|(rpm, hz)| [speed.at(*rpm), frequency.at(*hz)])
            .collect();
        draw_inside(sheet, &PANEL, &places, Stroke::solid(BRANCH, HAIRLINE));
    }
    for row in report.scene.measured.iter().flat_map(|m| &m.rows) {
        for hz in row.seen_hz() {
            if speed.shows(row.rpm) && frequency.shows(hz) {
                draw_measured_mark(sheet, [speed.at(row.rpm), frequency.at(hz)]);
            }
        }
    }
}

fn draw_key(sheet: &mut Sheet, report: &RunUpReport) {
    let y = f64::from(HEIGHT) - 28.0;
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let line = [[PANEL.left, y - 4.0], [PANEL.left + 22.0, y - 4.0]];
    sheet.line(line, Stroke::solid(BRANCH, 1.5 * HAIRLINE));
    sheet.text([PANEL.left + 30.0, y], letters, "eigenvalue branches");
    if let Some(measured) = &report.scene.measured {
        let x = PANEL.left + 190.0;
        draw_measured_mark(sheet, [x, y - 4.0]);
        let source = shorten_label(&measured.source, PANEL.right - x - 14.0);
        sheet.text([x + 12.0, y], letters, &source);
    }
}
