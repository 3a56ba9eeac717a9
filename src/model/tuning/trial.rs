//! Factors of the tuned constants while they are on trial.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard};

/// Whether the trial runs; other tests need no lock.
static ON: AtomicBool = AtomicBool::new(false);
static TRIAL: Mutex<Trial> = Mutex::new(Trial {
    seen: BTreeSet::new(),
    scaled: None,
});

struct Trial {
    /// Names of the constants that were used.
    seen: BTreeSet<&'static str>,
    /// Name of the constant on trial, and its factor.
    scaled: Option<(&'static str, f64)>,
}

fn trial() -> MutexGuard<'static, Trial> {
    TRIAL
        .lock()
        .expect("nothing panics while the trial is locked")
}

pub(super) fn factor(name: &'static str) -> f64 {
    if !ON.load(Ordering::Relaxed) {
        return 1.0;
    }
    let mut trial = trial();
    trial.seen.insert(name);
    match trial.scaled {
        Some((scaled, factor)) if scaled == name => factor,
        _ => 1.0,
    }
}

/// Starts or ends the trial.
pub(crate) fn switch(is_on: bool) {
    ON.store(is_on, Ordering::Relaxed);
}

/// Names of the constants that were used since the trial began.
pub(crate) fn used() -> Vec<&'static str> {
    trial().seen.iter().copied().collect()
}

/// Result of a computation with a constant multiplied by a factor.
pub(crate) fn with_factor<T>(name: &'static str, factor: f64, compute: impl FnOnce() -> T) -> T {
    trial().scaled = Some((name, factor));
    let result = compute();
    trial().scaled = None;
    result
}
