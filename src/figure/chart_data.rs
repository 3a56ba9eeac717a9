//! Contents of a figure, as numbers and text in the units of its axes.
//!
//! The figures of this crate, the live page and the Python package draw the same [`ChartData`]. Each of them
//! decides where labels have room.

use serde::Serialize;

use super::axis::{Axis, Spread};
use super::palette::Hue;
use super::style::CURVE;

/// Panels one above the other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    /// Title of the panel.
    pub title: String,
    /// Lines below the title.
    pub facts: Vec<String>,
    /// The panels, from top to bottom.
    pub panels: Vec<PanelData>,
}

/// Axes of a panel, and its contents.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Title; empty if there is none.
    pub title: String,
    /// The horizontal axis.
    pub x: AxisData,
    /// The vertical axis.
    pub y: AxisData,
    /// Height relative to that of the other panels.
    pub share: f64,
    /// Whether the panel shows frequencies over the rotation speed, so that multiples of the speed are
    /// straight lines.
    pub harmonics: bool,
    /// Note to show if the panel is empty; otherwise empty.
    pub note: String,
    /// Contents, in drawing order.
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

/// An axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisData {
    /// Name of the quantity.
    pub name: String,
    /// Unit; empty if there is none.
    pub unit: String,
    /// First and last value; `None` if the contents determine them.
    pub range: Option<[f64; 2]>,
    /// Scale of the axis.
    pub spread: Spread,
    /// Names of the positions 1, 2, 3 … that replace numbers.
    pub names: Vec<String>,
}

impl AxisData {
    /// A linear axis whose range its contents determine.
    pub(super) fn new(name: &str, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            range: None,
            spread: Spread::Linear,
            names: Vec::new(),
        }
    }

    /// Sets the range.
    pub(super) fn within(self, range: [f64; 2]) -> Self {
        Self {
            range: Some(range),
            ..self
        }
    }

    /// Sets the scale.
    pub(super) fn spread(self, spread: Spread) -> Self {
        Self { spread, ..self }
    }

    /// The axis between two positions on a sheet.
    pub(super) fn placed(&self, places: [f64; 2]) -> Axis {
        Axis::new(self.range.unwrap_or([0.0, 1.0]), places, self.spread)
    }

    /// Name and unit.
    pub(super) fn title(&self) -> String {
        format!("{}\u{2003}[{}]", self.name, self.unit)
    }

    /// The axis of rotation speeds.
    pub(super) fn speed() -> Self {
        Self::new("rotation speed Ω", "rpm")
    }
}

/// An element of a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "item", rename_all = "snake_case")]
pub enum Item {
    /// A range of speeds over the height of the panel.
    Band(Band),
    /// A vertical line over the height of the panel.
    Upright(Upright),
    /// A curve.
    Line(Line),
    /// Dots or rings.
    Points(Points),
}

/// A band of instability: speeds that are shaded over the height of the panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Parts that are shaded.
    pub shaded: Vec<[f64; 2]>,
    /// Colour of the shade.
    pub shade: Hue,
    /// Colour of the shade of a band that is too narrow to be visible.
    pub streak: Hue,
    /// Colour of the label.
    pub colour: Hue,
    /// Label.
    pub label: String,
    /// Description, shown at the pointer.
    pub name: String,
    /// Largest growth rate. If there is no room for all labels, those of largest growth are written.
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
    /// Position.
    pub x: f64,
    /// Meaning of the item.
    pub role: Role,
    /// Colour.
    pub colour: Hue,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Label at the upper end.
    pub label: String,
    /// Description, shown at the pointer.
    pub name: String,
}

impl Upright {
    /// The line of a critical speed.
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

/// A curve; a NaN interrupts it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
    /// Colour.
    pub colour: Hue,
    /// Share of the colour in the mixture with that of the paper.
    pub tint: f64,
    /// Width in a figure of width 1200.
    pub width: f64,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Description, shown at the pointer.
    pub name: String,
    /// Description of each point, with line breaks; empty unless requested.
    pub said: Vec<String>,
    /// Label at the end; empty if there is none.
    pub end: String,
    /// Number of its branch.
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
            name: name.to_owned(),
            said: Vec::new(),
            end: String::new(),
            branch: None,
        }
    }
}

/// Dots or rings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Points {
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
    /// Colour.
    pub colour: Hue,
    /// Share of the colour in the mixture with that of the paper.
    pub tint: f64,
    /// Diameter in a figure of width 1200.
    pub size: f64,
    /// Whether they are rings.
    pub hollow: bool,
    /// Description, shown at the pointer.
    pub name: String,
    /// Description of each point; empty unless requested.
    pub said: Vec<String>,
}

impl Points {
    /// Dots.
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

/// Lines through samples, divided where the style changes. `look` returns the style between two samples, or
/// `None` if nothing is drawn.
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
