//! Analyses saws in parallel.

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use super::plan::Study;
use super::saw::Saw;
use crate::modes::Cancellation;

impl Study {
    /// Analyses all saws on all threads of the current pool, and returns them in the order of their numbers. Calls
    /// `done` with those that are finished after each one.
    pub fn saws(&self, done: &(dyn Fn(&[Saw]) + Sync)) -> Vec<Saw> {
        let saws = Mutex::new(Vec::<Saw>::new());
        let finished = |saw: Saw| {
            let mut saws = saws.lock().unwrap_or_else(PoisonError::into_inner);
            let place = saws.partition_point(|other| other.index < saw.index);
            saws.insert(place, saw);
            done(&saws);
            Ok::<_, Infallible>(())
        };
        let Ok(()) = self.run(None, 0..self.count(), &finished);
        saws.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// Analyses saws on `threads` threads, by default as many as the current pool has, and passes each saw to `done`
    /// when it is finished: in the order of `indices` on one thread, in any order on several. Each thread computes
    /// whole saws, because a second thread speeds up a single saw by a factor of only 1.3.
    ///
    /// # Errors
    /// The first error that `done` returns; it ends the run.
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
        let alone = || match stop.pool(1) {
            Ok(alone) => alone.install(work),
            // If the system refuses another thread, the existing ones compute all saws.
            Err(_) => work(),
        };
        if threads == 1 {
            return alone();
        }
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(alone)).collect();
            workers
                .into_iter()
                .try_for_each(|worker| match worker.join() {
                    Ok(result) => result,
                    Err(panic) => std::panic::resume_unwind(panic),
                })
        })
    }
}
