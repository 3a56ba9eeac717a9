//! Contents of a figure, as numbers and text in the units of its axes.
//!
//! The live page, the Python package and some figures of this crate draw [`ChartData`]; each of them decides where
//! labels have room.

use serde::Serialize;

use super::axis::{Axis, Spread};
use super::palette::Hue;
use super::style::CURVE;

/// Panels one above the other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    /// Title of the figure.
    pub title: String,
    /// Statements below the title.
    pub facts: Vec<String>,
    /// Panels from top to bottom.
    pub panels: Vec<PanelData>,
    /// Samples of the marks, each with its meaning as name; they have no points.
    pub key: Vec<Item>,
}

/// Axes and contents of a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Title above the panel; empty if there is none.
    pub title: String,
    /// Horizontal axis.
    pub x: AxisData,
    /// Vertical axis.
    pub y: AxisData,
    /// Height relative to that of the other panels.
    pub share: f64,
    /// Whether the panel shows frequencies over the rotation speed, so that multiples of the speed are
    /// straight lines.
    pub harmonics: bool,
    /// Text inside the panel, for instance that no motion grows; empty if there is none.
    pub note: String,
    /// Contents in drawing order.
    pub items: Vec<Item>,
}

impl PanelData {
    /// A panel without a title.
    pub(super) fn new(x: AxisData, y: AxisData, items: Vec<Item>) -> Self {
        Self {
            title: String::new(),
            x,
            y,
            share: 1.0,
            harmonics: false,
            note: String::new(),
            items,
        }
    }
}

/// Quantity, range and scale of an axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisData {
    /// Name of the quantity.
    pub name: String,
    /// Unit of the quantity; empty if it has none.
    pub unit: String,
    /// First and last value; `None` if the contents determine them.
    pub range: Option<[f64; 2]>,
    /// Scale of the axis.
    pub spread: Spread,
    /// Values with a tick; empty if they follow from the range.
    pub ticks: Vec<f64>,
    /// Names of the values 1, 2, 3, …, which are written in the place of numbers; empty if numbers are written.
    pub names: Vec<String>,
}

impl AxisData {
    /// A linear axis whose range is determined by its contents.
    pub(super) fn new(name: &str, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            range: None,
            spread: Spread::Linear,
            ticks: Vec::new(),
            names: Vec::new(),
        }
    }

    /// The axis with a range.
    pub(super) fn within(self, range: [f64; 2]) -> Self {
        Self {
            range: Some(range),
            ..self
        }
    }

    /// The axis with a scale.
    pub(super) fn spread(self, spread: Spread) -> Self {
        Self { spread, ..self }
    }

    /// The axis between two positions on a sheet, from 0 to 1 without a range.
    pub(super) fn placed(&self, places: [f64; 2]) -> Axis {
        Axis::new(self.range.unwrap_or([0.0, 1.0]), places, self.spread)
    }

    /// Name of the quantity with its unit, as written at the axis.
    pub(super) fn title(&self) -> String {
        format!("{}\u{2003}[{}]", self.name, self.unit)
    }

    /// The axis of rotation speeds in rpm.
    pub(super) fn speed() -> Self {
        Self::new("rotation speed Ω", "rpm")
    }
}

/// An element of a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "item", rename_all = "snake_case")]
pub enum Item {
    /// Speeds of instability.
    Band(Band),
    /// A vertical line at one value.
    Upright(Upright),
    /// A curve through points.
    Line(Line),
    /// Dots or rings at points.
    Points(Points),
    /// An area between two curves.
    Area(Area),
}

/// A band of instability: speeds that are shaded over the height of the panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// First speed, in rpm.
    pub from: f64,
    /// Last speed, in rpm.
    pub to: f64,
    /// Ranges of speed that are shaded, in rpm; empty for wide bands whose growth is below the threshold.
    pub shaded: Vec<[f64; 2]>,
    /// Colour of the shade.
    pub shade: Hue,
    /// Colour of the shade if the band is so narrow that `shade` would not be visible.
    pub streak: Hue,
    /// Colour of the label.
    pub colour: Hue,
    /// Kind and range of the band.
    pub label: String,
    /// Text that the page shows while the mouse pointer is on the band: label and waves.
    pub name: String,
    /// Largest growth rate. If there is no room for all labels, those of the bands with the largest growth are written.
    pub peak_growth_per_s: f64,
}

/// Meaning of a vertical line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A critical speed.
    Critical,
    /// The operating speed.
    Operating,
    /// Another meaning, given by its name.
    Guide,
}

/// A vertical line over the height of the panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Upright {
    /// Abscissa of the line.
    pub x: f64,
    /// Meaning of the line.
    pub role: Role,
    /// Colour of the line.
    pub colour: Hue,
    /// Whether the line is dashed.
    pub dashed: bool,
    /// Label at the upper end; empty if there is none.
    pub label: String,
    /// Text that the page shows while the mouse pointer is on the line.
    pub name: String,
}

impl Upright {
    /// The line of a critical speed in rpm, with the name of its wave.
    pub(crate) fn critical(rpm: f64, wave: &str) -> Self {
        Upright {
            x: rpm,
            role: Role::Critical,
            colour: Hue::Quiet,
            dashed: true,
            label: format!("{rpm:.0}"),
            name: format!("critical speed {rpm:.0} rpm: {wave}"),
        }
    }
}

