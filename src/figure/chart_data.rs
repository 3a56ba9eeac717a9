//! What a figure shows, as numbers and words in the units of its axes.
//!
//! The figures of this crate, the page and the Python package draw the same [`ChartData`]. Where a label has room is the
//! matter of whoever draws.

use serde::Serialize;

use super::axis::{Axis, Spread};
use super::palette::Hue;
use super::style::CURVE;

/// Panels one above the other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartData {
    /// Title.
    pub title: String,
    /// What is said below the title.
    pub facts: Vec<String>,
    /// The panels, from above.
    pub panels: Vec<PanelData>,
}

/// Axes and what is drawn into them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelData {
    /// Title; empty where there is none.
    pub title: String,
    /// The horizontal axis.
    pub x: AxisData,
    /// The vertical axis.
    pub y: AxisData,
    /// Height beside that of the other panels.
    pub share: f64,
    /// Whether it shows frequencies over the rotation speed, so that multiples of the speed are lines.
    pub harmonics: bool,
    /// What is said where there is nothing to be seen; empty otherwise.
    pub note: String,
    /// What is drawn, from below to above.
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
    /// What it shows.
    pub name: String,
    /// Unit; empty where there is none.
    pub unit: String,
    /// First and last value; as far as the items reach where it is `None`.
    pub range: Option<[f64; 2]>,
    /// How the values are spread along it.
    pub spread: Spread,
    /// Words at the places 1, 2, 3 … in place of numbers.
    pub names: Vec<String>,
}

impl AxisData {
    /// An even axis as long as what it shows.
    pub(super) fn new(name: &str, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            range: None,
            spread: Spread::Linear,
            names: Vec::new(),
        }
    }

    /// From one value to another.
    pub(super) fn within(self, range: [f64; 2]) -> Self {
        Self {
            range: Some(range),
            ..self
        }
    }

    /// With its values spread in another way.
    pub(super) fn spread(self, spread: Spread) -> Self {
        Self { spread, ..self }
    }

    /// From its first place on a sheet to its last.
    pub(super) fn placed(&self, places: [f64; 2]) -> Axis {
        Axis::new(self.range.unwrap_or([0.0, 1.0]), places, self.spread)
    }

    /// Name and unit as they are written on a sheet.
    pub(super) fn title(&self) -> String {
        format!("{}\u{2003}[{}]", self.name, self.unit)
    }

    /// The axis of rotation speeds.
    pub(super) fn speed() -> Self {
        Self::new("rotation speed Ω", "rpm")
    }
}

/// One thing drawn.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "item", rename_all = "snake_case")]
pub enum Item {
    /// Speeds over the height of the panel.
    Band(Band),
    /// A line over the height of the panel.
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
    /// The stretches of it that are shaded.
    pub shaded: Vec<[f64; 2]>,
    /// Colour of its shade.
    pub shade: Hue,
    /// Colour of its shade where that is too narrow to be seen.
    pub streak: Hue,
    /// Colour of its label.
    pub colour: Hue,
    /// What is written at it.
    pub label: String,
    /// What it is.
    pub name: String,
    /// Largest growth rate: where there is not room for every label, those of the largest are written.
    pub peak_growth_per_s: f64,
}

/// What an upright line says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A critical speed.
    Critical,
    /// The operating speed.
    Operating,
    /// What its name says.
    Guide,
}

/// A line over the height of the panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Upright {
    /// Where it stands.
    pub x: f64,
    /// What it says.
    pub role: Role,
    /// Colour.
    pub colour: Hue,
    /// Whether it is dashed.
    pub dashed: bool,
    /// What is written at its upper end.
    pub label: String,
    /// What it is.
    pub name: String,
}

/// A curve; a number that is none interrupts it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Line {
    /// Horizontal places.
    pub x: Vec<f64>,
    /// Vertical places.
    pub y: Vec<f64>,
    /// Colour.
    pub colour: Hue,
    /// Share of the colour, mixed with that of the paper.
    pub tint: f64,
    /// Width on a figure 1200 wide.
    pub width: f64,
    /// Whether it is dashed.
    pub dashed: bool,
    /// What it is.
    pub name: String,
    /// What is said of each of its points, on lines of its own; nothing where that was not asked for.
    pub said: Vec<String>,
    /// What is written at its end; empty where nothing is.
    pub end: String,
    /// Number of the branch that it belongs to.
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
    /// Horizontal places.
    pub x: Vec<f64>,
    /// Vertical places.
    pub y: Vec<f64>,
    /// Colour.
    pub colour: Hue,
    /// Share of the colour, mixed with that of the paper.
    pub tint: f64,
    /// Diameter on a figure 1200 wide.
    pub size: f64,
    /// Whether they are rings.
    pub hollow: bool,
    /// What they are.
    pub name: String,
    /// What is said of each of them; nothing where that was not asked for.
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

/// Lines through samples that look alike, each interrupted where another look begins: between two
/// samples as `look` says, not drawn where it says nothing.
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
