//! A figure and its file names.

use super::campbell::{self, CampbellView};
use super::canvas::Sheet;
use super::chart_data::ChartData;
use super::{FigureError, layout, raster, svg};
use crate::analyses::tradeoff::Setting;
use crate::commands::CommandReport;
use crate::report::Report;

/// A chart, which the layout draws, or a drawing of its own.
pub(crate) enum Drawing {
    /// A chart.
    Chart(ChartData),
    /// Marks.
    Sheet(Sheet),
    /// The report has no data for the figure.
    Nothing,
}

impl Drawing {
    /// The chart, if it is one.
    pub(crate) fn chart(self) -> Option<ChartData> {
        match self {
            Drawing::Chart(data) => Some(data),
            _ => None,
        }
    }
}

impl From<ChartData> for Drawing {
    fn from(data: ChartData) -> Self {
        Drawing::Chart(data)
    }
}

impl From<Sheet> for Drawing {
    fn from(sheet: Sheet) -> Self {
        Drawing::Sheet(sheet)
    }
}

impl<T: Into<Drawing>> From<Option<T>> for Drawing {
    fn from(drawing: Option<T>) -> Self {
        drawing.map_or(Drawing::Nothing, Into::into)
    }
}

/// A figure: marks that are rendered on request, and file names.
#[derive(Debug)]
pub struct Figure {
    names: [&'static str; 2],
    sheet: Sheet,
}

impl Figure {
    /// The figures that have data, with the file names of each.
    pub(crate) fn named<const N: usize>(
        names: &[[&'static str; 2]],
        drawings: [Drawing; N],
    ) -> Vec<Self> {
        let pairs = names.iter().copied().zip(drawings);
        let drawn = pairs.filter_map(|(names, drawing)| {
            let sheet = match drawing {
                Drawing::Chart(data) => layout::sheet(&data),
                Drawing::Sheet(sheet) => sheet,
                Drawing::Nothing => return None,
            };
            Some(Figure { names, sheet })
        });
        drawn.collect()
    }

    /// The marks, for tests of all figures.
    #[cfg(test)]
    pub(crate) fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// File names of the PNG and of the SVG.
    pub fn names(&self) -> [&'static str; 2] {
        self.names
    }

    /// Renders the figure as PNG. Equal reports give equal bytes.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        raster::png(&self.sheet)
    }

    /// Renders the figure as SVG. Equal reports give equal text.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn.
    pub fn svg(&self) -> Result<String, FigureError> {
        svg::svg(&self.sheet)
    }

    /// Renders the file with one of the [`names`](Self::names); `None` for another name.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn file(&self, name: &str) -> Option<Result<Vec<u8>, FigureError>> {
        match self.names.iter().position(|own| *own == name)? {
            0 => Some(self.png()),
            _ => Some(self.svg().map(String::into_bytes)),
        }
    }
}

impl Report {
    /// Draws the figures for which this report has data, with a part of the sweep in the Campbell diagram.
    pub fn figures_within(&self, view: CampbellView) -> Vec<Figure> {
        let mut figures = self.figures();
        if let Some(diagram) = figures.first_mut() {
            diagram.sheet = campbell::sheet(self, view);
        }
        figures
    }

    /// Returns the Campbell diagram as numbers, without descriptions of its points.
    #[cfg(feature = "page")]
    pub(crate) fn campbell_chart(&self) -> ChartData {
        campbell::chart(self, false)
    }

    /// Renders the Campbell diagram as SVG.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn.
    pub fn campbell_svg(&self) -> Result<String, FigureError> {
        svg::svg(&campbell::sheet(self, CampbellView::default()))
    }

    /// Renders the Campbell diagram as PNG of 1200 × 918 pixels.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn campbell_png(&self) -> Result<Vec<u8>, FigureError> {
        raster::png(&campbell::sheet(self, CampbellView::default()))
    }
}

/// Returns the run time of settings over their true error as numbers, see [`tradeoff`].
pub fn tradeoff_chart(scene: &str, settings: &[Setting]) -> ChartData {
    super::tradeoff::chart(scene, settings)
}

/// Draws the run time of settings over their true error, both on logarithmic scales, as measured by
/// [`tradeoff`](crate::analyses::tradeoff::tradeoff); `scene` is the name of the scene.
pub fn tradeoff(scene: &str, settings: &[Setting]) -> Figure {
    Figure {
        names: ["tradeoff.png", "tradeoff.svg"],
        sheet: layout::sheet(&tradeoff_chart(scene, settings)),
    }
}
