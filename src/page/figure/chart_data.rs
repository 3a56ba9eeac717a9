//! Contents of a figure, as numbers and text in the units of its axes.
//!
//! `layout` paints [`ChartData`] as PNG and SVG, and the live page and the Python package paint it, too; each of them
//! decides where labels have room.

use serde::Serialize;

use super::axis::{Axis, Spread};
use super::items::{Item, Upright};
use super::palette::Hue;

/// Panels in rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    /// Title of the figure.
    pub title: String,
    /// Statements below the title.
    pub facts: Vec<String>,
    /// Panels, row by row.
    pub panels: Vec<PanelData>,
    /// Number of panels in a row.
    pub columns: usize,
    /// Samples of the marks, each with its meaning as name; they have no points.
    pub key: Vec<Item>,
}

impl ChartData {
    /// Panels one above the other, without a key.
    pub fn new(title: &str, facts: Vec<String>, panels: Vec<PanelData>) -> Self {
        Self {
            title: title.to_owned(),
            facts,
            panels,
            columns: 1,
            key: Vec::new(),
        }
    }
}

/// Axes and contents of a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Title above the panel; empty if there is none.
    pub title: String,
    /// Colour of this title.
    pub colour: Hue,
    /// Statements below this title.
    pub facts: Vec<String>,
    /// Horizontal axis.
    pub x: AxisData,
    /// Vertical axis.
    pub y: AxisData,
    /// Height relative to that of the other panels.
    pub share: f64,
    /// Whether a unit is as long on both axes.
    pub equal: bool,
    /// Whether the panel shows frequencies over the rotation speed, so that multiples of the speed are
    /// straight lines.
    pub harmonics: bool,
    /// Text inside the panel, for instance that no vibration grows; empty if there is none.
    pub note: String,
    /// Contents in drawing order.
    pub items: Vec<Item>,
}

impl PanelData {
    /// A panel without a title.
    pub fn new(x: AxisData, y: AxisData, items: Vec<Item>) -> Self {
        Self {
            title: String::new(),
            colour: Hue::Ink,
            facts: Vec::new(),
            x,
            y,
            share: 1.0,
            equal: false,
            harmonics: false,
            note: String::new(),
            items,
        }
    }
}

impl PanelData {
    /// The vertical lines.
    pub(crate) fn uprights(&self) -> impl Iterator<Item = &Upright> {
        self.items.iter().filter_map(|item| match item {
            Item::Upright(upright) => Some(upright),
            _ => None,
        })
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
    /// Names of these values, which are written in place of numbers; empty if numbers are written. A vertical axis has
    /// the first name at the top.
    pub names: Vec<String>,
}

impl AxisData {
    /// A linear axis whose range is determined by its contents.
    pub fn new(name: &str, unit: &str) -> Self {
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
    pub fn within(self, range: [f64; 2]) -> Self {
        Self {
            range: Some(range),
            ..self
        }
    }

    /// The axis with a scale.
    pub fn spread(self, spread: Spread) -> Self {
        Self { spread, ..self }
    }

    /// The axis between two positions on a sheet, from 0 to 1 without a range.
    pub(crate) fn placed(&self, places: [f64; 2]) -> Axis {
        Axis::new(self.range.unwrap_or([0.0, 1.0]), places, self.spread)
    }

    /// The axis with names at values.
    pub(crate) fn named(self, names: impl IntoIterator<Item = (f64, String)>) -> Self {
        let (ticks, names) = names.into_iter().unzip();
        Self {
            ticks,
            names,
            ..self
        }
    }

    /// Name of the quantity with its unit, as written at the axis.
    pub(crate) fn title(&self) -> String {
        with_unit(&self.name, &self.unit)
    }

    /// The axis of rotation speeds in rpm.
    pub fn speed() -> Self {
        Self::new("rotation speed Ω", "rpm")
    }
}

/// Name of a quantity with its unit, as written at an axis.
pub(crate) fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name}\u{2003}[{unit}]"),
    }
}
