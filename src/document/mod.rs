//! A report as one page of HTML: verdict, warnings, tables, figures, inputs, certificate, version.
//!
//! The page is self-contained: it includes styles, figures and the scene, and can be printed. Its contents are
//! those of the summary, the figures and the JSON of the report.

mod inputs;
mod layout;
mod of_report;

pub use layout::page;

use crate::figure::Figures;
use crate::report::{
    CheckReport, CompareReport, CutReport, DeflectReport, FitReport, GapReport, MapReport,
    PlaceReport, Report, ResponseReport, RunUpReport, WashboardReport,
};
use crate::scene::SceneFile;

/// Content of the page of a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Document<'a> {
    /// Command that computes the report, like `analyze`.
    pub command: &'static str,
    /// Version of sawflutter that computed the report.
    pub version: &'a str,
    /// Scene of the report; of a comparison, the first scene.
    pub scene: &'a SceneFile,
    /// Lines of the answer; empty for reports whose page begins with the summary.
    pub answer: Vec<String>,
    /// Unusual numbers of the scene, and remarks on the validity of the result, one sentence each.
    pub warnings: Vec<String>,
    /// Tables of results, in the order of the page.
    pub tables: Vec<Table>,
    /// Sentences on the checks of the result and its accuracy.
    pub certificate: Vec<String>,
    /// The summary that the program prints.
    pub summary: String,
}

/// A table with a title.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Title above the table; empty if there is none.
    pub title: String,
    /// Headings of the columns, with units.
    pub columns: Vec<&'static str>,
    /// Cells of each row; the last may be missing.
    pub rows: Vec<Vec<String>>,
}

/// A report that has a page.
pub trait Documented: Figures {
    /// Returns the content of the page.
    fn document(&self) -> Document<'_>;
}

/// Document of a report without answer, tables and certificate of its own.
macro_rules! document {
    ($report:ident, $command:literal, $warnings:expr) => {
        Document {
            command: $command,
            version: &$report.sawflutter,
            scene: &$report.scene,
            answer: Vec::new(),
            warnings: $warnings,
            tables: Vec::new(),
            certificate: Vec::new(),
            summary: $report.summary(),
        }
    };
    ($report:ident, $command:literal) => {{
        let warnings = $report.unusual_numbers.iter().chain(&$report.warnings);
        document!($report, $command, warnings.cloned().collect())
    }};
}

macro_rules! documented {
    ($($report:ty: $command:literal,)*) => {$(
        impl Documented for $report {
            fn document(&self) -> Document<'_> {
                document!(self, $command)
            }
        }
    )*};
}

documented! {
    CheckReport: "check",
    CutReport: "cut",
    DeflectReport: "deflect",
    GapReport: "gap",
    FitReport: "fit",
    MapReport: "map",
    PlaceReport: "place",
    ResponseReport: "response",
    RunUpReport: "runup",
    WashboardReport: "washboard",
}

impl Documented for CompareReport {
    fn document(&self) -> Document<'_> {
        let of_saws = self.saws.iter().flat_map(|saw| {
            let warnings = saw.warnings.iter();
            warnings.map(|warning| format!("{}: {warning}", saw.label))
        });
        document!(self, "compare", of_saws.collect())
    }
}

impl Documented for Report {
    fn document(&self) -> Document<'_> {
        Document {
            answer: of_report::answer_lines(self),
            tables: of_report::tables(self),
            certificate: of_report::certificate(self),
            ..document!(self, "analyze")
        }
    }
}
