//! Figures, drawn from a [`report`](crate::report) alone.
//!
//! A figure is first laid out on a `Sheet`, a list of marks in
//! figure units, and then rendered to PNG bytes or an SVG string. Nothing here
//! writes files.

mod axis;
mod bands;
mod campbell;
mod canvas;
mod check;
mod clip;
mod columns;
mod cut;
mod cut_map;
#[cfg(test)]
mod cutting_tests;
mod declutter;
#[cfg(test)]
mod drawn_tests;
#[cfg(test)]
#[allow(dead_code, reason = "helpers of other properties")]
#[path = "../../tests/invariants/draws.rs"]
mod draws;
mod fit;
mod heading;
mod heat;
mod key;
mod meeting;
mod membrane;
mod palette;
mod place;
mod render;
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

pub use campbell::{campbell_png, campbell_svg};
pub use check::{check_png, check_svg};
pub use cut::{cut_png, cut_svg};
pub use cut_map::{cut_map_png, cut_map_svg};
pub use fit::{fit_png, fit_svg};
pub use membrane::{membrane_png, membrane_svg};
pub use palette::{PALETTE, Palette, Rgb};
pub use place::{place_png, place_svg};
pub use response_map::{response_map_png, response_map_svg};
pub use root_loci::{root_loci_png, root_loci_svg};
pub use runup::{runup_png, runup_svg};
pub use spline_orbit::{spline_orbit_png, spline_orbit_svg};
pub use study::{study_png, study_svg};
pub use tradeoff::tradeoff_png;

use crate::report::Report;

impl Report {
    /// The Campbell diagram as SVG, see [`campbell_svg`].
    ///
    /// # Errors
    /// [`FigureError`].
    pub fn campbell_svg(&self) -> Result<String, FigureError> {
        campbell_svg(self)
    }

    /// The Campbell diagram as PNG, see [`campbell_png`].
    ///
    /// # Errors
    /// [`FigureError`].
    pub fn campbell_png(&self) -> Result<Vec<u8>, FigureError> {
        campbell_png(self)
    }
}

/// Whether any term of the equation of motion takes energy out of the saw.
fn is_damped(report: &Report) -> bool {
    report.terms.iter().any(|term| term.contains("damping"))
}

/// Why a figure could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// A font that comes with the program did not load.
    #[error("the built-in font {0} cannot be read")]
    Font(&'static str),
    /// The drawing library refused a mark.
    #[error("a figure cannot be drawn")]
    Draw(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// The finished picture could not be packed as PNG.
    #[error("a figure cannot be packed as PNG")]
    Png(#[from] png::EncodingError),
}
