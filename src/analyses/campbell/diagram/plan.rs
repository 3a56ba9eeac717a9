//! Sizes of the figure, its contents, axes and frames.

use crate::analyses::campbell::Report;
use crate::page::figure::axis::Axis;
use crate::page::figure::canvas::Frame;
use crate::page::figure::chart_data::{ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Role, Upright};
use crate::page::figure::painting::Ground;

pub const WIDTH: u32 = 1200;
pub const HEIGHT: u32 = 918;
pub const PLOT_LEFT: f64 = 92.0;
pub const PLOT_TOP: f64 = 122.0;
pub const PLOT_BOTTOM: f64 = 788.0;
pub const BETWEEN_PANELS: f64 = 16.0;
pub const GROWTH_HEIGHT: f64 = 236.0;
/// Height of the lower panel if nothing grows.
pub const EMPTY_GROWTH_HEIGHT: f64 = 48.0;

/// Distances of the baselines of the lines below the panels from the lower edge of the sheet.
pub const LEGEND_ABOVE_FOOT: f64 = 70.0;
pub const NOTES_ABOVE_FOOT: f64 = 51.0;
pub const CERTIFICATE_ABOVE_FOOT: f64 = 32.0;
pub const FACTS_ABOVE_FOOT: f64 = 14.0;

/// Growth rates up to this value, in 1/s, are drawn as zero: they are rounding errors of the eigenvalues.
pub const NEGLIGIBLE_PER_S: f64 = 1e-3;

/// Contents, axes and frames of the figure.
pub struct Chart<'a> {
    pub report: &'a Report,
    pub data: ChartData,
    pub speed: Axis,
    pub frequency: Axis,
    /// Panel of the frequencies.
    pub upper: Frame,
    /// Panel of the growth rates.
    pub lower: Frame,
}

impl Chart<'_> {
    /// Contents of the panel of the frequencies and of the panel of the growth rates.
    pub fn panels(&self) -> &[PanelData] {
        &self.data.panels
    }

    /// Contents of the panel of the frequencies.
    pub fn items(&self) -> impl Iterator<Item = &Item> + Clone {
        self.data
            .panels
            .iter()
            .take(1)
            .flat_map(|panel| &panel.items)
    }

    pub fn bands(&self) -> impl Iterator<Item = &Band> + Clone {
        self.items().filter_map(|item| match item {
            Item::Band(band) => Some(band),
            _ => None,
        })
    }

    pub fn uprights(&self, role: Role) -> impl Iterator<Item = &Upright> {
        self.items().filter_map(move |item| match item {
            Item::Upright(upright) if upright.role == role => Some(upright),
            _ => None,
        })
    }

    /// Curves of the panel of the frequencies.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.items().filter_map(|item| match item {
            Item::Line(line) => Some(line),
            _ => None,
        })
    }

    pub fn upper_ground(&self) -> Ground<'_> {
        Ground {
            x: &self.speed,
            y: &self.frequency,
            frame: &self.upper,
        }
    }
}
