//! Queue of computations, which run one at a time and are cancelled if their request is closed.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use tokio::sync::Semaphore;

use crate::modes::Cancellation;

/// Queue of computations. Each uses all cores, so that two at a time would delay both.
#[derive(Clone, Default)]
pub struct Jobs {
    turn: Turn,
    count: Arc<Count>,
}

#[derive(Clone)]
struct Turn(Arc<Semaphore>);

impl Default for Turn {
    fn default() -> Self {
        Turn(Arc::new(Semaphore::new(1)))
    }
}

/// Numbers of completed and cancelled computations.
#[derive(Default)]
struct Count {
    finished: AtomicUsize,
    stopped: AtomicUsize,
}

/// Cancels a computation when its future is dropped.
struct CancelOnDrop {
    stop: Cancellation,
    /// Whether the computation is completed. Its flag is then not set, because the diagram keeps it for later
    /// computations.
    done: bool,
}

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        if !self.done {
            self.stop.cancel();
        }
    }
}

impl Jobs {
    /// Runs a computation when its turn comes. Dropping the future, which the server does when the browser closes the
    /// request, removes the computation from the queue or cancels it. The next computation starts at once, without
    /// waiting for the end of a cancelled one.
    ///
    /// `None` if the program is ending.
    pub async fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Option<T> {
        let mut guard = CancelOnDrop {
            stop: Cancellation::default(),
            done: false,
        };
        let stop = guard.stop.clone();
        // `_turn` is released when this future is dropped, so that a cancelled computation does not block the
        // queue.
        let _turn = self.turn.0.acquire().await.ok()?;
        let count = self.count.clone();
        let done = tokio::task::spawn_blocking(move || {
            let done = stop.watched(work).ok();
            let tally = if stop.is_cancelled() {
                &count.stopped
            } else {
                &count.finished
            };
            tally.fetch_add(1, Ordering::Relaxed);
            done
        })
        .await
        .ok()
        .flatten();
        guard.done = true;
        done
    }

    /// Numbers of completed and cancelled computations.
    pub fn counts(&self) -> [usize; 2] {
        [&self.count.finished, &self.count.stopped].map(|c| c.load(Ordering::Relaxed))
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::model::scene::{Accuracy, Scene};
    use crate::modes::SpectrumError;
    use crate::stability::{Analysis, AnalysisError, AnalysisOptions};

    fn runtime() -> tokio::runtime::Runtime {
        let mut builder = tokio::runtime::Builder::new_current_thread();
        builder.enable_all().build().unwrap()
    }

    /// An endless computation ends when its future is dropped, and the next one starts without waiting for this end.
    #[test]
    fn what_nobody_waits_for_is_stopped_and_holds_up_nothing() {
        let jobs = Jobs::default();
        let may_end = Arc::new(std::sync::Mutex::new(()));
        let held = may_end.lock().unwrap();
        // The end of the runtime waits for running computations.
        let runtime = runtime();
        let next = runtime.block_on(async {
            let may_end = may_end.clone();
            let endless = jobs.run(move || {
                while !Cancellation::current().is_cancelled() {
                    std::thread::sleep(Duration::from_millis(1));
                }
                drop(may_end.lock());
            });
            let gave_up = tokio::time::timeout(Duration::from_millis(20), endless).await;
            assert!(gave_up.is_err(), "the computation ended by itself");
            jobs.run(|| Cancellation::current().is_cancelled()).await
        });
        assert_eq!(next, Some(false));
        assert_eq!(jobs.counts(), [1, 0]);
        drop(held);
        while jobs.counts() != [1, 1] {
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_request_dropped_while_it_waits_is_never_computed() {
        let jobs = Jobs::default();
        let ahead = jobs.clone();
        runtime().block_on(async {
            let first = tokio::spawn(async move {
                let work = || std::thread::sleep(Duration::from_millis(50));
                ahead.run(work).await
            });
            tokio::task::yield_now().await;
            let second = jobs.run(|| panic!("computed, though nobody waits"));
            let gave_up = tokio::time::timeout(Duration::from_millis(5), second).await;
            assert!(gave_up.is_err());
            first.await.unwrap();
        });
        assert_eq!(jobs.counts(), [1, 0]);
    }

    /// An analysis that is cancelled before it begins, or at a progress callback after the first, the middle
    /// or the last speed, returns its error and no diagram.
    #[test]
    fn a_cancelled_analysis_does_not_finish() {
        let paper = Scene::paper();
        let scene = paper
            .edited(|file| file.accuracy = Accuracy::Draft)
            .unwrap();
        let cancelled_after = |share: f64| {
            let flag = Cancellation::default();
            let asked = flag.clone();
            let progress = move |done: usize, all: usize| {
                if done as f64 >= share * all as f64 {
                    asked.cancel();
                }
            };
            if share == 0.0 {
                flag.cancel();
            }
            let analysis = || {
                let options = AnalysisOptions {
                    progress: &progress,
                    ..AnalysisOptions::default()
                };
                Analysis::with_options(&scene, options).map(drop)
            };
            flag.watched(analysis).unwrap()
        };
        let cancelled = AnalysisError::Spectrum(SpectrumError::Cancelled).to_string();
        for share in [0.0, 1e-3, 0.5, 1.0] {
            let error = cancelled_after(share).expect_err("a chart");
            assert_eq!(error.to_string(), cancelled, "{share}");
        }
        assert!(cancelled_after(2.0).is_ok());
    }
}
