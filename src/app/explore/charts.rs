//! Diagrams sent to the page, and kept for later requests about them.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::Serialize;

use super::answer::Told;
use super::early_answer::Ahead;
use super::influence::{Influence, influences};
use super::meter::Clock;
use super::progress::UnderWay;
use super::refusal::Refusal;
use super::reply::SavedFile;
use crate::analyses::campbell::{Report, Sensitivity};
use crate::model::plate::Resolution;
use crate::model::scene::{Accuracy, Scene, SceneError};
use crate::page::figure::ChartData;
use crate::stability::{Analysis, AnalysisOptions, ChosenBasis, Detail, Interim};

/// Accuracy with which a diagram is requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fidelity {
    /// [`DRAFT_TOLERANCE`], whatever the scene's tolerance is, and fewer speeds: for a saw that is being
    /// changed.
    Draft,
    /// The tolerance of the scene.
    Scene,
}

impl Fidelity {
    /// Returns the accuracy with this name: `draft` or `scene`.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "draft" => Fidelity::Draft,
            "scene" => Fidelity::Scene,
            _ => return None,
        })
    }
}

/// Relative tolerance of critical speeds and frequencies at rest. Errors are smaller than the width of the lines; half
/// the tolerance would take twice the time.
const DRAFT_TOLERANCE: f64 = 2e-2;

/// Returns the scene with the accuracy of a draft.
///
/// # Errors
/// [`SceneError`] if the scene is refused.
pub fn drafted(scene: &Scene) -> Result<Scene, SceneError> {
    scene.edited(|file| {
        (file.accuracy, file.tolerance) = (Accuracy::Draft, Some(DRAFT_TOLERANCE));
    })
}

#[derive(Serialize)]
struct Chart<'a> {
    /// Identifier of the diagram for later requests about it.
    chart: usize,
    milliseconds: f64,
    told: Told,
    /// Axes and items of the drawing.
    figure: ChartData,
    report: &'a Report,
}

/// The latest diagrams of every page, for later requests about them.
pub struct Charts {
    clock: Clock,
    kept: Mutex<Kept>,
    /// Diagrams that are being computed.
    pub under_way: UnderWay,
}

#[derive(Default)]
struct Kept {
    made: usize,
    /// Kept diagrams, the oldest first.
    latest: VecDeque<KeptChart>,
}

struct KeptChart {
    name: usize,
    page: String,
    analysis: Arc<Analysis>,
    /// Report for files; `None` for a draft. It is made at once, because its count of eigenproblems would include those
    /// of later requests.
    report: Option<Arc<Report>>,
}

/// Number of diagrams kept for one page: the visible diagram and those that replace it.
const OF_A_PAGE: usize = 3;
/// Number of diagrams kept for all pages; each takes some megabytes of memory.
const OF_ALL: usize = 48;

impl Charts {
    /// Creates an empty collection.
    pub fn new(clock: Clock) -> Self {
        Charts {
            clock,
            kept: Mutex::default(),
            under_way: UnderWay::default(),
        }
    }

    /// Numbers the next diagram `number`.
    pub fn number_from(&self, number: usize) {
        self.kept().made = number.saturating_sub(1);
    }

    /// Critical speeds of a page's scene with the accuracy of a draft.
    ///
    /// # Errors
    /// [`Refusal`] if the scene is refused or the computation fails or is cancelled.
    pub fn critical_speeds(&self, page: &str, scene: &str) -> Result<Ahead, Refusal> {
        let scene = drafted(&Scene::from_json(scene)?)?;
        let least = self.least_size(page, Fidelity::Draft);
        let chosen = ChosenBasis::at_least(&scene, scene.tolerance(), least)?;
        let interim = Interim {
            critical: &chosen.critical,
            range_rad_per_s: chosen.range_rad_per_s,
            bands: None,
            is_held: true,
        };
        Ok(Ahead::new(&scene, interim))
    }

