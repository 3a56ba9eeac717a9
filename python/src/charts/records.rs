//! Spectra of records over the speed, and at one speed.

use pyo3::prelude::*;
use sawflutter::page::figure::{
    AxisData, CURVE, ChartData, Heat, Hue, Item, Line, PanelData, Points, Role, Shape, Spread,
    Upright,
};
use sawflutter::page::text::shown_to;

use super::written;

/// Pale greens, over which the colours of branches and the rings of peaks are seen.
const GREENS: [[u8; 3]; 5] = [
    [255, 255, 255],
    [226, 242, 230],
    [181, 221, 192],
    [127, 194, 151],
    [74, 163, 114],
];
/// Speeds with rings; more would hide the branches.
const MOST_SPEEDS: usize = 40;
/// Rows of the picture; more are not seen, and the largest of several is kept.
const MOST_ROWS: usize = 600;
/// The smallest amplitude, as a share of the largest one, whose level is shown.
const LEAST_SHARE: f64 = 1e-15;
/// The lowest level of a spectrum, in dB.
const LEAST_DB: f64 = -100.0;

/// Spectra of a record over the speed, an object of Python with these attributes.
#[derive(FromPyObject)]
pub struct Waterfall {
    name: String,
    unit: String,
    resolution_hz: f64,
    rpm: Vec<f64>,
    frequency_hz: Vec<f64>,
    /// A row for each speed.
    amplitude: Vec<Vec<f64>>,
}

/// Peaks of spectra, an object of Python with these attributes.
#[derive(FromPyObject)]
pub struct Peaks {
    rpm: Vec<f64>,
    frequency_hz: Vec<f64>,
    amplitude: Vec<f64>,
    /// Multiple of the speed; NaN at none.
    order: Vec<f64>,
    spectrum: Vec<usize>,
}

/// Levels over speed and frequency from `lowest_hz` on, over a range in dB, with the branches of a report and peaks.
#[pyfunction]
pub fn waterfall_chart(
    of: Waterfall,
    lowest_hz: f64,
    range_db: f64,
    report: Option<&str>,
    peaks: Option<Peaks>,
) -> PyResult<String> {
    let computed = report
        .map(|text| crate::figures::read("analyze", text))
        .transpose()?;
    let top = of.top(lowest_hz);
    let mut items = vec![Item::Heat(of.heat(top, range_db))];
    let drawn = computed
        .as_ref()
        .and_then(|report| report.chart("campbell"));
    for item in drawn
        .iter()
        .filter_map(|chart| chart.panels.first())
        .flat_map(|panel| &panel.items)
    {
        // The ends of branches may be beyond the record.
        if let Item::Line(line) = item
            && line.branch.is_some()
        {
            items.push(Item::Line(Line {
                end: String::new(),
                label: String::new(),
                width: line.width.min(CURVE),
                ..line.clone()
            }));
        }
    }
    items.extend(peaks.iter().flat_map(Peaks::rings));
    let unit = of.unit.trim();
    let mut facts = vec![
        format!("{}: 0 dB is {} {unit}", of.name, shown_to(3, top))
            .trim_end()
            .to_owned(),
        format!("peaks {} Hz wide", shown_to(2, of.resolution_hz)),
    ];
    if let Some(peaks) = &peaks {
        let free = peaks.order.iter().filter(|order| order.is_nan()).count();
        facts.push(format!(
            "{free} peaks picked, {} at multiples of the speed left out",
            peaks.order.len() - free
        ));
    }
    let ends =
        |values: &[f64]| [values.first(), values.last()].map(|end| end.copied().unwrap_or(0.0));
    let panel = PanelData {
        harmonics: true,
        share: 2.0,
        ..PanelData::new(
            AxisData::speed().within(ends(&of.rpm)),
            AxisData::new("frequency in space", "Hz").within([0.0, ends(&of.frequency_hz)[1]]),
            items,
        )
    };
    let title = computed
        .as_ref()
        .map_or(&of.name, |report| &report.scene().name);
    written(&ChartData::new(title, facts, vec![panel]))
}

impl Waterfall {
    /// The largest amplitude from a frequency on.
    fn top(&self, lowest_hz: f64) -> f64 {
        let first = self.frequency_hz.partition_point(|hz| *hz < lowest_hz);
        let above = self
            .amplitude
            .iter()
            .flat_map(|row| row.get(first..).unwrap_or_default());
        match above.fold(0.0, |most: f64, size| most.max(*size)) {
            0.0 => 1.0,
            top => top,
        }
    }

