//! Elements of a panel of a chart.

use serde::Serialize;

use super::axis::Spread;
use super::palette::Hue;
use super::style::{CURVE, Colour, HAIRLINE};

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
    /// Marks at points.
    Points(Points),
    /// An area between two curves.
    Area(Area),
    /// Colours of the cells of a grid.
    Heat(Heat),
    /// Columns from zero on.
    Bars(Bars),
    /// A text at a point.
    Label(Label),
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
    /// Label on the curve, as close to its middle as there is room; empty if there is none.
    pub label: String,
    /// Number of the branch, from 1 on, if the curve is part of one.
    pub branch: Option<usize>,
}

impl Line {
    /// A solid curve through points.
    pub fn new(points: impl IntoIterator<Item = [f64; 2]>, colour: Hue, name: &str) -> Self {
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
            label: String::new(),
            branch: None,
        }
    }

    /// A straight line between two points, for the value of a limit.
    pub(crate) fn guide(ends: [[f64; 2]; 2], colour: Hue, name: &str) -> Self {
        Self {
            width: HAIRLINE,
            dashed: true,
            ..Line::new(ends, colour, name)
        }
    }
}

/// Points of a series with a factor for its values; a value that is not known interrupts the curve.
pub(crate) fn series<'a>(
    x: &'a [f64],
    y: &'a [Option<f64>],
    factor: f64,
) -> impl Iterator<Item = [f64; 2]> + 'a {
    let pairs = x.iter().zip(y);
    pairs.map(move |(x, y)| [*x, y.map_or(f64::NAN, |y| factor * y)])
}

/// Shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A filled circle.
    Disc,
    /// A circle with the colour of the paper inside.
    Ring,
    /// A filled square.
    Square,
    /// Two diagonal lines.
    Cross,
}

/// Marks at points.
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
    /// Shape of the marks.
    pub shape: Shape,
    /// Text that the page shows while the mouse pointer is on the points.
    pub name: String,
    /// Text with line breaks that the page shows for each point; empty if `name` describes all of them.
    pub said: Vec<String>,
}

impl Points {
    /// Dots at points, with a diameter of `size`.
    pub fn new(
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
            shape: Shape::Disc,
            name: name.to_owned(),
            said: Vec::new(),
        }
    }
}

/// An area between two curves, of one colour.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Area {
    /// Abscissae, ascending.
    pub x: Vec<f64>,
    /// Ordinates of the lower edge.
    pub low: Vec<f64>,
    /// Ordinates of the upper edge; there is no area where it is not above the lower one.
    pub high: Vec<f64>,
    /// Whether each ordinate holds half way to the next abscissae; otherwise the edges are straight between them.
    pub stepped: bool,
    /// Colour of the area.
    pub colour: Hue,
    /// Share of the colour in a mixture with that of the paper, from 0 to 1.
    pub tint: f64,
    /// Meaning of the area.
    pub name: String,
}

impl Area {
    /// An area of columns with an abscissa, a lower and an upper end.
    pub(crate) fn new(
        columns: impl IntoIterator<Item = [f64; 3]>,
        colour: Hue,
        name: &str,
    ) -> Self {
        let mut area = Self {
            x: Vec::new(),
            low: Vec::new(),
            high: Vec::new(),
            stepped: true,
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

/// Colours of the cells of a grid. A cell ends half way to the next points, and at the ends of the axes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Heat {
    /// Abscissae of the columns, ascending.
    pub x: Vec<f64>,
    /// Ordinates of the rows, ascending.
    pub y: Vec<f64>,
    /// Values in a list for each row; cells with NaN are left out.
    pub z: Vec<Vec<f64>>,
    /// Values of the first and of the last colour.
    pub range: [f64; 2],
    /// Scale of the colours.
    pub spread: Spread,
    /// Colours from small to large values, each as red, green and blue from 0 to 255. One colour is that of a class of cells,
    /// whose values have no meaning.
    pub colours: Vec<[u8; 3]>,
    /// Name of the values, or meaning of the class.
    pub name: String,
    /// Unit of the values; empty if they have none.
    pub unit: String,
}

impl Heat {
    /// The cells of a class on a grid; `is_in` tells for a column and a row whether the cell belongs to it.
    pub(crate) fn class(
        [x, y]: [&[f64]; 2],
        is_in: impl Fn(usize, usize) -> bool,
        colour: Colour,
        name: &str,
    ) -> Self {
        let row = |row| {
            let cells = (0..x.len()).map(|column| is_in(column, row));
            cells.map(|own| if own { 1.0 } else { f64::NAN }).collect()
        };
        Self {
            x: x.to_vec(),
            y: y.to_vec(),
            z: (0..y.len()).map(row).collect(),
            range: [0.0, 1.0],
            spread: Spread::Linear,
            colours: vec![[colour.0, colour.1, colour.2]],
            name: name.to_owned(),
            unit: String::new(),
        }
    }

    /// Whether the cells have the colours of a scale, and not that of a class.
    pub(crate) fn has_scale(&self) -> bool {
        self.colours.len() > 1
    }
}

/// Columns from zero on, for a histogram.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bars {
    /// Abscissae of the edges, one more than columns.
    pub edges: Vec<f64>,
    /// Ordinates of the upper ends.
    pub heights: Vec<f64>,
    /// Colour of the columns.
    pub colour: Hue,
    /// Share of the colour in a mixture with that of the paper, from 0 to 1.
    pub tint: f64,
    /// Meaning of the columns.
    pub name: String,
}

/// A text beside a point, where there is room.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Label {
    /// Abscissa of the point.
    pub x: f64,
    /// Ordinate of the point.
    pub y: f64,
    /// Colour of the letters.
    pub colour: Hue,
    /// The text.
    pub text: String,
}

impl Item {
    /// A text beside a point.
    pub(crate) fn label([x, y]: [f64; 2], colour: Hue, text: String) -> Self {
        Item::Label(Label { x, y, colour, text })
    }
}

/// Lines through samples, one for each style. `look` returns the style between a sample and the next, or `None` if
/// no line is drawn there. The result lists for each style the numbers of the samples; `None` interrupts the line.
pub(crate) fn lines_by_look<L: PartialEq>(
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
