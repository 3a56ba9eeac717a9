//! Figures of a report, and its Campbell diagram alone.

use super::Report;
use super::diagram::{self, CampbellView};
use crate::analyses::commands::CommandReport;
#[cfg(feature = "page")]
use crate::page::figure::ChartData;
use crate::page::figure::{Figure, FigureError};

impl Report {
    /// Draws the figures for which this report has data, with a part of the sweep in the Campbell diagram.
    pub fn figures_within(&self, view: CampbellView) -> Vec<Figure> {
        let mut figures = self.figures();
        if let Some(diagram) = figures.first_mut() {
            *diagram = self.campbell_figure(view);
        }
        figures
    }

    /// Returns the Campbell diagram as numbers, without descriptions of its points.
    #[cfg(feature = "page")]
    pub(crate) fn campbell_chart(&self) -> ChartData {
        diagram::chart(self, false)
    }

    /// Renders the Campbell diagram as SVG.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn.
    pub fn campbell_svg(&self) -> Result<String, FigureError> {
        self.campbell_figure(CampbellView::default()).svg()
    }

    /// Renders the Campbell diagram as PNG of 1200 × 918 pixels.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn campbell_png(&self) -> Result<Vec<u8>, FigureError> {
        self.campbell_figure(CampbellView::default()).png()
    }

    fn campbell_figure(&self, view: CampbellView) -> Figure {
        Figure::new(["campbell.png", "campbell.svg"], diagram::sheet(self, view))
    }
}
