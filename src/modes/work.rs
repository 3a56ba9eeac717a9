//! Work counters and the cancellation flag.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::error::SpectrumError;
use super::progress::{Progress, count_eigenproblem};

/// Amount of work of a model, by which tests detect a slow-down.
#[derive(Debug, Default)]
pub struct WorkCounters {
    /// Eigenproblems of one number of nodal diameters of a free blade, or of the matrices as they are.
    pub reduced_solves: AtomicUsize,
    /// Eigenproblems of the reduced model by waves.
    pub local_solves: AtomicUsize,
    /// Modes and coalescences found by Newton's method on the reduced model.
    pub refined_pairs: AtomicUsize,
    /// Eigenproblems of the full model: shifted Krylov iterations, or dense ones.
    pub full_solves: AtomicUsize,
    /// Number of `full_solves` that used blocks and columns.
    pub structured_solves: AtomicUsize,
    /// Symmetric eigenproblems of the full model at other temperatures.
    pub heat_solves: AtomicUsize,
    /// Cancellation flag, which is read when work is counted.
    pub cancellation: Cancellation,
}

/// A cancellation flag, shared by a computation and its caller. The computation reads it between two
/// eigenproblems and then ends with [`SpectrumError::Cancelled`].
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

thread_local! {
    /// The flag of the computation on this thread.
    static CURRENT: RefCell<Cancellation> = RefCell::default();
}

impl Cancellation {
    /// The flag of the computation on this thread, see [`Cancellation::watched`]; on other threads, one that
    /// is never set.
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Runs a function whose computations read this flag, on new threads, as many as the current pool has, so
    /// that several computations can be watched at the same time.
    ///
    /// # Errors
    /// The error of starting a thread.
    pub fn watched<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        self.watched_with(&Progress::current(), work)
    }

    /// As [`Cancellation::watched`], with another progress callback than that of this thread.
    ///
    /// # Errors
    /// The error of starting a thread.
    pub fn watched_with<T: Send>(
        &self,
        progress: &Progress,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        match self.pool_with(progress, rayon::current_num_threads()) {
            Ok(pool) => Ok(pool.install(work)),
            // In a browser no further thread can be started, so that this thread does the work.
            Err(_) if cfg!(target_family = "wasm") => Ok(self.on_this_thread(progress, work)),
            Err(error) => Err(error),
        }
    }

    /// Runs a function on this thread with this flag and a progress callback.
    fn on_this_thread<T>(&self, progress: &Progress, work: impl FnOnce() -> T) -> T {
        let before = (CURRENT.replace(self.clone()), Progress::current());
        progress.enter();
        let done = work();
        CURRENT.set(before.0);
        before.1.enter();
        done
    }

    /// A pool of threads that read this flag and report to the progress callback of this thread.
    ///
    /// # Errors
    /// The error of starting a thread.
    pub(crate) fn pool(
        &self,
        threads: usize,
    ) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        self.pool_with(&Progress::current(), threads)
    }

    /// A pool of threads that read this flag and report to a progress callback.
    fn pool_with(
        &self,
        progress: &Progress,
        threads: usize,
    ) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        let (stop, progress) = (self.clone(), progress.clone());
        let enter = move |_| {
            CURRENT.set(stop.clone());
            progress.enter();
        };
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .start_handler(enter)
            .build()
    }

    /// Cancels the computation.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the computation was cancelled.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Checks whether the next eigenproblem is to be solved, and counts it.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`] if the computation was cancelled.
    pub fn check(&self) -> Result<(), SpectrumError> {
        count_eigenproblem();
        if self.is_cancelled() {
            Err(SpectrumError::Cancelled)
        } else {
            Ok(())
        }
    }
}

impl Progress {
    /// Runs a function with this progress callback, on new threads, as many as the current pool has.
    ///
    /// # Errors
    /// The error of starting a thread.
    pub fn watched<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        Cancellation::current().watched_with(self, work)
    }
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;

    /// Every thread of a watched computation reads its own flag.
    #[test]
    fn two_computations_are_stopped_apart() {
        let (first, second) = (Cancellation::default(), Cancellation::default());
        let seen = |stop: &Cancellation| {
            let flags = || {
                (0..64)
                    .into_par_iter()
                    .map(|_| Cancellation::current().is_cancelled())
            };
            stop.watched(|| flags().collect::<Vec<_>>()).unwrap()
        };
        first.cancel();
        assert!(seen(&first).into_iter().all(|is_set| is_set));
        assert!(!seen(&second).into_iter().any(|is_set| is_set));
        assert!(!Cancellation::current().is_cancelled());
    }
}
