//! The commands with a report: one list of their names, files, figures, charts and summaries.
//!
//! The program, its help, the live page, the Python package and the tests of the documentation read [`COMMANDS`]. All
//! faces of a report are methods of [`CommandReport`].

mod call;
#[cfg(test)]
mod golden_tests;
mod list_lengths;

pub use call::{Call, Ran};

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::de::{DeserializeOwned, Error};
use serde_json::Value;

use super::campbell::{self, CampbellView, ModeShape, Report};
use super::check::{self, CheckReport};
use super::compare::{self, CompareReport};
use super::cut::{self, CutReport};
use super::deflect::{self, DeflectReport};
use super::document::Document;
use super::fit::{self, FitReport};
use super::gap::{self, GapReport};
use super::map::{self, MapReport};
use super::place::{self, PlaceReport};
use super::report::{self, DesignReport};
use super::response::{self, ResponseReport};
use super::runup::{self, RunUpReport};
use super::size::{self, SizeReport};
use super::study::{self, StudyReport};
use super::tradeoff::Setting;
use super::washboard::{self, WashboardReport};
use crate::model::scene::SceneFile;
use crate::page::figure::{ChartData, Drawing, Figure, FigureError};
use crate::page::outline::Outline;

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

    /// Returns the text as an outline.
    fn outline(&self) -> Outline;

    /// Returns the report as text of at most 80 columns, with the answer in the first lines; `with_details` adds
    /// certificates, backward errors and the basis.
    fn text(&self, with_details: bool) -> String {
        self.outline().in_columns(with_details)
    }

    /// Returns the answer in one line.
    fn answer(&self) -> String {
        self.outline().answer()
    }

    /// Returns the text as a part of a page of HTML, with its details.
    fn html(&self) -> String {
        self.outline().in_html()
    }

    /// Draws the figures for which this report has data.
    fn figures(&self) -> Vec<Figure>;

    /// Whether a designer does not need a figure of this report: the program draws it only with --details. `name` is its
    /// file name without extension.
    fn is_detail(&self, _name: &str) -> bool {
        false
    }

    /// Returns the contents of a figure as numbers, for other programs that draw it; `name` is its file name without
    /// extension. `None` if the figure has no such description or the report has no data for it.
    fn chart(&self, name: &str) -> Option<ChartData>;

    /// Returns the report as one page of HTML.
    ///
    /// # Errors
    /// [`FigureError`] if a figure cannot be drawn.
    fn page(&self) -> Result<String, FigureError> {
        let document = Document {
            command: self.command().name,
            version: self.version(),
            scene: self.scene(),
            outline: self.outline(),
            figures: self.figures(),
        };
        document.page()
    }
}

