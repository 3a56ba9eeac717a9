//! What the page can ask for besides the chart: each a command of the program, with its report, its
//! summary and its figures.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::reply::Refusal;
use crate::figure::Figures;
use crate::fit::{self, Compared, Fit, FitError, Measurement};
use crate::place::{self, Demands, Goal, PlaceError, Placement};
use crate::report::{CutReport, FitReport, PlaceReport, RunUpReport, WashboardReport};
use crate::scene::{Freed, Scene, SceneFile};
use crate::study::{self, Study, StudyFile, StudyReport};
use crate::transient::{Cutting, RunningUp, TransientError};
use crate::washboarding::{Washboard, WashboardError};

/// A command of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Task {
    /// `sawflutter cut`.
    Cut,
    /// `sawflutter runup`.
    Runup,
    /// `sawflutter washboard`.
    Washboard,
    /// `sawflutter fit`, to the scene's own measured frequencies.
    Fit,
    /// `sawflutter place`.
    Place,
    /// `sawflutter study`, of tolerances.
    Study,
}

/// What the page sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    scene: serde_json::Value,
    /// Of a placement: the widest stable window instead of the largest flutter speed.
    #[serde(default)]
    window: bool,
    /// Of a placement: the least lowest critical speed.
    #[serde(default)]
    min_critical_rpm: Option<f64>,
    /// Of a study: what varies and how, as in a file for `sawflutter study`.
    #[serde(default)]
    study: serde_json::Value,
}

/// Seen on the page before it is told again.
const PAUSE: Duration = Duration::from_millis(100);

/// Tells how far a task has come.
pub struct Meter {
    tell: tokio::sync::mpsc::UnboundedSender<String>,
    told: Mutex<Option<Instant>>,
}

impl Meter {
    /// Tells through a channel, line by line.
    pub fn new(tell: tokio::sync::mpsc::UnboundedSender<String>) -> Self {
        let told = Mutex::new(None);
        Meter { tell, told }
    }

    fn show(&self, what: &str, done: usize, of: usize) {
        let mut told = self.told.lock().unwrap_or_else(|e| e.into_inner());
        if told.is_some_and(|told| told.elapsed() < PAUSE) {
            return;
        }
        *told = Some(Instant::now());
        let line = serde_json::json!({ "what": what, "done": done, "of": of });
        // Whoever has gone away is not told.
        let _ = self.tell.send(line.to_string());
    }
}

#[derive(Serialize)]
struct Answer<'a, R> {
    /// As the program prints it.
    summary: String,
    report: &'a R,
    /// Each as SVG, by the name of its file.
    figures: Vec<(&'static str, String)>,
    /// The scene that was found, of a fit or a placement.
    scene: Option<&'a SceneFile>,
}

impl Task {
    /// Does what is asked; the answer as JSON.
    ///
    /// # Errors
    /// [`Refusal`] of a scene or of a computation that fails or is stopped.
    pub fn run(self, asked: &str, meter: &Meter) -> Result<String, Refusal> {
        let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let scene = Scene::from_json(&asked.scene.to_string())?;
        match self {
            Task::Cut => cut(&scene, meter),
            Task::Runup => runup(&scene, meter),
            Task::Washboard => washboard(&scene, meter),
            Task::Fit => fit(&scene, meter),
            Task::Place => place(&scene, &asked, meter),
            Task::Study => study(scene, &asked, meter),
        }
    }
}

fn answer<R: Figures + Serialize>(
    report: &R,
    summary: String,
    scene: Option<&SceneFile>,
) -> Result<String, Refusal> {
    let figures = report.figures().into_iter().map(|figure| {
        let [_, name] = figure.names();
        Ok((name, figure.svg().map_err(|error| Refusal::of(&error))?))
    });
    let figures = figures.collect::<Result<_, Refusal>>()?;
    let answer = Answer {
        summary,
        report,
        figures,
        scene,
    };
    serde_json::to_string(&answer).map_err(|error| Refusal::of(&error))
}

