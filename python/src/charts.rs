//! Charts of what has no report: a scene, records of instruments, and series of saws. Like those of reports they are
//! data, which matplotlib and plotly paint.

use pyo3::prelude::*;
use sawflutter::model::scene::{Quantity, Scene, SceneFile};
use sawflutter::page::figure::{
    AxisData, CURVE, ChartData, Heat, Hue, Item, Line, PanelData, Points, Role, STRONG_CURVE,
    Shape, Spread, Upright,
};
use sawflutter::page::text::shown_to;

use crate::arguments;
use crate::failure::Failure;

/// Arc of the cut where the scene gives no number of teeth in it, and ends of the arrow of the rotation, in degrees.
const CUT_DEG: f64 = 12.0;
const ARROW_DEG: [f64; 2] = [20.0, 60.0];
/// Points of a circle.
const CIRCLE: u32 = 180;
/// Pale greens, over which the colours of branches and the rings of peaks are seen.
const GREENS: [[u8; 3]; 5] = [
    [255, 255, 255],
    [226, 242, 230],
    [181, 221, 192],
    [127, 194, 151],
    [74, 163, 114],
];
/// From low to high: lightness rises evenly, so that grey prints read too.
const LOW_TO_HIGH: [[u8; 3]; 5] = [
    [52, 24, 66],
    [58, 82, 139],
    [33, 145, 140],
    [122, 209, 81],
    [240, 236, 120],
];
/// Speeds with rings; more would hide the branches.
const MOST_SPEEDS: usize = 40;
/// Rows of the picture; more are not seen, and the largest of several is kept.
const MOST_ROWS: usize = 600;
/// The smallest amplitude, as a share of the largest one, whose level is shown.
const LEAST_SHARE: f64 = 1e-15;
/// The lowest level of a spectrum, in dB.
const LEAST_DB: f64 = -100.0;

fn written(chart: &ChartData) -> PyResult<String> {
    Ok(serde_json::to_string(chart).map_err(Failure::from)?)
}

/// A scene in axial view: blade, guides, cut and probe, and the positive directions of angles and rotation.
#[pyfunction]
pub fn saw_chart(scene: &str) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let file = scene.file();
    let rim = 0.5 * file.blade.outer_diameter_m;
    let frame = [-1.2 * rim, 1.2 * rim];
    let panel = PanelData {
        equal: true,
        ..PanelData::new(
            AxisData::new("x, angle 0 to the right", "m").within(frame),
            AxisData::new("y", "m").within(frame),
            saw_items(file, collar_m(&scene), rim),
        )
    };
    let facts = vec![
        format!(
            "{} mm outside",
            shown_to(6, 1e3 * file.blade.outer_diameter_m)
        ),
        format!("{} guides", file.guides.len()),
    ];
    written(&ChartData::new(&file.name, facts, vec![panel]))
}

fn saw_items(file: &SceneFile, collar_m: Option<f64>, rim: f64) -> Vec<Item> {
    let circle = |radius, colour, name| Item::Line(arc(radius, [0.0, 360.0], colour, name));
    let mut items = vec![
        circle(rim, Hue::Ink, "rim"),
        circle(0.5 * file.blade.inner_diameter_m, Hue::Ink, "bore"),
    ];
    items.extend(collar_m.map(|radius| circle(radius, Hue::Quiet, "collar")));
    for (place, guide) in file.guides.iter().enumerate() {
        let corners = guide.outline_m();
        let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
        let (name, mm) = (
            format!("guides[{place}]"),
            shown_to(4, 1e3 * guide.radius_m),
        );
        let (angle, stiffness) = (guide.angle_deg, shown_to(4, guide.stiffness_n_per_m));
        let said = format!("{name}\n{mm} mm, {angle}°\n{stiffness} N/m");
        items.push(Item::Line(Line {
            said: vec![said; closed.len()],
            ..Line::new(closed, Hue::Forward, &name)
        }));
    }
    if let Some(cut) = &file.cut {
        let teeth = cut.teeth_in_cut.zip(file.blade.teeth.filter(|of| *of > 0));
        let half = match (teeth, cut.depth_m) {
            (Some((teeth, of)), _) => 180.0 * f64::from(teeth) / f64::from(of),
            (None, Some(depth)) => 0.5 * (depth / rim).to_degrees(),
            (None, None) => 0.5 * CUT_DEG,
        };
        let ends = [cut.angle_deg - half, cut.angle_deg + half];
        items.push(Item::Line(Line {
            width: 4.0,
            end: "cut".to_owned(),
            ..arc(rim, ends, Hue::Alarm, "cut")
        }));
    }
    if let Some(probe) = &file.probe {
        let at = polar(probe.radius_m.unwrap_or(rim), probe.angle_deg);
        items.push(Item::Points(Points::new([at], Hue::Backward, 7.0, "probe")));
    }
    let radius = 1.08 * rim;
    let head = [(0.97, 4.0), (1.0, 0.0), (1.03, 4.0)];
    let head = head.map(|(share, before)| polar(share * radius, ARROW_DEG[1] - before));
    items.push(Item::Line(Line {
        end: "rotation, positive angles".to_owned(),
        ..arc(radius, ARROW_DEG, Hue::Quiet, "rotation")
    }));
    items.push(Item::Line(Line::new(head, Hue::Quiet, "rotation")));
    items
}

