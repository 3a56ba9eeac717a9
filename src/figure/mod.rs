//! Figures, drawn from a [`report`](crate::report) alone.
//!
//! [`CommandReport::figures`](crate::commands::CommandReport::figures) returns the figures of a report. A [`Figure`] is a list of marks in figure units, which is
//! rendered to PNG bytes or to SVG text. This module writes no files.

mod along;
mod axis;
mod bands;
pub(crate) mod campbell;
mod canvas;
mod chart_data;
pub(crate) mod check;
mod clip;
pub(crate) mod compare;
pub(crate) mod cut;
pub(crate) mod cut_map;
#[cfg(test)]
mod cutting_tests;
mod declutter;
pub(crate) mod deflect;
mod drawn;
#[cfg(test)]
mod drawn_tests;
#[cfg(test)]
#[allow(dead_code, reason = "helpers of other properties")]
#[path = "../../tests/common/draws.rs"]
mod draws;
pub(crate) mod fit;
pub(crate) mod gap;
pub(crate) mod gap_friction;
pub(crate) mod gap_map;
pub(crate) mod gap_oscillation;
mod heading;
mod heat;
pub(crate) mod in_cut;
mod items;
mod key;
mod labels;
mod layout;
mod letters;
pub(crate) mod map;
mod meeting;
pub(crate) mod membrane;
pub(crate) mod modes;
mod paint;
mod palette;
mod panel;
pub(crate) mod place;
mod raster;
pub(crate) mod response;
pub(crate) mod response_map;
pub(crate) mod root_loci;
pub(crate) mod runup;
#[cfg(test)]
mod sample;
pub(crate) mod spline_orbit;
pub(crate) mod study;
mod style;
mod svg;
#[cfg(test)]
mod tidy;
mod tradeoff;
pub(crate) mod washboard;
mod written;

pub use axis::Spread;
pub use campbell::CampbellView;
pub use chart_data::{AxisData, ChartData, PanelData};
pub(crate) use drawn::Drawing;
pub use drawn::{Figure, tradeoff, tradeoff_chart};
pub use items::{Area, Band, Bars, Heat, Item, Label, Line, Points, Role, Shape, Upright};
pub use palette::Hue;
#[doc(hidden)]
pub use palette::{PALETTE, Palette};
#[cfg(test)]
pub(crate) use tidy::assert_tidy;
#[cfg(feature = "page")]
pub(crate) use written::name as number_name;

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
