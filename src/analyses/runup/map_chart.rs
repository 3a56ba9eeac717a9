//! The response at the probe over speed and frequency, with the branches, as in the paper's Figure 15.

use super::RunUpReport;
use crate::page::figure::axis::{Spread, ends, extremes, proper_range};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Heat, Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{HAIRLINE, MEASURED_SIZE};

/// Range of the colours in decades.
const DECADES: f64 = 3.0;
/// Colours from weak to strong; lightness falls evenly, so that grey prints are legible too.
const RESPONSE: [[u8; 3]; 5] = [
    [250, 251, 253],
    [196, 216, 236],
    [104, 152, 204],
    [38, 84, 152],
    [12, 24, 64],
];
const BRANCH: Hue = Hue::Backward;
/// Height of the panel, relative to one of usual height.
const SHARE: f64 = 1.45;

/// The response of the linear model, as numbers.
pub fn chart(report: &RunUpReport) -> ChartData {
    let response = &report.response;
    let map = Map {
        title: "Response at the probe over speed and frequency",
        name: "response",
        unit: "mm/N",
        rpm: &response.rpm,
        frequency_hz: &response.frequency_hz,
        rows: &response.receptance_m_per_n,
    };
    map.chart(report)
}

/// The spectrum of the deflection of a blade that stretches, as numbers; `None` without stretching.
pub fn stretched_chart(report: &RunUpReport) -> Option<ChartData> {
    let found = report.stretching.as_ref()?;
    let map = Map {
        title: "Deflection at the probe over speed and frequency, with stretching",
        name: "deflection",
        unit: "mm",
        rpm: &found.rpm,
        frequency_hz: &found.frequency_hz,
        rows: &found.amplitude_m,
    };
    Some(map.chart(report))
}

/// A map of a deflection, or of a deflection per unit of a load, over speed and frequency.
struct Map<'a> {
    title: &'a str,
    /// Name and unit of the values times 1000.
    name: &'a str,
    unit: &'a str,
    rpm: &'a [f64],
    frequency_hz: &'a [f64],
    /// Values in a row for each speed.
    rows: &'a [Vec<f64>],
}

impl Map<'_> {
    fn chart(&self, report: &RunUpReport) -> ChartData {
        let speeds = proper_range(ends(self.rpm));
        let frequencies = proper_range(ends(self.frequency_hz));
        let branches = report.campbell.branches.iter().map(|branch| {
            let points = branch.rpm.iter().zip(&branch.frequency_hz);
            Item::Line(Line {
                width: HAIRLINE,
                branch: Some(branch.branch),
                ..Line::new(points.map(|(rpm, hz)| [*rpm, *hz]), BRANCH, &branch.name)
            })
        });
        let measured = measured(report);
        let sample = Item::line_sample(1.5 * HAIRLINE, false, BRANCH, "eigenvalue branches");
        let samples = measured.iter().map(Item::sample);
        let key = [sample].into_iter().chain(samples).collect();
        let items = [Item::Heat(self.heat())].into_iter().chain(branches);
        let panel = PanelData {
            share: SHARE,
            harmonics: true,
            ..PanelData::new(
                AxisData::speed().within(speeds),
                AxisData::new("frequency in space", "Hz").within(frequencies),
                items.chain(measured).collect(),
            )
        };
        let facts = vec![heading::of_saw(&report.scene.name, &report.condition)];
        ChartData {
            key,
            ..ChartData::new(self.title, facts, vec![panel])
        }
    }

    fn heat(&self) -> Heat {
        let value = |column: &Vec<f64>, row: usize| 1e3 * column.get(row).unwrap_or(&f64::NAN);
        let row = |row: usize| self.rows.iter().map(|column| value(column, row)).collect();
        let all = self.rows.iter().flatten().filter(|value| **value > 0.0);
        let [_, top] = extremes(all.map(|value| 1e3 * value));
        let strongest = if top > 0.0 { top } else { 1.0 };
        Heat {
            x: self.rpm.to_vec(),
            y: self.frequency_hz.to_vec(),
            z: (0..self.frequency_hz.len()).map(row).collect(),
            range: [strongest / 10f64.powf(DECADES), strongest],
            spread: Spread::Logarithmic,
            colours: RESPONSE.to_vec(),
            name: self.name.to_owned(),
            unit: self.unit.to_owned(),
        }
    }
}

/// Rings at the measured frequencies.
fn measured(report: &RunUpReport) -> Option<Item> {
    let measured = report.scene.measured.as_ref()?;
    let points = measured
        .rows
        .iter()
        .flat_map(|row| row.seen_hz().map(|hz| [row.rpm, hz]));
    Some(Item::Points(Points {
        shape: Shape::Ring,
        ..Points::new(points, Hue::Ink, MEASURED_SIZE, &measured.source)
    }))
}