fn arc(radius_m: f64, [begin, end]: [f64; 2], colour: Hue, name: &str) -> Line {
    let step = (end - begin) / f64::from(CIRCLE);
    let places = (0..=CIRCLE).map(|k| polar(radius_m, begin + f64::from(k) * step));
    Line::new(places, colour, name)
}

fn polar(radius_m: f64, angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    [radius_m * cos, radius_m * sin]
}

/// Radius of the edge of a collar or flange; none on a spline.
fn collar_m(scene: &Scene) -> Option<f64> {
    let bore_m = 0.5 * scene.file().blade.inner_diameter_m;
    let inner_m = scene.blade().inner_radius_m;
    (inner_m > bore_m).then_some(inner_m)
}

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

/// Speeds over the stiffness of guides, an object of Python with these attributes.
#[derive(FromPyObject)]
pub struct StiffnessMap {
    name: String,
    stiffness_n_per_m: Vec<f64>,
    /// A row for each stiffness.
    critical_rpm: Vec<Vec<f64>>,
    flutter_rpm: Vec<f64>,
}

/// Critical speeds and flutter speed over the stiffness of the guides.
#[pyfunction]
pub fn stiffness_chart(of: StiffnessMap) -> PyResult<String> {
    let over = |values: Vec<f64>| {
        of.stiffness_n_per_m
            .iter()
            .copied()
            .zip(values)
            .map(|(x, y)| [x, y])
    };
    let count = of.critical_rpm.iter().map(Vec::len).max().unwrap_or(0);
    let critical = (0..count).map(|place| {
        let speeds = of
            .critical_rpm
            .iter()
            .map(|row| row.get(place).copied().unwrap_or(f64::NAN));
        let name = format!("critical speed {}", place + 1);
        Item::Line(Line::new(over(speeds.collect()), Hue::Forward, &name))
    });
    let flutter = Item::Line(Line {
        width: STRONG_CURVE,
        ..Line::new(over(of.flutter_rpm.clone()), Hue::Flutter, "flutter speed")
    });
    let panel = PanelData::new(
        AxisData::new("stiffness of each guide", "N/m").spread(Spread::Logarithmic),
        AxisData::new("rotation speed", "rpm"),
        critical.chain([flutter]).collect(),
    );
    let facts = vec!["critical speeds (thin) and flutter speed (thick)".to_owned()];
    written(&ChartData::new(&of.name, facts, vec![panel]))
}

/// A speed over the two numbers of a grid: rows of both and of the speed, which is the median where several random saws
/// have the same numbers.
#[pyfunction]
pub fn grid_chart(
    title: &str,
    paths: [String; 2],
    speed: &str,
    rows: Vec<[f64; 3]>,
) -> PyResult<String> {
    let values = |axis: usize| {
        let mut values: Vec<f64> = rows.iter().map(|row| row[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let (x, y) = (values(0), values(1));
    let cell = |x: f64, y: f64| {
        let own = rows
            .iter()
            .filter(|row| row[0] == x && row[1] == y)
            .map(|row| row[2]);
        let mut speeds: Vec<f64> = own.collect();
        speeds.sort_by(f64::total_cmp);
        let middle = speeds.get(speeds.len() / 2)?;
        let before = speeds.get((speeds.len() - 1) / 2)?;
        Some(0.5 * (before + middle)).filter(|_| speeds.iter().all(|speed| speed.is_finite()))
    };
    let row = |y: &f64| x.iter().map(|x| cell(*x, *y).unwrap_or(f64::NAN)).collect();
    let z: Vec<Vec<f64>> = y.iter().map(row).collect();
    let known = || {
        z.iter()
            .flatten()
            .copied()
            .filter(|value| value.is_finite())
    };
    let range = [
        known().fold(f64::INFINITY, f64::min),
        known().fold(f64::NEG_INFINITY, f64::max),
    ];
    let name = format!("{} speed", speed.trim_end_matches("_rpm").replace('_', " "));
    let heat = Heat {
        x,
        y,
        z,
        range: if range[0] < range[1] {
            range
        } else {
            [range[0].min(0.0), range[0].max(1.0)]
        },
        spread: Spread::Linear,
        colours: LOW_TO_HIGH.to_vec(),
        name: name.clone(),
        unit: "rpm".to_owned(),
    };
    let [across, up] = paths.map(|path| match Quantity::of(&path) {
        Some(quantity) => AxisData::new(quantity.name, quantity.unit),
        None => AxisData::new(&path, ""),
    });
    let panel = PanelData::new(across, up, vec![Item::Heat(heat)]);
    written(&ChartData::new(
        title,
        vec![format!("{name} [rpm]")],
        vec![panel],
    ))
}
