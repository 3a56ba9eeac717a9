//! Report as one page of HTML: verdict, warnings, tables, figures, inputs, certificate, version.
//!
//! The page is self-contained: it includes styles, figures and the scene. A browser prints it as PDF. It
//! repeats the contents of the summary, the figures and the JSON.

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
    /// Command that computes the report.
    pub command: &'static str,
    /// Version of the program that wrote the report.
    pub version: &'a str,
    /// The scene.
    pub scene: &'a SceneFile,
    /// The answer by lines; empty if the summary contains it.
    pub answer: Vec<String>,
    /// Implausible numbers of the scene, and remarks on the validity of the result.
    pub warnings: Vec<String>,
    /// Tables of the page.
    pub tables: Vec<Table>,
    /// Checks of the result.
    pub certificate: Vec<String>,
    /// The report as text, as printed by the program.
    pub summary: String,
}

/// A table with a title.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Title of the table.
    pub title: String,
    /// Names of its columns, with units.
    pub columns: Vec<&'static str>,
    /// Rows of the table.
    pub rows: Vec<Vec<String>>,
}

/// A report that has a page.
pub trait Documented: Figures {
    /// Content of the page.
    fn document(&self) -> Document<'_>;
}

macro_rules! documented {
    ($($report:ty: $command:literal,)*) => {$(
        impl Documented for $report {
            fn document(&self) -> Document<'_> {
                let warnings = self.unusual_numbers.iter().chain(&self.warnings);
                Document {
                    command: $command,
                    version: &self.sawflutter,
                    scene: &self.scene,
                    answer: Vec::new(),
                    warnings: warnings.cloned().collect(),
                    tables: Vec::new(),
                    certificate: Vec::new(),
                    summary: self.summary(),
                }
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
        Document {
            command: "compare",
            version: &self.sawflutter,
            scene: &self.scene,
            answer: Vec::new(),
            warnings: of_saws.collect(),
            tables: Vec::new(),
            certificate: Vec::new(),
            summary: self.summary(),
        }
    }
}

impl Documented for Report {
    fn document(&self) -> Document<'_> {
        let warnings = self.unusual_numbers.iter().chain(&self.warnings);
        Document {
            command: "analyze",
            version: &self.sawflutter,
            scene: &self.scene,
            answer: of_report::answer_lines(self),
            warnings: warnings.cloned().collect(),
            tables: of_report::tables(self),
            certificate: of_report::certificate(self),
            summary: self.summary(),
        }
    }
}
