//! A report as one page of HTML: verdict, warnings, tables, figures, inputs, certificate, version.
//!
//! The page is self-contained: it includes styles, figures and the scene, and can be printed. Its contents are
//! those of the summary, the figures and the JSON of the report.

mod inputs;
mod layout;
mod of_report;

pub use layout::page;

use crate::commands::CommandReport;
use crate::report::Report;
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

impl<'a> Document<'a> {
    /// Content of a report without answer, tables and certificate of its own.
    pub(crate) fn of_summary<R: CommandReport + ?Sized>(report: &'a R) -> Self {
        Document {
            command: report.command().name,
            version: report.version(),
            scene: report.scene(),
            answer: Vec::new(),
            warnings: report.warnings(),
            tables: Vec::new(),
            certificate: Vec::new(),
            summary: report.summary(),
        }
    }
}

/// Content of the page of a Campbell diagram.
pub(crate) fn of_report(report: &Report) -> Document<'_> {
    Document {
        answer: of_report::answer_lines(report),
        tables: of_report::tables(report),
        certificate: of_report::certificate(report),
        ..Document::of_summary(report)
    }
}
