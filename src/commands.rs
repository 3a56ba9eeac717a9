//! The commands with a report: one list of their names, files, figures, charts and summaries.
//!
//! The program, its help, the live page, the Python package and the tests of the documentation read [`COMMANDS`]. All
//! faces of a report are methods of [`CommandReport`].

#[cfg(test)]
mod golden_tests;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

use crate::analyses::check::CheckReport;
use crate::analyses::compare::CompareReport;
use crate::analyses::cut::CutReport;
use crate::analyses::deflect::DeflectReport;
use crate::analyses::fit::FitReport;
use crate::analyses::gap::GapReport;
use crate::analyses::map::MapReport;
use crate::analyses::place::PlaceReport;
use crate::analyses::response::ResponseReport;
use crate::analyses::runup::RunUpReport;
use crate::analyses::study::StudyReport;
use crate::analyses::tradeoff::Setting;
use crate::analyses::washboard::WashboardReport;
use crate::document::{self, Document};
use crate::figure::{
    CampbellView, ChartData, Drawing, Figure, FigureError, campbell, check, compare, cut, cut_map,
    deflect, fit, gap, gap_friction, gap_map, gap_oscillation, in_cut, map, membrane, modes, place,
    response, response_map, root_loci, runup, spline_orbit, study, washboard,
};
use crate::report::{ModeShape, Report};
use crate::scene::SceneFile;
use crate::summary;

/// A command with a report.
#[derive(Debug, Clone, Copy)]
pub struct Command {
    /// Name on the command line, like `analyze`.
    pub name: &'static str,
    /// Name of the file of the report.
    pub file: &'static str,
    /// File names of the PNG and of the SVG of every figure that such a report may have.
    pub figures: &'static [[&'static str; 2]],
    read: fn(&str) -> serde_json::Result<Box<dyn CommandReport>>,
    schema: fn() -> Value,
}

impl Command {
    /// Returns the command with a name; `None` if it has no report.
    pub fn named(name: &str) -> Option<&'static Self> {
        COMMANDS.iter().find(|command| command.name == name)
    }

    /// Reads a report of this command.
    ///
    /// # Errors
    /// Error of serde_json if the text is no such report.
    pub fn read(&self, json: &str) -> serde_json::Result<Box<dyn CommandReport>> {
        (self.read)(json)
    }

    /// Returns the JSON schema of the report.
    pub fn schema(&self) -> Value {
        (self.schema)()
    }
}

/// A report of a command.
pub trait CommandReport {
    /// The command that computes such reports.
    fn command(&self) -> &'static Command;

    /// Version of sawflutter that computed the report.
    fn version(&self) -> &str;

    /// Scene of the report; of a comparison, the first scene.
    fn scene(&self) -> &SceneFile;

    /// Unusual numbers of the scene, and remarks on the validity of the result, one sentence each.
    fn warnings(&self) -> Vec<String>;

    /// Returns the report as text of at most 80 columns, with the answer in the first lines.
    fn summary(&self) -> String;

    /// Draws the figures for which this report has data.
    fn figures(&self) -> Vec<Figure>;

    /// Returns the contents of a figure as numbers, for other programs that draw it; `name` is its file name without
    /// extension. `None` if the figure has no such description or the report has no data for it.
    fn chart(&self, name: &str) -> Option<ChartData>;

    /// Returns the content of the page.
    fn document(&self) -> Document<'_> {
        Document::of_summary(self)
    }

    /// Returns the report as one page of HTML.
    ///
    /// # Errors
    /// [`FigureError`] if a figure cannot be drawn.
    fn page(&self) -> Result<String, FigureError> {
        document::page(&self.document(), &self.figures())
    }
}

/// The JSON schema of each report, by the command that writes it; `modes` is that of the list of modes at one
/// speed.
pub fn json_schema() -> Value {
    let reports = COMMANDS
        .iter()
        .map(|command| (command.name.to_owned(), command.schema()));
    let lists = [
        ("modes".to_owned(), schema::<Vec<ModeShape>>()),
        ("tradeoff".to_owned(), schema::<Vec<Setting>>()),
    ];
    reports.chain(lists).collect()
}

/// Returns the JSON schema of a report as written, in which keys that are always present are required.
fn schema<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::default().for_serialize();
    settings
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value()
}

