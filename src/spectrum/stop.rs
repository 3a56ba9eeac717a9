//! The wish that a computation may end before it is done.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::SpectrumError;

/// A flag shared by a computation and whoever may lose interest in it. The computation looks
/// at it between two eigenproblems and then ends with [`SpectrumError::Stopped`].
#[derive(Debug, Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

thread_local! {
    /// The flag of the computation that this thread works for.
    static CURRENT: RefCell<Stop> = RefCell::default();
}

impl Stop {
    /// The flag of the computation that this thread works for, see [`Stop::watched`]; one that
    /// nobody sets on other threads.
    pub fn current() -> Self {
        CURRENT.with_borrow(Clone::clone)
    }

    /// Does work that looks at this flag wherever it asks for [`Stop::current`]: on threads of its
    /// own, as many as the current pool has, so that several computations can be watched at once.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub fn watched<T: Send>(
        &self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, rayon::ThreadPoolBuildError> {
        Ok(self.pool(rayon::current_num_threads())?.install(work))
    }

    /// Threads of which this is the current flag.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub(crate) fn pool(
        &self,
        threads: usize,
    ) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
        let stop = self.clone();
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .start_handler(move |_| CURRENT.set(stop.clone()))
            .build()
    }

    /// Asks the computation to end.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked to.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// # Errors
    /// [`SpectrumError::Stopped`] once the computation was asked to end.
    pub fn check(&self) -> Result<(), SpectrumError> {
        match self.is_asked() {
            true => Err(SpectrumError::Stopped),
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
        let (first, second) = (Stop::default(), Stop::default());
        let seen = |stop: &Stop| {
            let asked = || (0..64).into_par_iter().map(|_| Stop::current().is_asked());
            stop.watched(|| asked().collect::<Vec<_>>()).unwrap()
        };
        first.ask();
        assert!(seen(&first).into_iter().all(|asked| asked));
        assert!(!seen(&second).into_iter().any(|asked| asked));
        assert!(!Stop::current().is_asked());
    }
}
