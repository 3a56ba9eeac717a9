//! Progress of a task, line by line.

use std::sync::Mutex;

use crate::page::figure::Figure;

/// Clock that returns milliseconds since an arbitrary time.
pub type Clock = fn() -> f64;

/// Shortest interval between progress messages.
const PAUSE_MS: f64 = 100.0;
/// Shortest interval between intermediate figures. It is longer, because each figure has to be drawn.
const FIGURE_PAUSE_MS: f64 = 400.0;

/// Sends the progress of a task.
pub struct Meter<'a> {
    tell: &'a (dyn Fn(String) + Send + Sync),
    clock: Clock,
    told: Mutex<Option<f64>>,
    drawn: Mutex<Option<f64>>,
}

impl<'a> Meter<'a> {
    /// Creates a meter that sends lines of JSON to `tell`.
    pub fn new(tell: &'a (dyn Fn(String) + Send + Sync), clock: Clock) -> Self {
        Meter {
            tell,
            clock,
            told: Mutex::default(),
            drawn: Mutex::default(),
        }
    }

    /// Returns whether the interval has passed. If so, it starts again.
    fn is_due(&self, last: &Mutex<Option<f64>>, pause_ms: f64) -> bool {
        let mut last = last.lock().unwrap_or_else(|e| e.into_inner());
        let now = (self.clock)();
        let is_due = last.is_none_or(|last| now - last >= pause_ms);
        if is_due {
            *last = Some(now);
        }
        is_due
    }

    /// Sends the number of finished items of a kind, unless the interval has not passed.
    pub fn show(&self, what: &str, done: usize, of: usize) {
        self.show_with_best(what, done, of, None);
    }

    /// Sends the same, with the best result of a search so far, a speed in rpm.
    pub fn show_with_best(&self, what: &str, done: usize, of: usize, best_rpm: Option<f64>) {
        if self.is_due(&self.told, PAUSE_MS) {
            self.send(serde_json::json!({
                "what": what, "done": done, "of": of, "best_rpm": best_rpm,
            }));
        }
    }

    /// Sends an intermediate figure, unless the interval has not passed or the figure cannot be drawn yet.
    pub fn draw(&self, figure: impl FnOnce() -> Option<Figure>) {
        if !self.is_due(&self.drawn, FIGURE_PAUSE_MS) {
            return;
        }
        let Some(figure) = figure() else { return };
        let [_, name] = figure.names();
        if let Ok(svg) = figure.svg() {
            self.send(serde_json::json!({ "so_far": [[name, svg]] }));
        }
    }

    fn send(&self, line: serde_json::Value) {
        (self.tell)(line.to_string());
    }
}