/// Defines [`COMMANDS`], and implements [`CommandReport`] for the reports: name of the command, name of the file, type of
/// the report; module of its summary; names of its figures, with the functions that describe them as numbers, or draw
/// them; for those that are drawn, the functions that describe them, if any.
macro_rules! commands {
    ($($command:literal, $file:literal, $report:ident {
        summary: $summary:ident,
        figures: [$($name:literal => $sheet:expr),* $(,)?],
        $(charts: [$($described:literal => $chart:expr),*],)?
        $(warnings: $warnings:expr,)?
        $(document: $document:expr,)?
    })*) => {
        /// Every command with a report.
        pub const COMMANDS: &[Command] = &[$($report::COMMAND),*];

        $(impl $report {
            /// The command that computes such reports.
            pub const COMMAND: Command = Command {
                name: $command,
                file: $file,
                figures: &[$([concat!($name, ".png"), concat!($name, ".svg")]),*],
                read: |json| Ok(Box::new(serde_json::from_str::<Self>(json)?)),
                schema: schema::<Self>,
            };

            /// Returns the report as text of at most 80 columns, with the answer in the first lines.
            pub fn summary(&self) -> String {
                let mut text = String::new();
                // Writing to a string cannot fail.
                let _ = summary::$summary::of_report(&mut text, self);
                text
            }
        }

        impl CommandReport for $report {
            fn command(&self) -> &'static Command {
                &Self::COMMAND
            }

            fn version(&self) -> &str {
                &self.sawflutter
            }

            fn scene(&self) -> &SceneFile {
                &self.scene
            }

            fn warnings(&self) -> Vec<String> {
                commands!(@warnings self $($warnings)?)
            }

            fn summary(&self) -> String {
                self.summary()
            }

            fn figures(&self) -> Vec<Figure> {
                Figure::named(Self::COMMAND.figures, [$(Drawing::from(($sheet)(self))),*])
            }

            fn chart(&self, name: &str) -> Option<ChartData> {
                $($(if name == $described {
                    return ($chart)(self).into();
                })*)?
                match name {
                    $($name => Drawing::from(($sheet)(self)).chart(),)*
                    _ => None,
                }
            }

            $(fn document(&self) -> Document<'_> {
                ($document)(self)
            })?
        })*
    };
    (@warnings $self:ident) => {
        $self.unusual_numbers.iter().chain(&$self.warnings).cloned().collect()
    };
    (@warnings $self:ident $warnings:expr) => { ($warnings)($self) };
}

commands! {
    "analyze", "report.json", Report {
        summary: report,
        figures: [
            "campbell" => |report| campbell::sheet(report, CampbellView::default()),
            "root-loci" => root_loci::chart,
            "membrane" => membrane::chart,
            "in-cut" => in_cut::chart,
            "modes" => modes::sheet,
        ],
        charts: [
            "campbell" => |report| campbell::chart(report, true),
            "modes" => |_| None::<ChartData>
        ],
        document: document::of_report,
    }
    "check", "check.json", CheckReport {
        summary: check,
        figures: ["check" => check::chart],
    }
    "compare", "compare.json", CompareReport {
        summary: compare,
        figures: ["compare" => compare::chart],
        warnings: CompareReport::warnings_of_saws,
    }
    "cut", "cut.json", CutReport {
        summary: cut,
        figures: [
            "cut" => cut::chart,
            "cut-map" => cut_map::chart,
            "spline-orbit" => spline_orbit::chart,
        ],
    }
    "deflect", "deflect.json", DeflectReport {
        summary: deflect,
        figures: ["deflect" => deflect::chart],
    }
    "fit", "fit.json", FitReport {
        summary: fit,
        figures: ["fit" => fit::chart],
    }
    "gap", "gap.json", GapReport {
        summary: gap,
        figures: [
            "gap" => gap::chart,
            "gap-map" => gap_map::chart,
            "gap-oscillation" => gap_oscillation::chart,
            "gap-friction" => gap_friction::chart,
        ],
    }
    "map", "map.json", MapReport {
        summary: map,
        figures: ["map" => map::chart],
    }
    "place", "place.json", PlaceReport {
        summary: place,
        figures: ["place" => place::chart],
    }
    "response", "response.json", ResponseReport {
        summary: response,
        figures: [
            "response" => response::chart,
            "frequency-response" => response::points_chart,
        ],
    }
    "runup", "runup.json", RunUpReport {
        summary: runup,
        figures: [
            "runup" => runup::chart,
            "response-map" => response_map::chart,
            "runup-map" => response_map::stretched_chart,
        ],
    }
    "study", "study.json", StudyReport {
        summary: study,
        figures: ["study" => study::chart],
        warnings: |report: &StudyReport| report.unusual_numbers.clone(),
    }
    "washboard", "washboard.json", WashboardReport {
        summary: washboard,
        figures: ["washboard" => washboard::chart],
    }
}
