//! Tasks of the page besides the diagram: each is a command of the program, with its report, summary and
//! figures.

use serde::{Deserialize, Serialize};

use super::fields::{Field, Units};
use super::meter::Meter;
use super::refusal::Refusal;
use super::tolerances::{Tolerance, study as study_of};
use crate::analyses::commands::CommandReport;
use crate::analyses::cut::{self, CutReport};
use crate::analyses::fit::{self, FitReport, Measurement};
use crate::analyses::gap::{self, GapError, GapReport};
use crate::analyses::map::{self, MapReport, Range};
use crate::analyses::place::{self, Demands, PlaceReport};
use crate::analyses::response::{self, ResponseError, ResponseReport};
use crate::analyses::runup::{self, RunUpReport};
use crate::analyses::scene_number;
use crate::analyses::study::{Saw, Study, StudyReport};
use crate::analyses::washboard::{self, WashboardError, WashboardReport};
use crate::model::scene::{Freed, Quantity, Scene, SceneError, SceneFile};
use crate::motion::transient::TransientError;
use crate::page::figure::ChartData;
use crate::page::outline::Outline;

/// Computes the answer to a request as JSON.
type Work = fn(Scene, &Asked, &Meter<'_>) -> Result<String, Refusal>;

/// The commands of the program that are tasks.
const TASKS: [(&str, Work); 9] = [
    (CutReport::COMMAND.name, cut),
    (RunUpReport::COMMAND.name, runup),
    (WashboardReport::COMMAND.name, washboard),
    (FitReport::COMMAND.name, fit),
    (PlaceReport::COMMAND.name, place),
    (StudyReport::COMMAND.name, study),
    (ResponseReport::COMMAND.name, response),
    (MapReport::COMMAND.name, map),
    (GapReport::COMMAND.name, gap),
];

/// A command of the program: `fit` to the scene's own measured frequencies, `study` with tolerances, `map` within the
/// usual bounds of one or two numbers, and others as on the command line.
#[derive(Clone, Copy)]
pub struct Task(Work);

/// A request for a task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    scene: serde_json::Value,
    /// For a placement: maximize the window without instability instead of the flutter speed.
    #[serde(default)]
    window: bool,
    /// For a placement: lower limit of the first critical speed, as typed; empty for none.
    #[serde(default)]
    min_critical: String,
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
struct Answer<'a, R> {
    /// Summary as printed by the program.
    summary: String,
    /// The summary in its parts.
    outline: Outline,
    report: &'a R,
    /// Figures by file name, as SVG to save and as data to draw; null if the figure is no chart.
    figures: Vec<(&'static str, String, Option<ChartData>)>,
    /// The resulting scene of a fit or a placement.
    scene: Option<&'a SceneFile>,
}

impl Task {
    /// Returns the task with the name of its command.
    pub fn named(name: &str) -> Option<Self> {
        let own = TASKS.iter().find(|(command, _)| *command == name);
        own.map(|(_, work)| Task(*work))
    }

    /// Runs a request; returns JSON.
    ///
    /// # Errors
    /// [`Refusal`] if the scene is refused or the computation fails or is cancelled.
    pub fn run(self, asked: &str, units: Units, meter: &Meter<'_>) -> Result<String, Refusal> {
        let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let asked = Asked { units, ..asked };
        let scene = Scene::from_json(&asked.scene.to_string())?;
        (self.0)(scene, &asked, meter)
    }
}

fn answer<R: CommandReport + Serialize>(
    report: &R,
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
        report,
        figures,
        scene,
    };
    serde_json::to_string(&answer).map_err(|error| Refusal::of(&error))
}

fn refused(error: TransientError) -> Refusal {
    Refusal::of(&error)
}

fn cut(scene: Scene, _: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let runs = scene.needed_cut()?.runs_at(&[])?;
    let progress = |done, of| meter.show("points of the map", done, of);
    let report = cut::cut(&scene, &runs, &progress).map_err(refused)?;
    answer(&report, None)
}

fn runup(scene: Scene, _: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    scene.needed_runup()?;
    let progress = |done, of| meter.show("steps", done, of);
    let report = runup::runup(&scene, &progress).map_err(refused)?;
    answer(&report, None)
}

fn washboard(scene: Scene, _: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let cut = scene.needed_washboarding()?;
    let run = cut.at_rpm(scene.needed_operating_rpm(None)?)?;
    let progress = |done, of| meter.show("speeds", done, of);
    let report = washboard::washboard(&scene, &run, &progress)
        .map_err(|error: WashboardError| Refusal::of(&error))?;
    answer(&report, None)
}

fn fit(scene: Scene, _: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let measurement = Measurement::of_scene(scene.needed_measured()?);
    let options = fit::Options::default().checked(&measurement)?;
    let freed = Freed::to_fit(&scene, &[])?;
    let progress = |done, of| meter.show("starts", done, of);
    let report = fit::fit(&scene, &measurement, &freed, &options, &progress)
        .map_err(|error| Refusal::of(&error))?;
    answer(&report, Some(&report.scene))
}

const NO_LIMIT: &str = "The lower limit of the first critical speed must be above 0 rpm";

fn place(scene: Scene, asked: &Asked, meter: &Meter<'_>) -> Result<String, Refusal> {
    let around_rpm = if asked.window {
        Some(scene.needed_operating_rpm(None)?)
    } else {
        None
    };
    let limit = match asked.min_critical.trim() {
        "" => None,
        text => Some(Field::read("operating_rpm", text, asked.units)?),
    };
    let demands = Demands::new(around_rpm, limit).map_err(|_| Refusal::with_message(NO_LIMIT))?;
    let freed = Freed::to_place(&scene, &[])?;
    let progress = |step: place::Step| {
        meter.show_with_best(step.what, step.done, step.of, step.best_rpm);
    };
    let options = place::Options::default();
    let report = place::place(&scene, &freed, &demands, &options, &progress)
        .map_err(|error| Refusal::of(&error))?;
    answer(&report, Some(&report.scene))
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
    answer(&report, None)
}

fn response(scene: Scene, _: &Asked, _: &Meter<'_>) -> Result<String, Refusal> {
    let report =
        response::response(&scene, &response::Options::default()).map_err(|error| match error {
            ResponseError::Refused(refused) => refused.into(),
            other => Refusal::of(&other),
        })?;
    answer(&report, None)
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
    answer(&report, None)
}

fn gap(scene: Scene, _: &Asked, _: &Meter<'_>) -> Result<String, Refusal> {
    let found = gap::gap(&scene, &gap::Options::default());
    let report = found.map_err(|error| match error {
        GapError::Refused(refused) => refused.into(),
        other => Refusal::of(&other),
    })?;
    answer(&report, None)
}
