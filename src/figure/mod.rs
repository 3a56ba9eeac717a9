//! Figures, drawn from a [`report`](crate::report) alone.
//!
//! [`Figures::figures`] returns the figures of a report. A [`Figure`] is a list of marks in figure units, which is
//! rendered to PNG bytes or to SVG text. This module writes no files.

mod along;
mod axis;
mod bands;
mod campbell;
mod canvas;
mod chart_data;
mod check;
mod clip;
mod columns;
mod compare;
mod cut;
mod cut_map;
#[cfg(test)]
mod cutting_tests;
mod declutter;
mod deflect;
mod drawn;
#[cfg(test)]
mod drawn_tests;
#[cfg(test)]
#[allow(dead_code, reason = "helpers of other properties")]
#[path = "../../tests/common/draws.rs"]
mod draws;
mod fit;
mod gap;
mod gap_friction;
mod gap_map;
mod gap_oscillation;
mod heading;
mod heat;
mod in_cut;
mod key;
mod letters;
mod map;
mod meeting;
mod membrane;
mod modes;
mod paint;
mod palette;
mod place;
mod place_map;
mod render;
mod response;
mod response_map;
mod root_loci;
mod runup;
#[cfg(test)]
mod sample;
mod spline_orbit;
mod study;
mod style;
#[cfg(test)]
mod tidy;
mod tradeoff;
mod washboard;
mod written;

pub use axis::Spread;
pub use campbell::CampbellView;
pub use chart_data::{AxisData, Band, ChartData, Item, Line, PanelData, Points, Role, Upright};
pub use drawn::{Figure, Figures, tradeoff};
pub use palette::Hue;
#[doc(hidden)]
pub use palette::{PALETTE, Palette};
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
