//! The figures of each report, and their file names.

use super::campbell::CampbellView;
use super::canvas::Sheet;
use super::chart_data::ChartData;
use super::{
    FigureError, campbell, check, compare, cut, cut_map, deflect, fit, gap, gap_friction, gap_map,
    gap_oscillation, in_cut, map, membrane, modes, place, render, response, response_map,
    root_loci, runup, spline_orbit, study, washboard,
};
use crate::report::{
    CheckReport, CompareReport, CutReport, DeflectReport, FitReport, GapReport, MapReport,
    PlaceReport, Report, ResponseReport, RunUpReport, WashboardReport,
};
use crate::stability::Setting;
use crate::study::StudyReport;

/// A figure: marks that are rendered on request, and file names.
#[derive(Debug)]
pub struct Figure {
    names: [&'static str; 2],
    sheet: Sheet,
}

impl Figure {
    /// File names of the PNG and of the SVG.
    pub fn names(&self) -> [&'static str; 2] {
        self.names
    }

    /// Renders the figure as PNG. Equal reports give equal bytes.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        render::png(&self.sheet)
    }

    /// Renders the figure as SVG. Equal reports give equal text.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn.
    pub fn svg(&self) -> Result<String, FigureError> {
        render::svg(&self.sheet)
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

/// A report that can be drawn.
pub trait Figures {
    /// File names of the PNG and the SVG of every figure that such a report may have.
    const NAMES: &'static [[&'static str; 2]];

    /// Draws the figures for which this report has data.
    fn figures(&self) -> Vec<Figure>;

    /// Returns the contents of a figure as numbers, for other programs that draw it; `name` is its file name without
    /// extension. `None` if the figure has no such description or the report has no data for it.
    fn chart(&self, _name: &str) -> Option<ChartData> {
        None
    }
}

fn named<const N: usize>(names: &[[&'static str; 2]], sheets: [Option<Sheet>; N]) -> Vec<Figure> {
    let pairs = names.iter().copied().zip(sheets);
    let drawn = pairs.filter_map(|(names, sheet)| {
        Some(Figure {
            names,
            sheet: sheet?,
        })
    });
    drawn.collect()
}

/// File names of figures.
macro_rules! files {
    ($($name:literal),*) => { &[$([concat!($name, ".png"), concat!($name, ".svg")]),*] };
}

impl Figures for Report {
    const NAMES: &'static [[&'static str; 2]] =
        files!["campbell", "root-loci", "membrane", "in-cut", "modes"];

    fn figures(&self) -> Vec<Figure> {
        self.figures_within(CampbellView::default())
    }

    fn chart(&self, name: &str) -> Option<ChartData> {
        match name {
            "campbell" => Some(campbell::chart(self, true)),
            "root-loci" => root_loci::chart(self),
            _ => None,
        }
    }
}

impl Report {
    /// Draws the figures for which this report has data, with a part of the sweep in the Campbell diagram.
    pub fn figures_within(&self, view: CampbellView) -> Vec<Figure> {
        let sheets = [
            Some(campbell::sheet(self, view)),
            root_loci::sheet(self),
            membrane::sheet(self),
            in_cut::sheet(self),
            modes::sheet(self),
        ];
        named(Self::NAMES, sheets)
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
        render::svg(&campbell::sheet(self, CampbellView::default()))
    }

    /// Renders the Campbell diagram as PNG of 1200 × 918 pixels.
    ///
    /// # Errors
    /// [`FigureError`] if the figure cannot be drawn or encoded.
    pub fn campbell_png(&self) -> Result<Vec<u8>, FigureError> {
        render::png(&campbell::sheet(self, CampbellView::default()))
    }
}

/// Implements [`Figures`] for reports: the name of each figure and the function that draws it, and for some reports
/// a function that describes the first figure as numbers.
macro_rules! drawn {
    ($($report:ty: $($name:literal $sheet:path),* $(; $described:literal $chart:path)?;)*) => {$(
        impl Figures for $report {
            const NAMES: &'static [[&'static str; 2]] = files![$($name),*];

            fn figures(&self) -> Vec<Figure> {
                named(Self::NAMES, [$($sheet(self).into()),*])
            }

            $(fn chart(&self, name: &str) -> Option<ChartData> {
                (name == $described).then(|| $chart(self))
            })?
        }
    )*};
}

drawn! {
    CheckReport: "check" check::sheet;
    CompareReport: "compare" compare::sheet; "compare" compare::chart;
    CutReport: "cut" cut::sheet, "cut-map" cut_map::sheet, "spline-orbit" spline_orbit::sheet;
    DeflectReport: "deflect" deflect::sheet; "deflect" deflect::chart;
    FitReport: "fit" fit::sheet;
    GapReport: "gap" gap::sheet, "gap-map" gap_map::sheet,
        "gap-oscillation" gap_oscillation::sheet, "gap-friction" gap_friction::sheet;
    MapReport: "map" map::sheet;
    PlaceReport: "place" place::sheet;
    ResponseReport: "response" response::sheet, "frequency-response" response::points_sheet;
    RunUpReport: "runup" runup::sheet, "response-map" response_map::sheet,
        "runup-map" response_map::stretched_sheet;
    StudyReport: "study" study::sheet;
    WashboardReport: "washboard" washboard::sheet; "washboard" washboard::chart;
}

/// Draws the run time of settings over their true error, both on logarithmic scales, as measured by
/// [`tradeoff`](crate::stability::tradeoff); `scene` is the name of the scene.
pub fn tradeoff(scene: &str, settings: &[Setting]) -> Figure {
    let [names] = *files!["tradeoff"];
    Figure {
        names,
        sheet: super::tradeoff::sheet(scene, settings),
    }
}
