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
    let pairs = names.iter().zip(sheets);
    pairs
        .filter_map(|(names, sheet)| {
            Some(Figure {
                names: *names,
                sheet: sheet?,
            })
        })
        .collect()
}

impl Figures for Report {
    const NAMES: &'static [[&'static str; 2]] = &[
        ["campbell.png", "campbell.svg"],
        ["root-loci.png", "root-loci.svg"],
        ["membrane.png", "membrane.svg"],
        ["in-cut.png", "in-cut.svg"],
        ["modes.png", "modes.svg"],
    ];

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

impl Figures for CutReport {
    const NAMES: &'static [[&'static str; 2]] = &[
        ["cut.png", "cut.svg"],
        ["cut-map.png", "cut-map.svg"],
        ["spline-orbit.png", "spline-orbit.svg"],
    ];

    fn figures(&self) -> Vec<Figure> {
        let always = [cut::sheet(self), cut_map::sheet(self)].map(Some);
        let [cut, map] = always;
        named(Self::NAMES, [cut, map, spline_orbit::sheet(self)])
    }
}

impl Figures for RunUpReport {
    const NAMES: &'static [[&'static str; 2]] = &[
        ["runup.png", "runup.svg"],
        ["response-map.png", "response-map.svg"],
        ["runup-map.png", "runup-map.svg"],
    ];

    fn figures(&self) -> Vec<Figure> {
        let [runup, response] = [runup::sheet(self), response_map::sheet(self)].map(Some);
        let stretched = response_map::stretched_sheet(self);
        named(Self::NAMES, [runup, response, stretched])
    }
}

impl Figures for GapReport {
    const NAMES: &'static [[&'static str; 2]] = &[
        ["gap.png", "gap.svg"],
        ["gap-map.png", "gap-map.svg"],
        ["gap-oscillation.png", "gap-oscillation.svg"],
        ["gap-friction.png", "gap-friction.svg"],
    ];

    fn figures(&self) -> Vec<Figure> {
        let sheets = [
            Some(gap::sheet(self)),
            gap_map::sheet(self),
            gap_oscillation::sheet(self),
            gap_friction::sheet(self),
        ];
        named(Self::NAMES, sheets)
    }
}

impl Figures for ResponseReport {
    const NAMES: &'static [[&'static str; 2]] = &[
        ["response.png", "response.svg"],
        ["frequency-response.png", "frequency-response.svg"],
    ];

    fn figures(&self) -> Vec<Figure> {
        let sheets = [Some(response::sheet(self)), response::points_sheet(self)];
        named(Self::NAMES, sheets)
    }
}

/// Implements [`Figures`] for a report with a single figure, drawn by a function, and described by another.
macro_rules! single {
    ($($report:ty: $name:literal, $sheet:path $(, $chart:path)?;)*) => {$(
        impl Figures for $report {
            const NAMES: &'static [[&'static str; 2]] =
                &[[concat!($name, ".png"), concat!($name, ".svg")]];

            fn figures(&self) -> Vec<Figure> {
                named(Self::NAMES, [$sheet(self).into()])
            }

            $(fn chart(&self, name: &str) -> Option<ChartData> {
                (name == $name).then(|| $chart(self))
            })?
        }
    )*};
}

single! {
    DeflectReport: "deflect", deflect::sheet, deflect::chart;
    WashboardReport: "washboard", washboard::sheet, washboard::chart;
    CheckReport: "check", check::sheet;
    CompareReport: "compare", compare::sheet, compare::chart;
    FitReport: "fit", fit::sheet;
    MapReport: "map", map::sheet;
    PlaceReport: "place", place::sheet;
    StudyReport: "study", study::sheet;
}

/// Draws the run time of settings over their true error, both on logarithmic scales, as measured by
/// [`tradeoff`](crate::stability::tradeoff); `scene` is the name of the scene.
pub fn tradeoff(scene: &str, settings: &[Setting]) -> Figure {
    Figure {
        names: ["tradeoff.png", "tradeoff.svg"],
        sheet: super::tradeoff::sheet(scene, settings),
    }
}
