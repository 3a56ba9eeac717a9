//! A figure and its file names.

use super::canvas::Sheet;
use super::chart_data::ChartData;
use super::{FigureError, layout, raster, svg};

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
            Some(Figure::new(names, sheet))
        });
        drawn.collect()
    }

    /// Marks with the file names of their PNG and SVG.
    pub(crate) fn new(names: [&'static str; 2], sheet: Sheet) -> Self {
        Figure { names, sheet }
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