/// Reads a report whose lists have the lengths that belong together.
///
/// # Errors
/// Error of serde_json if the text is no such report.
pub(crate) fn read<T: DeserializeOwned>(json: &str) -> serde_json::Result<T> {
    let report = serde_json::from_str(json)?;
    list_lengths::check(&serde_json::from_str(json)?).map_err(serde_json::Error::custom)?;
    Ok(report)
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
/// the report; its module, with its outline; names of its figures, with the functions that describe them as numbers, or draw
/// them; for those that are drawn, the functions that describe them, if any; which figures are details.
macro_rules! commands {
    ($($command:literal, $file:literal, $report:ident {
        outline: $outline:expr,
        figures: [$($name:literal => $sheet:expr),* $(,)?],
        $(charts: [$($described:literal => $chart:expr),*],)?
        $(is_detail: $is_detail:expr,)?
    })*) => {
        /// Every command with a report.
        pub const COMMANDS: &[Command] = &[$($report::COMMAND),*];

        $(impl $report {
            /// The command that computes such reports.
            pub const COMMAND: Command = Command {
                name: $command,
                file: $file,
                figures: &[$([concat!($name, ".png"), concat!($name, ".svg")]),*],
                read: |json| Ok(Box::new(read::<Self>(json)?)),
                schema: schema::<Self>,
            };

            /// Returns the report as text of at most 80 columns, with the answer in the first lines.
            pub fn summary(&self) -> String {
                self.text(false)
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

            fn outline(&self) -> Outline {
                ($outline)(self)
            }

            fn figures(&self) -> Vec<Figure> {
                Figure::named(Self::COMMAND.figures, [$(Drawing::from(($sheet)(self))),*])
            }

            $(fn is_detail(&self, name: &str) -> bool {
                ($is_detail)(self, name)
            })?

            fn chart(&self, name: &str) -> Option<ChartData> {
                $($(if name == $described {
                    return ($chart)(self).into();
                })*)?
                match name {
                    $($name => Drawing::from(($sheet)(self)).chart(),)*
                    _ => None,
                }
            }

        })*
    };
}

commands! {
    "analyze", "report.json", Report {
        outline: campbell::outline,
        figures: [
            "campbell" => |report| campbell::diagram::sheet(report, CampbellView::default()),
            "root-loci" => campbell::root_loci::chart,
            "sensitivity" => campbell::sensitivity_chart::chart,
            "membrane" => campbell::membrane_chart::chart,
            "in-cut" => campbell::in_cut_chart::chart,
            "modes" => campbell::mode_shapes::sheet,
        ],
        charts: [
            "campbell" => |report| campbell::diagram::chart(report, true)
        ],
        is_detail: |_, name| name == "root-loci",
    }
    "check", "check.json", CheckReport {
        outline: check::outline,
        figures: ["check" => check::chart::chart],
    }
    "compare", "compare.json", CompareReport {
        outline: compare::outline,
        figures: ["compare" => compare::chart::chart],
    }
    "cut", "cut.json", CutReport {
        outline: cut::outline,
        figures: [
            "cut" => cut::chart::chart,
            "cut-map" => cut::map_chart::chart,
            "spline-orbit" => cut::orbit_chart::chart,
        ],
        is_detail: |report: &CutReport, name| name == "cut-map" && report.is_stable(),
    }
    "deflect", "deflect.json", DeflectReport {
        outline: deflect::outline,
        figures: ["deflect" => deflect::chart::chart],
    }
    "fit", "fit.json", FitReport {
        outline: fit::outline,
        figures: ["fit" => fit::chart::chart],
    }
    "gap", "gap.json", GapReport {
        outline: gap::outline,
        figures: [
            "gap" => gap::chart::chart,
            "gap-map" => gap::map_chart::chart,
            "gap-oscillation" => gap::oscillation_chart::chart,
            "gap-friction" => gap::friction_chart::chart,
        ],
    }
    "map", "map.json", MapReport {
        outline: map::outline,
        figures: ["map" => map::chart::chart],
    }
    "place", "place.json", PlaceReport {
        outline: place::outline,
        figures: ["place" => place::chart::chart],
    }
    "report", "design.json", DesignReport {
        outline: report::outline,
        figures: [
            "design-campbell" => |report: &DesignReport| campbell::diagram::sheet(&report.idling, CampbellView::default()),
            "design-in-cut" => |report: &DesignReport| report.in_cut.as_ref().and_then(campbell::in_cut_chart::chart),
            "design-response" => |report: &DesignReport| response::chart::chart(&report.response),
        ],
        charts: [
            "design-campbell" => |report: &DesignReport| campbell::diagram::chart(&report.idling, true)
        ],
    }
    "response", "response.json", ResponseReport {
        outline: response::outline,
        figures: [
            "response" => response::chart::chart,
            "frequency-response" => response::chart::points_chart,
        ],
    }
    "runup", "runup.json", RunUpReport {
        outline: runup::outline,
        figures: [
            "runup" => runup::chart::chart,
            "response-map" => runup::map_chart::chart,
            "runup-map" => runup::map_chart::stretched_chart,
        ],
    }
    "size", "size.json", SizeReport {
        outline: size::outline,
        figures: ["size" => size::chart::chart],
    }
    "study", "study.json", StudyReport {
        outline: study::outline,
        figures: ["study" => study::chart::chart],
    }
    "washboard", "washboard.json", WashboardReport {
        outline: washboard::outline,
        figures: ["washboard" => washboard::chart::chart],
    }
}
