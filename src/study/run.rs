//! Saws side by side.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use super::plan::Study;
use super::saw::Saw;
use crate::spectrum::Cancellation;

impl Study {
    /// Analyses saws on so many threads (by default those of the current pool), each handed over as
    /// soon as it is done, in the order of `indices` on one thread and in no order on several. Each
    /// thread has a saw of its own: a second thread makes one saw 1.3 times as fast, but two saws take
    /// no longer than one.
    ///
    /// # Errors
    /// The first that `done` returns; it ends the run.
    pub fn run<E: Send>(
        &self,
        threads: Option<usize>,
        indices: impl Iterator<Item = usize> + Send,
        done: &(dyn Fn(Saw) -> Result<(), E> + Sync),
    ) -> Result<(), E> {
        let (indices, stopped) = (Mutex::new(indices), AtomicBool::new(false));
        let next = || {
            indices
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .next()
        };
        let work = || {
            while !stopped.load(Ordering::Relaxed) {
                let Some(index) = next() else {
                    break;
                };
                if let Err(error) = done(self.saw(index)) {
                    stopped.store(true, Ordering::Relaxed);
                    return Err(error);
                }
            }
            Ok(())
        };
        let threads = threads.unwrap_or_else(rayon::current_num_threads);
        let stop = &Cancellation::current();
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads)
                .map(|_| {
                    scope.spawn(|| match stop.pool(1) {
                        Ok(alone) => alone.install(work),
                        // Where the system gives no more threads, saws share those there are.
                        Err(_) => work(),
                    })
                })
                .collect();
            workers
                .into_iter()
                .try_for_each(|worker| match worker.join() {
                    Ok(result) => result,
                    Err(panic) => std::panic::resume_unwind(panic),
                })
        })
    }
}