    fn heat(&self, top: f64, range_db: f64) -> Heat {
        let lines = self.frequency_hz.len();
        let step = lines.div_ceil(MOST_ROWS).max(1);
        let blocks: Vec<_> = (0..lines)
            .step_by(step)
            .map(|begin| begin..(begin + step).min(lines))
            .collect();
        let largest = |row: &[f64]| row.iter().fold(0.0, |most: f64, size| most.max(*size));
        let levels = |block: &std::ops::Range<usize>| {
            let columns = self
                .amplitude
                .iter()
                .map(|row| row.get(block.clone()).unwrap_or_default());
            columns.map(|row| level(largest(row), top)).collect()
        };
        Heat {
            x: self.rpm.clone(),
            y: blocks
                .iter()
                .map(|block| {
                    0.5 * (self.frequency_hz[block.start] + self.frequency_hz[block.end - 1])
                })
                .collect(),
            z: blocks.iter().map(levels).collect(),
            range: [-range_db, 0.0],
            spread: Spread::Linear,
            colours: GREENS.to_vec(),
            name: "level".to_owned(),
            unit: "dB".to_owned(),
        }
    }
}

/// An amplitude in dB below another.
fn level(amplitude: f64, top: f64) -> f64 {
    20.0 * (amplitude / top).max(LEAST_SHARE).log10()
}

impl Peaks {
    /// Rings at the peaks of some speeds; those at a multiple of the speed are small and grey.
    fn rings(&self) -> Vec<Item> {
        let every = 1 + self.spectrum.iter().max().unwrap_or(&0) / MOST_SPEEDS;
        let groups = [
            (true, Hue::Ink, "picked peaks", 4.5),
            (false, Hue::Quiet, "peaks at a multiple of the speed", 2.5),
        ];
        let ring = |(free, colour, name, size)| {
            let chosen = || {
                (0..self.rpm.len()).filter(move |k| {
                    self.order[*k].is_nan() == free && self.spectrum[*k].is_multiple_of(every)
                })
            };
            let said = |k: usize| {
                format!(
                    "{:.0} rpm\n{:.2} Hz measured",
                    self.rpm[k], self.frequency_hz[k]
                )
            };
            chosen().next()?;
            Some(Item::Points(Points {
                shape: Shape::Ring,
                said: chosen().map(said).collect(),
                ..Points::new(
                    chosen().map(|k| [self.rpm[k], self.frequency_hz[k]]),
                    colour,
                    size,
                    name,
                )
            }))
        };
        groups.into_iter().filter_map(ring).collect()
    }
}

/// Amplitude over frequency at a speed, an object of Python with these attributes.
#[derive(FromPyObject)]
pub struct Spectrum {
    name: String,
    unit: String,
    rpm: f64,
    frequency_hz: Vec<f64>,
}

/// Level over frequency, with vertical lines at computed frequencies of a saw, and peaks.
#[pyfunction]
pub fn spectrum_chart(
    of: Spectrum,
    magnitude: Vec<f64>,
    saw: Option<(String, Vec<f64>)>,
    peaks: Option<Peaks>,
) -> PyResult<String> {
    let unit = of.unit.trim();
    let largest = magnitude
        .iter()
        .fold(0.0, |most: f64, size| most.max(*size));
    let top = if largest > 0.0 { largest } else { 1.0 };
    let limit = of.frequency_hz.last().copied().unwrap_or(0.0);
    let computed = saw.iter().flat_map(|(_, hz)| hz).filter(|hz| **hz <= limit);
    let mut items: Vec<Item> = computed
        .map(|hz| {
            Item::Upright(Upright {
                x: *hz,
                role: Role::Guide,
                colour: Hue::Forward,
                dashed: true,
                label: String::new(),
                name: format!("computed: {hz:.2} Hz"),
            })
        })
        .collect();
    let points = || of.frequency_hz.iter().zip(&magnitude);
    let said = |(hz, size): (&f64, &f64)| {
        format!("{hz:.2} Hz\n{} {unit}", shown_to(3, *size))
            .trim_end()
            .to_owned()
    };
    let levels = points().map(|(hz, size)| [*hz, level(*size, top)]);
    let lowest = magnitude
        .iter()
        .fold(0.0, |least: f64, size| least.min(level(*size, top)));
    items.push(Item::Line(Line {
        width: 1.0,
        said: points().map(said).collect(),
        ..Line::new(levels, Hue::Ink, &of.name)
    }));
    if let Some(peaks) = peaks {
        let places = peaks.frequency_hz.iter().zip(&peaks.amplitude);
        let places = places.map(|(hz, size)| [*hz, level(*size, top)]);
        items.push(Item::Points(Points {
            shape: Shape::Ring,
            said: peaks
                .frequency_hz
                .iter()
                .map(|hz| format!("{hz:.2} Hz measured"))
                .collect(),
            ..Points::new(places, Hue::Alarm, 7.0, "picked peaks")
        }));
    }
    let scale = format!(
        "{} at {:.0} rpm: 0 dB is {} {unit}",
        of.name,
        of.rpm,
        shown_to(3, top)
    );
    let mut facts = vec![scale.trim_end().to_owned()];
    facts.extend(
        saw.is_some()
            .then(|| "vertical lines are computed frequencies".to_owned()),
    );
    let panel = PanelData::new(
        AxisData::new("frequency in space", "Hz").within([0.0, limit]),
        AxisData::new("level", "dB").within([lowest.max(LEAST_DB), 5.0]),
        items,
    );
    let title = saw.as_ref().map_or(&of.name, |(name, _)| name);
    written(&ChartData::new(title, facts, vec![panel]))
}
