//! Speeds of many saws: over the stiffness of their guides, and over two numbers.

use pyo3::prelude::*;
use sawflutter::model::scene::Quantity;
use sawflutter::page::figure::{
    AxisData, ChartData, Heat, Hue, Item, LOW_TO_HIGH, Line, PanelData, STRONG_CURVE, Spread,
};

use super::written;

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
