//! Tasks of the page besides the diagram: each is a command of the program, with its report, summary and
//! figures.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::fields::Units;
use super::meter::Meter;
use super::refusal::Refusal;
use super::tolerances::{Tolerance, study as study_of};
use crate::analyses::commands::{Call, CommandReport, Ran};
use crate::analyses::door::{Argument, CommandError, Step};
use crate::analyses::map::{self, Range};
use crate::analyses::scene_number;
use crate::analyses::study::{Saw, Study};
use crate::model::scene::{Freed, Quantity, RefusedValue, Scene, SceneError, SceneFile};
use crate::page::figure::ChartData;
use crate::page::outline::Outline;

/// A command of the program: `study` with tolerances, `map` within the usual bounds of one or two numbers, and those of one saw.
#[derive(Clone, Copy)]
pub enum Task {
    /// A command of one saw.
    One(&'static Call),
    /// A study.
    Study,
    /// A map.
    Map,
}

/// A request for a task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    scene: Value,
    /// For a command of one saw: texts of its arguments by their names; an empty one is left out.
    #[serde(default)]
    options: Map<String, Value>,
    /// For a study: the tolerances.
    #[serde(default)]
    tolerances: Vec<Tolerance>,
    /// For a map: paths of the numbers along its axes. Without the second, that axis is the speed.
    #[serde(default)]
    axes: Vec<String>,
    /// Units in which the texts were typed.
    #[serde(skip)]
    units: Units,
}

#[derive(Serialize)]
struct Answer<'a> {
    /// Summary as printed by the program.
    summary: String,
    /// The summary in its parts.
    outline: Outline,
    report: Value,
    /// Figures by file name, as SVG to save and as data to draw; null if the figure is no chart.
    figures: Vec<(&'static str, String, Option<ChartData>)>,
    /// The resulting scene of a fit or a placement.
    scene: Option<&'a SceneFile>,
}

impl Task {
    /// Returns the task with the name of its command.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "study" => Some(Task::Study),
            "map" => Some(Task::Map),
            _ => Call::named(name).map(Task::One),
        }
    }

    /// Runs a request; returns JSON.
    ///
    /// # Errors
    /// [`Refusal`] if the scene is refused or the computation fails or is cancelled.
    pub fn run(self, asked: &str, units: Units, meter: &Meter<'_>) -> Result<String, Refusal> {
        let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let asked = Asked { units, ..asked };
        let scene = Scene::from_json(&asked.scene.to_string())?;
        match self {
            Task::One(call) => one(call, scene, &asked.options, meter),
            Task::Study => study(scene, &asked, meter),
            Task::Map => map(scene, &asked, meter),
        }
    }
}

fn one(
    call: &Call,
    scene: Scene,
    texts: &Map<String, Value>,
    meter: &Meter<'_>,
) -> Result<String, Refusal> {
    let progress = |step: Step| meter.show_with_best(step.what, step.done, step.of, step.best_rpm);
    let Ran {
        report,
        json,
        scene,
        ..
    } = call
        .run(scene, read(&call.arguments, texts)?, &progress)
        .map_err(|error| in_words(&call.arguments, error))?;
    answer(&*report, json, scene.as_ref())
}

/// A refusal that says what an argument means in place of its name, or of the path of the number that it sets.
fn in_words(arguments: &[Argument], error: CommandError) -> Refusal {
    let refused = match error {
        CommandError::Refused(refused) if !refused.is_missing() => refused,
        CommandError::Set {
            source: SceneError::Value(refused),
            ..
        } => refused,
        other => return other.into(),
    };
    let is_own = |of: &&Argument| of.name == refused.key || of.sets == refused.key;
    match arguments.iter().find(is_own) {
        Some(argument) => {
            let key = argument.about.clone();
            Refusal::of(&RefusedValue { key, ..refused })
        }
        None => refused.into(),
    }
}

/// The values of texts of arguments by their names.
fn read(arguments: &[Argument], texts: &Map<String, Value>) -> Result<Map<String, Value>, Refusal> {
    let mut given = Map::new();
    for argument in arguments {
        let text = texts.get(&argument.name).and_then(Value::as_str);
        if let Some(text) = text.filter(|text| !text.trim().is_empty()) {
            let value = argument.read(text).map_err(|said| {
                Refusal::with_message(format!("{}: {said} (you gave {text:?})", argument.about))
            })?;
            given.insert(argument.name.clone(), value);
        }
    }
    Ok(given)
}

fn answer(
    report: &dyn CommandReport,
    json: Value,
    scene: Option<&SceneFile>,
) -> Result<String, Refusal> {
    let figures = report
        .figures()
        .into_iter()
        .map(|figure| {
            let [_, name] = figure.names();
            let svg = figure.svg().map_err(|error| Refusal::of(&error))?;
            Ok((name, svg, report.chart(name.trim_end_matches(".svg"))))
        })
        .collect::<Result<_, Refusal>>()?;
    let mut outline = report.outline();
    let summary = outline.in_columns(false);
    outline.rename_facts(|path| Quantity::of(path).map(|_| scene_number::name(path)));
    let answer = Answer {
        summary,
        outline,
        report: json,
        figures,
        scene,
    };
    serde_json::to_string(&answer).map_err(|error| Refusal::of(&error))
}

/// The answer of a report that is not of one saw.
fn answered<R: CommandReport + Serialize>(report: &R) -> Result<String, Refusal> {
    let json = serde_json::to_value(report).map_err(|error| Refusal::of(&error))?;
    answer(report, json, None)
}

fn study(scene: Scene, asked: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let file = study_of(scene.file(), &asked.tolerances, asked.units)?;
    let study = Study::new(scene, file).map_err(|error| Refusal::of(&error))?;
    let so_far = |saws: &[Saw]| {
        let so_far = study.report(saws).ok()?;
        so_far.figures().into_iter().next()
    };
    let saws = study.saws(&|saws| {
        meter.show("saws", saws.len(), study.count());
        meter.draw(|| so_far(saws));
    });
    let report = study.report(&saws).map_err(|error| Refusal::of(&error))?;
    answered(&report)
}

const NO_AXIS: &str = "A map needs one or two numbers of the scene";

fn map(scene: Scene, asked: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let mut axes = asked
        .axes
        .iter()
        .map(|path| {
            let freed = Freed::with_usual_bounds(&scene, path)?;
            Ok(Range {
                path: path.clone(),
                from: freed.from,
                to: freed.to,
            })
        })
        .collect::<Result<Vec<Range>, SceneError>>()?
        .into_iter();
    let (Some(x), y, None) = (axes.next(), axes.next(), axes.next()) else {
        return Err(Refusal::with_message(NO_AXIS));
    };
    let options = map::Options {
        y,
        ..map::Options::over(x)
    };
    let progress = |done, of| meter.show("saws", done, of);
    let report = map::map(scene, &options, &progress).map_err(|error| Refusal::of(&error))?;
    answered(&report)
}
