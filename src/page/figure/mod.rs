//! Figures: charts as data, their layout on a sheet, and the sheet as PNG or SVG.
//!
//! An analysis describes its chart as [`ChartData`]: panels with axes and items (`items`). `layout` arranges axes, key and
//! labels on a sheet of marks in figure units, and a [`Figure`] renders the sheet to PNG bytes or to SVG text. The same
//! data are painted by the live page, matplotlib and plotly. This module knows no physics and writes no files.

pub(crate) mod axis;
pub(crate) mod axis_drawing;
pub(crate) mod bands;
pub(crate) mod canvas;
pub(crate) mod chart_data;
pub(crate) mod clipping;
pub(crate) mod drawing;
pub(crate) mod heading;
pub(crate) mod heat;
pub(crate) mod items;
pub(crate) mod key;
pub(crate) mod label_placement;
pub(crate) mod labels;
pub(crate) mod layout;
pub(crate) mod letters;
pub(crate) mod painting;
pub(crate) mod palette;
pub(crate) mod panel;
pub(crate) mod raster;
pub(crate) mod style;
pub(crate) mod svg;
pub(crate) mod tidiness;

pub use axis::Spread;
pub use chart_data::{AxisData, ChartData, PanelData};
pub(crate) use drawing::Drawing;
pub use drawing::Figure;
pub use items::{Area, Band, Bars, Heat, Item, Label, Line, Points, Role, Shape, Upright};
pub use palette::{Hue, LOW_TO_HIGH};
#[doc(hidden)]
pub use palette::{PALETTE, Palette};
pub use style::{CURVE, STRONG_CURVE};

/// Error of rendering a figure.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The drawing library plotters returned an error for a mark.
    #[error("a figure cannot be drawn")]
    Draw(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// The picture could not be encoded as PNG.
    #[error("a figure cannot be packed as PNG")]
    Png(#[from] png::EncodingError),
}