fn refused(error: TransientError) -> Refusal {
    Refusal::of(&error)
}

fn cut(scene: &Scene, meter: &Meter) -> Result<String, Refusal> {
    let cut = scene.needed_cut()?;
    let runs = cut.runs_at(&[])?;
    let progress = |done, of| meter.show("points of the map", done, of);
    let cutting = Cutting::new(scene, cut, &runs, &progress).map_err(refused)?;
    let report = CutReport::new(&cutting);
    answer(&report, report.summary(), None)
}

fn runup(scene: &Scene, meter: &Meter) -> Result<String, Refusal> {
    let runup = scene.needed_runup()?;
    let progress = |done, of| meter.show("steps", done, of);
    let found = RunningUp::new(scene, runup, &progress).map_err(refused)?;
    let report = RunUpReport::new(&found);
    answer(&report, report.summary(), None)
}

fn washboard(scene: &Scene, meter: &Meter) -> Result<String, Refusal> {
    let (cut, washboarding) = scene.needed_washboarding()?;
    let run = cut.at_rpm(scene.needed_operating_rpm(None)?)?;
    let progress = |done, of| meter.show("speeds", done, of);
    let found = Washboard::new(scene, (cut, washboarding), &run, &progress);
    let found = found.map_err(|error: WashboardError| Refusal::of(&error))?;
    let report = WashboardReport::new(&found);
    answer(&report, report.summary(), None)
}

fn fit(scene: &Scene, meter: &Meter) -> Result<String, Refusal> {
    let measurement = Measurement::of_scene(scene.needed_measured()?);
    let options = fit::Options::default().checked(&measurement)?;
    let freed = Freed::to_fit(scene, &[])?;
    let progress = |done, of| meter.show("starts", done, of);
    let compared = Fit::new(scene, &measurement, &freed, &options, &progress)
        .and_then(|fit| Ok((Compared::new(&fit)?, fit)));
    let (compared, fit) = compared.map_err(|error: FitError| Refusal::of(&error))?;
    let report = FitReport::new(&fit, &compared);
    answer(&report, report.summary(), Some(&report.scene))
}

fn place(scene: &Scene, asked: &Asked, meter: &Meter) -> Result<String, Refusal> {
    let goal = match asked.window {
        false => Goal::FlutterSpeed,
        true => Goal::window_of(scene)?,
    };
    let demands = Demands::new(goal, asked.min_critical_rpm)?;
    let freed = Freed::to_place(scene, &[])?;
    let progress = |what: &'static str, done, of| meter.show(what, done, of);
    let options = place::Options::default();
    let found = Placement::new(scene, &freed, &demands, &options, &progress);
    let found = found.map_err(|error: PlaceError| Refusal::of(&error))?;
    let report = PlaceReport::new(&demands, &found);
    answer(&report, report.summary(), Some(&report.scene))
}

fn study(scene: Scene, asked: &Asked, meter: &Meter) -> Result<String, Refusal> {
    let file = StudyFile::from_json(&asked.study.to_string());
    let file = file.map_err(|error| Refusal::of(&error))?;
    let study = Study::new(scene, file).map_err(|error| Refusal::of(&error))?;
    let saws = Mutex::new(Vec::new());
    let done = |saw| {
        let mut saws = saws.lock().unwrap_or_else(|e| e.into_inner());
        saws.push(saw);
        meter.show("saws", saws.len(), study.count());
        Ok::<_, std::convert::Infallible>(())
    };
    let Ok(()) = study::run(&study, None, 0..study.count(), &done);
    let mut saws = saws.into_inner().unwrap_or_else(|e| e.into_inner());
    saws.sort_by_key(|saw| saw.index);
    let report = StudyReport::new(&study, &saws).map_err(|error| Refusal::of(&error))?;
    answer(&report, report.summary(), None)
}