    /// Computes a diagram for a page and keeps it for later requests; returns JSON. `tell` receives early results as
    /// JSON.
    ///
    /// # Errors
    /// [`Refusal`] if the scene is refused or the computation fails or is cancelled.
    pub fn chart(
        &self,
        page: &str,
        scene: &str,
        fidelity: Fidelity,
        tell: &(impl Fn(String) + Sync),
    ) -> Result<String, Refusal> {
        let started = (self.clock)();
        let mut scene = Scene::from_json(scene)?;
        let detail = match fidelity {
            Fidelity::Draft => {
                scene = drafted(&scene)?;
                Detail::Sketch
            }
            Fidelity::Scene => Detail::Full,
        };
        let interim = |interim: Interim<'_>| {
            let ahead = Ahead::new(&scene, interim);
            tell(serde_json::json!({ "ahead": ahead }).to_string());
        };
        let options = AnalysisOptions {
            detail,
            least_size: self.least_size(page, fidelity),
            interim: Some(&interim),
            ..AnalysisOptions::default()
        };
        let work = || Analysis::with_options(&scene, options);
        let watched = self.under_way.watched(page, work);
        let analysis = watched.map_err(|error| Refusal::of(&error))??;
        let mut report = analysis.report();
        let (told, figure) = (Told::new(&report), report.campbell_chart());
        if fidelity == Fidelity::Draft {
            leave_out_what_is_not_shown(&mut report);
        }
        let shared_report = Arc::new(report);
        let of_scene = (fidelity == Fidelity::Scene).then(|| shared_report.clone());
        let chart = self.keep(page, analysis, of_scene);
        let milliseconds = (self.clock)() - started;
        serde_json::to_string(&Chart {
            chart,
            milliseconds,
            told,
            figure,
            report: &shared_report,
        })
        .map_err(|error| Refusal::of(&error))
    }

    /// Influences of the numbers of a scene on the speeds of its diagram.
    ///
    /// # Errors
    /// [`Refusal`] if the diagram is no longer kept, or a computation fails.
    pub fn influence(&self, asked: &str) -> Result<Vec<Influence>, Refusal> {
        let chart: usize = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let found = self.find(chart, |kept| (kept.analysis.clone(), kept.report.clone()));
        let (analysis, kept) = found.ok_or_else(|| Refusal::gone(chart))?;
        let entries = Sensitivity::all(&analysis).map_err(|error| Refusal::of(&error))?;
        let report = kept.unwrap_or_else(|| Arc::new(analysis.report()));
        Ok(influences(&entries, &report))
    }

    /// A file for a scene as `sawflutter analyze` writes it: from the diagram with this identifier if it
    /// belongs to the scene and is kept; otherwise computed anew.
    ///
    /// # Errors
    /// [`Refusal`] if the scene is refused, or a computation fails or is cancelled.
    pub fn file(&self, kind: SavedFile, chart: usize, scene: &str) -> Result<Vec<u8>, Refusal> {
        let scene = Scene::from_json(scene)?;
        let known = self
            .find(chart, |kept| kept.report.clone())
            .flatten()
            .filter(|known| known.scene == *scene.file());
        kind.content(&scene, known)
    }

    /// Size at which the search for the basis of a page's next draft begins. The saw of the last draft is similar.
    /// Diagrams with the accuracy of the scene do not depend on earlier ones.
    pub fn least_size(&self, page: &str, fidelity: Fidelity) -> Resolution {
        let kept = self.kept();
        let mut latest = kept.latest.iter().rev();
        let draft = latest.find(|chart| chart.page == page && chart.report.is_none());
        match draft {
            Some(chart) if fidelity == Fidelity::Draft => chart.analysis.size_for_similar(),
            _ => AnalysisOptions::default().least_size,
        }
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn keep(&self, page: &str, analysis: Analysis, report: Option<Arc<Report>>) -> usize {
        let mut kept = self.kept();
        kept.made += 1;
        let name = kept.made;
        let of_page = |chart: &KeptChart| chart.page == page;
        if kept.latest.iter().filter(|chart| of_page(chart)).count() >= OF_A_PAGE {
            let oldest = kept.latest.iter().position(of_page);
            oldest.map(|place| kept.latest.remove(place));
        }
        kept.latest.push_back(KeptChart {
            name,
            page: page.to_owned(),
            analysis: Arc::new(analysis),
            report,
        });
        if kept.latest.len() > OF_ALL {
            kept.latest.pop_front();
        }
        name
    }

    /// Removes the diagrams of a closed page.
    #[cfg(feature = "explore")]
    pub fn forget(&self, page: &str) {
        self.kept().latest.retain(|chart| chart.page != page);
    }

    /// Returns the analysis of a diagram; `None` if it is no longer kept.
    pub fn named(&self, name: usize) -> Option<Arc<Analysis>> {
        self.find(name, |kept| kept.analysis.clone())
    }

    fn find<T>(&self, name: usize, get: impl Fn(&KeptChart) -> T) -> Option<T> {
        let kept = self.kept();
        kept.latest.iter().find(|chart| chart.name == name).map(get)
    }
}

