//! Computations beside the interpreter: without its lock, with progress, until Ctrl-C.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pyo3::prelude::*;
use sawflutter::modes::{Cancellation, Progress, Stage};

use crate::failure::Failure;

/// Interval for Ctrl-C and progress.
const BEAT: Duration = Duration::from_millis(50);

/// Progress of a computation, of the loop that the program's bar shows.
pub struct Meter {
    shown: Arc<Mutex<Shown>>,
    progress: Progress,
    /// A message before the end, given once.
    remark: Mutex<Option<String>>,
}

/// The number of finished steps, their total, and their name.
type Shown = (usize, usize, &'static str);

impl Default for Meter {
    fn default() -> Self {
        let shown = Arc::new(Mutex::new((0, 0, "")));
        let seen = shown.clone();
        let see = move |stage: Stage| {
            // Between two loops the last one remains visible.
            if stage.of > 0 {
                *lock(&seen) = (stage.done, stage.of, stage.what);
            }
        };
        Meter {
            shown,
            progress: Progress::new(see),
            remark: Mutex::default(),
        }
    }
}

impl Meter {
    /// Reports finished steps and their total.
    pub fn show(&self, done: usize, of: usize) {
        self.show_of("", done, of);
    }

    /// Reports finished steps and their total, with their name.
    pub fn show_of(&self, what: &'static str, done: usize, of: usize) {
        self.progress.show(what, done, of);
    }

    /// Reports a message before the end.
    pub fn remark(&self, text: String) {
        *lock(&self.remark) = Some(text);
    }

    fn state(&self) -> Shown {
        *lock(&self.shown)
    }
}

/// Runs work on threads of its own and waits for it without the interpreter's lock. When Python
/// raises an exception meanwhile (Ctrl-C, or `progress` itself), that is returned at once, and the
/// work ends at the next eigenproblem.
///
/// # Errors
/// The exception of a [`Failure`], or the one that Python raised.
pub fn compute<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<Bound<'_, PyAny>>,
    work: impl FnOnce(&Meter) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let (stop, meter) = (Cancellation::default(), Arc::new(Meter::default()));
    let (sender, ticks) = channel();
    // A receiver belongs to one thread; the mutex shows this to the compiler.
    let receiver = Mutex::new(ticks);
    let (flag, gauge) = (stop.clone(), meter.clone());
    std::thread::spawn(move || {
        // The receiver is gone after a computation was stopped.
        let _ = sender.send(guarded(&flag, &gauge.progress, || work(&gauge)));
    });
    let mut told = (0, 0, "");
    // Steps end in any order on several threads, but within a phase no report runs back.
    let is_news =
        |state: Shown, told: Shown| (state.1, state.2) != (told.1, told.2) || state.0 > told.0;
    let mut tell = |state| match &progress {
        Some(progress) if is_news(state, told) => {
            told = state;
            progress.call1(state).map(|_| ())
        }
        _ => Ok(()),
    };
    loop {
        match py.detach(|| lock(&receiver).recv_timeout(BEAT)) {
            Ok(found) => {
                tell(meter.state())?;
                return Ok(found?);
            }
            Err(RecvTimeoutError::Timeout) => {
                let remark = lock(&meter.remark).take();
                let logged = remark.map_or(Ok(()), |text| log(py, &text));
                let raised = py
                    .check_signals()
                    .and(logged)
                    .and_then(|()| tell(meter.state()));
                if let Err(raised) = raised {
                    stop.cancel();
                    return Err(raised);
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::Fault("the computation has no result".into()).into());
            }
        }
    }
}

/// Gives a warning of the package's logger, which Python shows on the error stream by default.
fn log(py: Python<'_>, text: &str) -> PyResult<()> {
    let logger = py
        .import("logging")?
        .call_method1("getLogger", ("sawflutter",))?;
    logger.call_method1("warning", (text,)).map(|_| ())
}

/// The result of the work, with a panic as an error.
fn guarded<T: Send>(
    stop: &Cancellation,
    progress: &Progress,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let watched = catch_unwind(AssertUnwindSafe(|| stop.watched_with(progress, work)));
    match watched {
        Ok(Ok(found)) => found,
        Ok(Err(error)) => Err(Failure::Failed(error.to_string())),
        Err(panic) => {
            let said = panic
                .downcast_ref::<String>()
                .map(String::as_str)
                .or(panic.downcast_ref::<&str>().copied());
            Err(Failure::Fault(format!(
                "a fault of sawflutter, please report it with the scene: {}",
                said.unwrap_or("no message")
            )))
        }
    }
}

/// The value of a mutex is usable also after a panic of its thread.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
