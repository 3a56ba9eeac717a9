//! What the page asks for, answered without a server: one request, one answer.

use serde::{Deserialize, Serialize};

use super::charts::{Charts, Fidelity};
use super::fields::Units;
use super::meter::Meter;
use super::refusal::Refusal;
#[cfg(feature = "explore")]
use super::reply::FileNote;
use super::reply::{SavedFile, Start};
use super::task::Task;
use super::{ahead, mode, parts};
use crate::fit::Measurement;
use crate::scene::Scene;
use crate::spectrum::Stage;

/// Milliseconds since some beginning.
pub type Clock = fn() -> f64;

/// A request of the page.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// What is asked for: `start`, `chart/draft`, `chart/scene`, `critical`, `mode`, `influence`, `save/NAME`, `task/NAME`,
    /// `read`, `measured` or `part`.
    pub path: String,
    /// Name of the page.
    #[serde(default)]
    pub page: String,
    /// Identifier of the diagram that the page shows, if any.
    #[serde(default)]
    pub chart: String,
    /// Units of the form, for messages.
    #[serde(default)]
    pub units: Units,
    /// The content of the request.
    #[serde(default)]
    pub body: String,
}

/// An answer, by the status and media type of HTTP.
#[derive(Debug, Clone)]
pub struct Answer {
    /// 200; 422 with a refusal; 400, 404 or 500.
    pub status: u16,
    /// Media type of the content.
    pub media_type: &'static str,
    /// The content.
    pub content: Vec<u8>,
}

const JSON: &str = "application/json";
/// JSON line by line.
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

    /// A refusal.
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

/// A table of measured frequencies.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    name: String,
    table: String,
}

/// Answers requests, and keeps the diagrams that later ones are about.
pub struct Backend {
    start: Start,
    clock: Clock,
    /// The diagrams.
    pub(super) charts: Charts,
}

impl Backend {
    /// A backend whose page begins with a scene.
    pub fn new(scene: &Scene, clock: Clock) -> Self {
        Backend {
            start: Start::new(scene),
            clock,
            charts: Charts::new(clock),
        }
    }

    /// Calls a function with every stage of diagrams that are computed.
    pub fn on_stage(mut self, tell: impl Fn(Stage) + Send + Sync + 'static) -> Self {
        self.charts.under_way.on_stage(tell);
        self
    }

    /// Tells the page of a file that it can save to.
    #[cfg(feature = "explore")]
    pub(super) fn with_file(mut self, note: Option<FileNote>) -> Self {
        self.start.file = note;
        self
    }

    /// Numbers diagrams from another number than 1 on, if an earlier backend has used the others.
    pub fn numbered_from(self, number: usize) -> Self {
        self.charts.number_from(number);
        self
    }

    /// The answer to a request; `tell` is called with the progress of a task and with early results of a
    /// diagram, line by line.
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
            "critical" => Answer::json(&ahead::critical_speeds(body)?),
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
            "measured" => Answer::json(&measured(body)?),
            "task" => match Task::named(name) {
                Some(task) => {
                    let meter = Meter::new(&tell, self.clock);
                    last_line(asked, task.run(body, &meter))
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

/// A table of measured frequencies as a block of a scene, read as `sawflutter fit` does.
fn measured(body: &str) -> Result<crate::scene::Measured, Refusal> {
    let Table { name, table } = serde_json::from_str(body).map_err(|error| Refusal::of(&error))?;
    let measurement = Measurement::from_csv(&name, &table);
    let measurement = measurement.map_err(|error| Refusal::of(&error))?;
    Ok(measurement.as_scene_block())
}