/// A curve through points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Abscissae of the points; NaN interrupts the curve.
    pub x: Vec<f64>,
    /// Ordinates of the points; NaN interrupts the curve.
    pub y: Vec<f64>,
    /// Colour of the curve.
    pub colour: Hue,
    /// Share of the colour in a mixture with that of the paper, from 0 to 1.
    pub tint: f64,
    /// Width in a figure of width 1200.
    pub width: f64,
    /// Whether the curve is dashed.
    pub dashed: bool,
    /// Whether the curve has the head of an arrow at its end.
    pub arrow: bool,
    /// Text that the page shows while the mouse pointer is on the curve.
    pub name: String,
    /// Text with line breaks that the page shows for each point; empty if `name` describes all of them.
    pub said: Vec<String>,
    /// Label at the end; empty if there is none.
    pub end: String,
    /// Number of the branch, from 1 on, if the curve is part of one.
    pub branch: Option<usize>,
}

impl Line {
    /// A solid curve through points.
    pub(super) fn new(points: impl IntoIterator<Item = [f64; 2]>, colour: Hue, name: &str) -> Self {
        let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
        Self {
            x,
            y,
            colour,
            tint: 1.0,
            width: CURVE,
            dashed: false,
            arrow: false,
            name: name.to_owned(),
            said: Vec::new(),
            end: String::new(),
            branch: None,
        }
    }
}

/// Points of a series with a factor for its values; a value that is not known interrupts the curve.
pub(super) fn series<'a>(
    x: &'a [f64],
    y: &'a [Option<f64>],
    factor: f64,
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let pairs = x.iter().zip(y);
    pairs.map(move |(x, y)| [*x, y.map_or(f64::NAN, |y| factor * y)])
}

/// Dots or rings at points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Points {
    /// Abscissae of the centres.
    pub x: Vec<f64>,
    /// Ordinates of the centres.
    pub y: Vec<f64>,
    /// Colour of the marks.
    pub colour: Hue,
    /// Share of the colour in a mixture with that of the paper, from 0 to 1.
    pub tint: f64,
    /// Diameter in a figure of width 1200.
    pub size: f64,
    /// Whether the marks are rings.
    pub hollow: bool,
    /// Text that the page shows while the mouse pointer is on the points.
    pub name: String,
    /// Text with line breaks that the page shows for each point; empty if `name` describes all of them.
    pub said: Vec<String>,
}

impl Points {
    /// Dots at points, with a diameter of `size`.
    pub(super) fn new(
        points: impl IntoIterator<Item = [f64; 2]>,
        colour: Hue,
        size: f64,
        name: &str,
    ) -> Self {
        let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
        Self {
            x,
            y,
            colour,
            tint: 1.0,
            size,
            hollow: false,
            name: name.to_owned(),
            said: Vec::new(),
        }
    }
}

/// An area between two curves, of one colour.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Area {
    /// Abscissae, ascending; each ordinate holds half way to the next abscissae.
    pub x: Vec<f64>,
    /// Ordinates of the lower edge.
    pub low: Vec<f64>,
    /// Ordinates of the upper edge; there is no area where it is not above the lower one.
    pub high: Vec<f64>,
    /// Colour of the area.
    pub colour: Hue,
    /// Share of the colour in a mixture with that of the paper, from 0 to 1.
    pub tint: f64,
    /// Meaning of the area.
    pub name: String,
}

impl Area {
    /// An area of columns with an abscissa, a lower and an upper end.
    pub(super) fn new(
        columns: impl IntoIterator<Item = [f64; 3]>,
        colour: Hue,
        name: &str,
    ) -> Self {
        let mut area = Self {
            x: Vec::new(),
            low: Vec::new(),
            high: Vec::new(),
            colour,
            tint: 1.0,
            name: name.to_owned(),
        };
        for [x, low, high] in columns {
            area.x.push(x);
            area.low.push(low);
            area.high.push(high);
        }
        area
    }
}

impl Item {
    /// A sample of a line for the key.
    pub(super) fn line_sample(width: f64, dashed: bool, colour: Hue, name: &str) -> Self {
        Item::Line(Line {
            width,
            dashed,
            ..Line::new([], colour, name)
        })
    }

    /// A sample of dots, or of rings, for the key.
    pub(super) fn points_sample(size: f64, hollow: bool, colour: Hue, name: &str) -> Self {
        Item::Points(Points {
            hollow,
            ..Points::new([], colour, size, name)
        })
    }

    /// A sample of an area for the key.
    pub(super) fn area_sample(colour: Hue, name: &str) -> Self {
        Item::Area(Area::new([], colour, name))
    }
}

/// Lines through samples, one for each style. `look` returns the style between a sample and the next, or `None` if
/// no line is drawn there. The result lists for each style the numbers of the samples; `None` interrupts the line.
pub(super) fn lines_by_look<L: PartialEq>(
    samples: usize,
    look: impl Fn(usize) -> Option<L>,
) -> Vec<(L, Vec<Option<usize>>)> {
    let mut lines: Vec<(L, Vec<Option<usize>>)> = Vec::new();
    for i in 0..samples.saturating_sub(1) {
        let Some(look) = look(i) else { continue };
        match lines.iter_mut().find(|(other, _)| *other == look) {
            Some((_, line)) if line.last() == Some(&Some(i)) => line.push(Some(i + 1)),
            Some((_, line)) => line.extend([None, Some(i), Some(i + 1)]),
            None => lines.push((look, vec![Some(i), Some(i + 1)])),
        }
    }
    lines
}
