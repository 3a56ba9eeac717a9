//! Counters of the work done, and the flag by which it is cancelled.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::error::SpectrumError;
use super::progress::{Progress, count_eigenproblem};

/// Work done, so that a silent slow-down fails a test.
#[derive(Debug, Default)]
pub struct WorkCounters {
    /// Eigenproblems solved on the projected matrices.
    pub reduced_solves: AtomicUsize,
    /// Eigenproblems of the few states between two speeds.
    pub local_solves: AtomicUsize,
    /// Pairs of modes, of a damped blade single modes, refined by inverse iteration on the projected matrices.
    pub refined_pairs: AtomicUsize,
    /// Eigenproblems of the full model: shifted Krylov iterations, or dense ones.
    pub full_solves: AtomicUsize,
    /// Those among them that went by blocks and columns.
    pub structured_solves: AtomicUsize,
    /// Symmetric eigenproblems of the full model under other temperatures.
    pub heat_solves: AtomicUsize,
    /// Looked at where work is counted.
    pub cancellation: Cancellation,
}

/// A cancellation flag, shared by a computation and whoever may cancel it. The computation looks
/// at it between two eigenproblems and then ends with [`SpectrumError::Cancelled`].
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

thread_local! {
    /// The flag of the computation that this thread works for.
    static CURRENT: RefCell<Cancellation> = RefCell::default();
}

impl Cancellation {
    /// The flag of the computation that this thread works for, see [`Cancellation::watched`]; one that
    /// nobody sets on other threads.
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Does work that looks at this flag wherever it asks for [`Cancellation::current`]: on threads of its
    /// own, as many as the current pool has, so that several computations can be watched at once.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub fn watched<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        self.watched_with(&Progress::current(), work)
    }

    /// The same with another progress callback than that of this thread.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub fn watched_with<T: Send>(
        &self,
        progress: &Progress,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        let pool = self.pool_with(progress, rayon::current_num_threads())?;
        Ok(pool.install(work))
    }

    /// Threads of which this is the current flag, with the progress callback of this thread.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub(crate) fn pool(
        &self,
        threads: usize,
    ) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        self.pool_with(&Progress::current(), threads)
    }

    /// The same with another progress callback.
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

    /// Whether it was asked to.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Looks whether the next eigenproblem is to be solved, and counts it.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`] once the computation was asked to end.
    pub fn check(&self) -> Result<(), SpectrumError> {
        count_eigenproblem();
        match self.is_cancelled() {
            true => Err(SpectrumError::Cancelled),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;

    /// Every thread of a watched computation sees its flag and no other's.
    #[test]
    fn two_computations_are_stopped_apart() {
        let (first, second) = (Cancellation::default(), Cancellation::default());
        let seen = |stop: &Cancellation| {
            let asked = || {
                (0..64)
                    .into_par_iter()
                    .map(|_| Cancellation::current().is_cancelled())
            };
            stop.watched(|| asked().collect::<Vec<_>>()).unwrap()
        };
        first.cancel();
        assert!(seen(&first).into_iter().all(|asked| asked));
        assert!(!seen(&second).into_iter().any(|asked| asked));
        assert!(!Cancellation::current().is_cancelled());
    }
}
