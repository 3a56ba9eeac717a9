//! Answers to the requests of the page, for a server or a worker of the browser.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::charts::{Charts, Fidelity};
use super::fields::{Field, Units};
use super::meter::{Clock, Meter};
use super::refusal::Refusal;
#[cfg(feature = "explore")]
use super::reply::FileNote;
use super::reply::{SavedFile, Start};
use super::task::Task;
use super::{mode, parts};
use crate::analyses::fit::{Measurement, TABLE_FILE};
use crate::model::scene::Scene;
use crate::modes::Stage;
use crate::page::text::read_stream;

/// A request of the page.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// Kind of the request: `start`, `chart/draft`, `chart/scene`, `critical`, `mode`, `influence`, `save/NAME`,
    /// `task/NAME`, `read`, `measured`, `part` or `numbers`.
    pub path: String,
    /// Name of the page, under which its diagrams are kept.
    #[serde(default)]
    pub page: String,
    /// Identifier of the diagram that the page shows, if any.
    #[serde(default)]
    pub chart: String,
    /// Units of the form, for messages.
    #[serde(default)]
    pub units: Units,
    /// Content of the request, which depends on its kind: text, or JSON.
    #[serde(default)]
    pub body: String,
}

impl Question {
    /// Whether the request names a diagram or a task, whose answer is sent line by line.
    #[cfg(feature = "explore")]
    pub(super) fn is_answered_in_lines(&self) -> bool {
        match self.path.split_once('/') {
            Some(("chart", name)) => Fidelity::named(name).is_some(),
            Some(("task", name)) => Task::named(name).is_some(),
            _ => false,
        }
    }
}

/// An answer with the status and media type of HTTP.
#[derive(Debug, Clone)]
pub struct Answer {
    /// HTTP status: 200; 422 with a refusal; 400, 404 or 500 without content.
    pub status: u16,
    /// Media type of the content.
    pub media_type: &'static str,
    /// Content of the answer in this media type.
    pub content: Vec<u8>,
}

const JSON: &str = "application/json";
/// Media type of JSON line by line.
pub(super) const LINES: &str = "application/x-ndjson";
const OK: u16 = 200;
const BAD_REQUEST: u16 = 400;
const NOT_FOUND: u16 = 404;
const REFUSED: u16 = 422;
const FAILED: u16 = 500;

impl Answer {
    fn empty(status: u16) -> Self {
        Answer {
            status,
            media_type: "text/plain",
            content: Vec::new(),
        }
    }

    pub(super) fn json(value: &impl Serialize) -> Self {
        Self::with_status(OK, value)
    }

    /// An answer with a refusal.
    #[cfg(feature = "explore")]
    pub(super) fn refused(refusal: &Refusal) -> Self {
        Self::with_status(REFUSED, refusal)
    }

    fn with_status(status: u16, value: &impl Serialize) -> Self {
        match serde_json::to_vec(value) {
            Ok(content) => Answer {
                status,
                media_type: JSON,
                content,
            },
            Err(_) => Self::empty(FAILED),
        }
    }
}

/// A request for the `measured` block of a table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    name: String,
    /// The file, in any encoding of a table.
    bytes: Vec<u8>,
}

/// A request for the numbers that the texts of a field mean.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Typed {
    path: String,
    texts: Vec<String>,
}

/// Answers requests, and keeps the latest diagrams for later requests about them.
pub struct Backend {
    start: Start,
    clock: Clock,
    /// The diagrams that are kept.
    pub(super) charts: Charts,
}

impl Backend {
    /// Creates a backend whose page starts with this scene.
    pub fn new(scene: &Scene, clock: Clock) -> Self {
        Backend {
            start: Start::new(scene),
            clock,
            charts: Charts::new(clock),
        }
    }

    /// Calls `tell` with every stage of the diagrams that are being computed.
    pub fn on_stage(mut self, tell: impl Fn(Stage) + Send + Sync + 'static) -> Self {
        self.charts.under_way.on_stage(tell);
        self
    }

