//! Progress of a computation, for a progress callback.
//!
//! A loop over a known amount of work is a [`Work`]. Of nested loops the outermost one is shown. The number of
//! eigenproblems is counted wherever the cancellation flag is read, and shows progress within one item of the
//! loop.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::Serialize;

/// Stage of a computation.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Stage {
    /// Name of the counted items; empty between two loops.
    pub what: &'static str,
    /// Number of finished items.
    pub done: usize,
    /// Number of all items known so far.
    pub of: usize,
    /// Number of eigenproblems, and of work items of similar size, since the computation began.
    pub eigenproblems: usize,
    /// The best result of a search so far, a speed in rpm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub best_rpm: Option<f64>,
}

/// The progress callback of a computation; none by default.
#[derive(Clone, Default)]
pub struct Progress(Option<Arc<Shared>>);

struct Shared {
    callback: Box<dyn Fn(Stage) + Send + Sync>,
    stage: Mutex<Stage>,
    eigenproblems: AtomicUsize,
    /// Whether a loop is shown.
    is_busy: AtomicBool,
}

thread_local! {
    /// The callback of the computation on this thread.
    static CURRENT: RefCell<Progress> = RefCell::default();
}

impl Progress {
    /// A callback that receives the stage whenever an item of the loop shown or an eigenproblem is finished.
    pub fn new(callback: impl Fn(Stage) + Send + Sync + 'static) -> Self {
        Progress(Some(Arc::new(Shared {
            callback: Box::new(callback),
            stage: Mutex::default(),
            eigenproblems: AtomicUsize::new(0),
            is_busy: AtomicBool::new(false),
        })))
    }

    /// The callback of the computation on this thread.
    pub(super) fn current() -> Self {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Sets this callback for this thread.
    pub(super) fn enter(&self) {
        CURRENT.set(self.clone());
    }

    /// Shows a loop that has its own counter; nested loops are not shown until it is finished.
    pub fn show(&self, what: &'static str, done: usize, of: usize) {
        if let Some(shared) = &self.0 {
            shared.is_busy.store(done < of, Ordering::Relaxed);
            shared.at(what, done, of);
        }
    }

    /// Shows the best result of a search, a speed in rpm, from the next stage on.
    pub fn show_best(&self, best_rpm: Option<f64>) {
        if let Some(shared) = &self.0 {
            shared.stage().best_rpm = best_rpm;
        }
    }
}

impl Shared {
    fn stage(&self) -> MutexGuard<'_, Stage> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn at(&self, what: &'static str, done: usize, of: usize) {
        let mut stage = self.stage();
        let eigenproblems = self.eigenproblems.load(Ordering::Relaxed);
        *stage = Stage {
            what,
            done,
            of,
            eigenproblems,
            best_rpm: stage.best_rpm,
        };
        (self.callback)(*stage);
    }
}

/// Counts an eigenproblem of the computation on this thread.
pub(super) fn count_eigenproblem() {
    CURRENT.with_borrow(|progress| {
        if let Some(shared) = &progress.0 {
            let mut stage = shared.stage();
            stage.eigenproblems = 1 + shared.eigenproblems.fetch_add(1, Ordering::Relaxed);
            (shared.callback)(*stage);
        }
    });
}

/// A loop over work of a known amount.
pub(crate) struct Work {
    shared: Option<Arc<Shared>>,
    /// Whether this loop is shown.
    is_shown: AtomicBool,
    what: &'static str,
    done: AtomicUsize,
    of: AtomicUsize,
}

impl Work {
    /// Begins a loop of a number of parts.
    pub fn of(what: &'static str, parts: usize) -> Self {
        let step = Work {
            shared: Progress::current().0,
            is_shown: AtomicBool::new(false),
            what,
            done: AtomicUsize::new(0),
            of: AtomicUsize::new(parts),
        };
        step.show();
        step
    }

    /// Counts a finished part.
    pub fn advance(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
        self.show();
    }

    /// Adds parts to the loop.
    pub fn extend(&self, parts: usize) {
        self.of.fetch_add(parts, Ordering::Relaxed);
    }

    fn show(&self) {
        let Some(shared) = &self.shared else { return };
        let is_next = || !shared.is_busy.swap(true, Ordering::Relaxed);
        if self.is_shown.load(Ordering::Relaxed) || is_next() {
            self.is_shown.store(true, Ordering::Relaxed);
            let [done, of] = [&self.done, &self.of].map(|n| n.load(Ordering::Relaxed));
            shared.at(self.what, done.min(of), of);
        }
    }
}

impl Drop for Work {
    fn drop(&mut self) {
        if let (Some(shared), true) = (&self.shared, *self.is_shown.get_mut()) {
            shared.at("", 0, 0);
            shared.is_busy.store(false, Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;
    use crate::modes::Cancellation;

    /// The callback receives the outer of two loops, part by part, and every eigenproblem.
    #[test]
    fn the_outer_loop_is_shown_and_every_eigenproblem_counts() {
        let stages = Arc::new(Mutex::new(Vec::new()));
        let seen = stages.clone();
        let progress = Progress::new(move |stage| seen.lock().unwrap().push(stage));
        let work = || {
            let outer = Work::of("saws", 8);
            (0..8).into_par_iter().for_each(|_| {
                let inner = Work::of("speeds", 3);
                for _ in 0..3 {
                    Cancellation::current().check().unwrap();
                    inner.advance();
                }
                outer.advance();
            });
            drop(outer);
            Work::of("points", 1).advance();
        };
        progress.watched(work).unwrap();
        let stages = stages.lock().unwrap();
        assert!(stages.iter().all(|stage| stage.what != "speeds"));
        assert_eq!(stages[0].what, "saws");
        assert_eq!(
            stages.iter().map(|stage| stage.eigenproblems).max(),
            Some(24)
        );
        let points = |stage: &Stage| (stage.what, stage.done, stage.of) == ("points", 1, 1);
        assert!(stages.iter().any(points));
        assert_eq!(stages[stages.len() - 1].what, "");
        let saws = stages.iter().filter(|stage| stage.what == "saws");
        assert_eq!(saws.map(|stage| stage.done).max(), Some(8));
    }
}
