//! Charts as they are sent to the page, and kept for what it asks of them later.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::reply::Refusal;
use super::told::Told;
use crate::report::{Report, SensitivityEntry};
use crate::scene::{Accuracy, Scene};
use crate::stability::{Analysis, AnalysisOptions, Detail};

/// Which accuracy a chart is asked for at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fidelity {
    /// To [`DRAFT_TOLERANCE`], whatever the scene says, and drawn at fewer speeds: for a saw that is just being
    /// changed.
    Draft,
    /// The scene's own.
    Scene,
}

/// Of critical speeds and frequencies at rest, relative: less than the width of the strokes that show them, and half of the
/// time that one half as large takes.
const DRAFT_TOLERANCE: f64 = 2e-2;

#[derive(Serialize)]
struct Chart<'a> {
    /// Name of the chart when its modes are asked for.
    chart: usize,
    milliseconds: f64,
    told: Told,
    report: &'a Report,
}

/// The latest charts of every page, for the modes on them.
#[derive(Default)]
pub struct Charts(Mutex<Kept>);

#[derive(Default)]
struct Kept {
    made: usize,
    /// From the oldest on.
    latest: VecDeque<KeptChart>,
}

struct KeptChart {
    name: usize,
    page: String,
    analysis: Arc<Analysis>,
}

/// Of one page: the chart shown and those that are just being replaced.
const OF_A_PAGE: usize = 3;
/// Of all pages: some megabytes each.
const OF_ALL: usize = 48;

impl Charts {
    /// Computes a chart for a page and keeps it for its modes; the answer as JSON.
    ///
    /// # Errors
    /// [`Refusal`] of a scene or of a computation that fails or is stopped.
    pub fn chart(&self, page: &str, scene: &str, fidelity: Fidelity) -> Result<String, Refusal> {
        let started = Instant::now();
        let mut scene = Scene::from_json(scene)?;
        let detail = match fidelity {
            Fidelity::Draft => {
                scene = scene.edited(|file| {
                    (file.accuracy, file.tolerance) = (Accuracy::Draft, Some(DRAFT_TOLERANCE));
                })?;
                Detail::Sketch
            }
            Fidelity::Scene => Detail::Full,
        };
        let analysis = Analysis::with_options(
            &scene,
            AnalysisOptions {
                detail,
                ..AnalysisOptions::default()
            },
        )?;
        let mut report = analysis.report();
        if fidelity == Fidelity::Draft {
            // Half of what would be sent, and not shown.
            let at_rest = report.modes_at_rest.iter_mut();
            at_rest.for_each(|mode| mode.shape.clear());
        }
        let chart = self.keep(page, analysis);
        let milliseconds = 1e3 * started.elapsed().as_secs_f64();
        serde_json::to_string(&Chart {
            chart,
            milliseconds,
            told: Told::new(&report),
            report: &report,
        })
        .map_err(|error| Refusal::of(&error))
    }

    /// How the speeds of a chart move with the numbers of its scene.
    ///
    /// # Errors
    /// [`Refusal`] of a chart that is not kept any more, or of a computation that fails.
    pub fn influence(&self, asked: &str) -> Result<Vec<SensitivityEntry>, Refusal> {
        let chart: usize = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
        let analysis = self.named(chart).ok_or_else(|| Refusal::gone(chart))?;
        SensitivityEntry::all(&analysis).map_err(|error| Refusal::of(&error))
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn keep(&self, page: &str, analysis: Analysis) -> usize {
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
        });
        if kept.latest.len() > OF_ALL {
            kept.latest.pop_front();
        }
        name
    }

    /// A page is closed: its charts are not asked for any more.
    pub fn forget(&self, page: &str) {
        self.kept().latest.retain(|chart| chart.page != page);
    }

    /// A chart by its name, while it is kept.
    pub fn named(&self, name: usize) -> Option<Arc<Analysis>> {
        let kept = self.kept();
        let found = kept.latest.iter().find(|chart| chart.name == name);
        found.map(|chart| chart.analysis.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page that is looked at keeps its chart, however many another one asks for meanwhile.
    #[test]
    fn charts_are_kept_for_each_page_apart() {
        let charts = Charts::default();
        let scene = serde_json::to_string(Scene::paper().file()).unwrap();
        let ask = |page: &str| charts.chart(page, &scene, Fidelity::Draft).unwrap();
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
}