    /// Adds the file that the page can save to, if any, to its initial data.
    #[cfg(feature = "explore")]
    pub(super) fn with_file(mut self, note: Option<FileNote>) -> Self {
        self.start.file = note;
        self
    }

    /// Numbers diagrams from `number` instead of 1, so that no identifier of an earlier backend is used again.
    pub fn numbered_from(self, number: usize) -> Self {
        self.charts.number_from(number);
        self
    }

    /// Answers a request. `tell` receives the progress of a task and the early results of a diagram as lines of JSON.
    pub fn answer(&self, asked: &Question, tell: impl Fn(String) + Send + Sync) -> Answer {
        self.found(asked, tell).unwrap_or_else(|refusal| {
            Answer::with_status(REFUSED, &refusal.in_field(&asked.body, asked.units))
        })
    }

    fn found(
        &self,
        asked: &Question,
        tell: impl Fn(String) + Send + Sync,
    ) -> Result<Answer, Refusal> {
        let (path, body) = (&asked.path, &asked.body);
        let (what, name) = path.split_once('/').unwrap_or((path, ""));
        Ok(match what {
            "start" => Answer::json(&self.start),
            "chart" => match Fidelity::named(name) {
                Some(fidelity) => {
                    let chart = self.charts.chart(&asked.page, body, fidelity, &tell);
                    last_line(asked, chart)
                }
                None => Answer::empty(BAD_REQUEST),
            },
            "critical" => Answer::json(&self.charts.critical_speeds(&asked.page, body)?),
            "mode" => Answer::json(&mode::answer(&self.charts, body)?),
            "influence" => Answer::json(&self.charts.influence(body)?),
            "save" => match SavedFile::named(name) {
                Some(kind) => Answer {
                    status: OK,
                    media_type: kind.media_type(),
                    content: self.charts.file(
                        kind,
                        asked.chart.parse().unwrap_or_default(),
                        body,
                    )?,
                },
                None => Answer::empty(NOT_FOUND),
            },
            "read" => Answer::json(Scene::from_json(body)?.file()),
            "part" => Answer::json(&parts::with_part(body)?),
            "numbers" => Answer::json(&numbers(body, asked.units)?),
            "measured" => Answer::json(&measured(body)?),
            "task" => match Task::named(name) {
                Some(task) => {
                    let meter = Meter::new(&tell, self.clock);
                    last_line(asked, task.run(body, asked.units, &meter))
                }
                None => Answer::empty(BAD_REQUEST),
            },
            _ => Answer::empty(NOT_FOUND),
        })
    }
}

/// The result of a diagram or task, or the refusal, as the last line of an answer that is sent line by line.
fn last_line(asked: &Question, result: Result<String, Refusal>) -> Answer {
    let line = result.unwrap_or_else(|refusal| {
        let refusal = refusal.in_field(&asked.body, asked.units);
        serde_json::json!({ "refusal": refusal }).to_string()
    });
    Answer {
        status: OK,
        media_type: LINES,
        content: line.into_bytes(),
    }
}

/// Reads a table of measured frequencies as `sawflutter fit` does; returns the block of a scene.
fn measured(body: &str) -> Result<crate::model::scene::Measured, Refusal> {
    let Table { name, bytes } = serde_json::from_str(body).map_err(|error| Refusal::of(&error))?;
    let table = read_stream(&bytes[..], Path::new(&name), TABLE_FILE)
        .map_err(|error| Refusal::of(&error))?;
    let measurement = Measurement::from_csv(&name, &table).map_err(|error| Refusal::of(&error))?;
    Ok(measurement.as_scene_block())
}

/// Reads the texts of a field as the command line does.
fn numbers(body: &str, units: Units) -> Result<Vec<f64>, Refusal> {
    let Typed { path, texts } = serde_json::from_str(body).map_err(|error| Refusal::of(&error))?;
    let read = |text: &String| Field::read(&path, text, units);
    texts.iter().map(read).collect()
}