/// Removes values that the page does not use, which are most of the report: shapes at rest, and the values at points of
/// branches other than speed and frequency.
fn leave_out_what_is_not_shown(report: &mut Report) {
    let at_rest = report.modes_at_rest.iter_mut();
    at_rest.for_each(|mode| mode.shape.clear());
    for branch in &mut report.campbell.branches {
        branch.direction.clear();
        branch.body_frequency_hz.clear();
        branch.growth_per_s.clear();
        branch.krein_sign.clear();
        branch.dominant_harmonics.clear();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::modes::Progress;

    /// Requests of other pages do not remove the diagram of a page.
    #[test]
    fn charts_are_kept_for_each_page_apart() {
        let charts = Charts::new(|| 0.0);
        let scene = serde_json::to_string(Scene::paper().file()).unwrap();
        let ask = |page: &str| charts.chart(page, &scene, Fidelity::Draft, &drop).unwrap();
        let first = ask("one");
        assert!(first.starts_with(r#"{"chart":1,"#), "{}", &first[..40]);
        for _ in 0..=OF_A_PAGE {
            ask("another");
        }
        let is_kept = |name: usize| charts.named(name).is_some();
        assert_eq!(
            [1, 2, 3, 4, 5].map(is_kept),
            [true, false, true, true, true]
        );
        charts.forget("another");
        assert_eq!(
            [1, 2, 3, 4, 5].map(is_kept),
            [true, false, false, false, false]
        );
    }

    /// A draft begins with the size of the last draft of its page, and returns to a smaller one when the saw needs
    /// no more. The first draft of a page and diagrams with the accuracy of the scene begin with the smallest.
    #[test]
    fn a_draft_begins_with_the_size_of_the_last_one() {
        let charts = Charts::new(|| 0.0);
        let draw = |page: &str, to_rpm: f64, fidelity: Fidelity| {
            let saw = Scene::paper().edited(|file| {
                file.accuracy = Accuracy::Draft;
                file.sweep.as_mut().unwrap().to_rpm = to_rpm;
            });
            let scene = serde_json::to_string(saw.unwrap().file()).unwrap();
            let answer = charts.chart(page, &scene, fidelity, &drop).unwrap();
            let chart: serde_json::Value = serde_json::from_str(&answer).unwrap();
            let name = chart["chart"].as_u64().unwrap() as usize;
            charts.named(name).unwrap().model.plate.resolution
        };
        let small = draw("one", 3000.0, Fidelity::Draft);
        let large = draw("one", 6000.0, Fidelity::Draft);
        assert!(large.max_diameters > small.max_diameters);
        assert_eq!(draw("another", 3000.0, Fidelity::Draft), small);
        assert_eq!(
            draw("one", 3000.0, Fidelity::Scene),
            draw("another", 3000.0, Fidelity::Scene)
        );
        let sizes: Vec<usize> = (0..8)
            .map(|_| draw("one", 3000.0, Fidelity::Draft).max_diameters)
            .collect();
        assert!(sizes.is_sorted_by(|x, y| x >= y), "{sizes:?}");
        assert!(sizes[7] < large.max_diameters, "{sizes:?}");
    }

    /// The file of a kept diagram equals that of a new computation, and solves nothing.
    #[test]
    fn a_file_is_made_of_the_chart_that_is_kept() {
        let charts = Charts::new(|| 0.0);
        let saw = Scene::paper().edited(|file| file.accuracy = Accuracy::Draft);
        let scene = serde_json::to_string(saw.unwrap().file()).unwrap();
        charts.chart("one", &scene, Fidelity::Scene, &drop).unwrap();
        charts.influence("1").unwrap();
        let file = |chart: usize| {
            let solved = Arc::new(AtomicUsize::new(0));
            let seen = solved.clone();
            let progress =
                Progress::new(move |stage| seen.store(stage.eigenproblems, Ordering::Relaxed));
            let work = || charts.file(SavedFile::Report, chart, &scene);
            let made = progress.watched(work).unwrap().unwrap();
            (made, solved.load(Ordering::Relaxed))
        };
        let (kept, computed) = (file(1), file(2));
        assert!(kept.0 == computed.0);
        assert!(kept.1 == 0 && computed.1 > 0, "{} {}", kept.1, computed.1);
        // A diagram of another scene is not used.
        let thicker = Scene::paper()
            .edited(|file| file.blade.thickness_m = 3e-3)
            .unwrap()
            .edited(|file| file.accuracy = Accuracy::Draft);
        let other = serde_json::to_string(thicker.unwrap().file()).unwrap();
        let made = charts.file(SavedFile::Report, 1, &other).unwrap();
        assert!(made != kept.0);
    }
}
