//! Progress of the diagrams that are being computed.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::modes::{Progress, Stage};

/// Stage of the latest diagram of each page.
#[derive(Default)]
pub struct UnderWay {
    begun: AtomicUsize,
    stages: Stages,
    told: Option<Tell>,
}

/// Callback for every stage.
type Tell = Arc<dyn Fn(Stage) + Send + Sync>;

/// The latest computation for each page.
type Stages = Arc<Mutex<HashMap<String, Latest>>>;

struct Latest {
    number: usize,
    stage: Stage,
}

impl UnderWay {
    /// Calls `tell` with every stage of every diagram.
    pub fn on_stage(&mut self, tell: impl Fn(Stage) + Send + Sync + 'static) {
        self.told = Some(Arc::new(tell));
    }

    /// Stage of the diagram of a page; `None` if none is being computed.
    #[cfg(any(test, feature = "explore"))]
    pub fn stage(&self, page: &str) -> Option<Stage> {
        locked(&self.stages).get(page).map(|latest| latest.stage)
    }

    /// Runs a function that computes a diagram of a page, and records its stages.
    ///
    /// # Errors
    /// An error if no thread can be started.
    pub fn watched<T: Send>(
        &self,
        page: &str,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        let number = 1 + self.begun.fetch_add(1, Ordering::Relaxed);
        let (stages, page_of, told) = (self.stages.clone(), page.to_owned(), self.told.clone());
        let stage = Stage::default();
        locked(&stages).insert(page_of.clone(), Latest { number, stage });
        let progress = Progress::new(move |stage| {
            // A cancelled computation may still report stages after the next computation for the page has
            // started.
            if let Some(latest) = locked(&stages).get_mut(&page_of)
                && latest.number == number
            {
                latest.stage = stage;
            }
            if let Some(told) = &told {
                told(stage);
            }
        });
        let done = progress.watched(work);
        let mut running = locked(&self.stages);
        if running
            .get(page)
            .is_some_and(|latest| latest.number == number)
        {
            running.remove(page);
        }
        done
    }
}

fn locked(stages: &Stages) -> MutexGuard<'_, HashMap<String, Latest>> {
    stages.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chart_is_under_way_until_it_is_done_and_a_later_one_takes_its_place() {
        let charts = UnderWay::default();
        let is_known = |page| charts.stage(page).is_some();
        assert!(!is_known("one"));
        let inner = || {
            assert!(is_known("one") && !is_known("another"));
            charts.watched("one", || assert!(is_known("one"))).unwrap();
            assert!(!is_known("one"));
        };
        charts.watched("one", inner).unwrap();
        assert!(!is_known("one"));
    }
}
