//! A bar on the terminal while a command computes, or a line now and then where the error stream is no terminal.

use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::modes::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};

/// Interval between updates of the bar, which shows that the program is running.
const TICK: Duration = Duration::from_millis(200);

/// Interval between lines, in the log of a job or of a test.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// Runs work with a progress bar on the error stream, or with a line every half a minute if that is not a terminal. The
/// work reports the progress of its own loops by [`Progress::show`].
pub fn watched<T: Send>(work: impl FnOnce(&Progress) -> T + Send) -> anyhow::Result<T> {
    watched_with_remarks(|progress, _| work(progress))
}

/// Runs work with a progress bar, and prints its remarks on the error stream, above the bar.
pub fn watched_with_remarks<T: Send>(
    work: impl FnOnce(&Progress, &(dyn Fn(&str) + Sync)) -> T + Send,
) -> anyhow::Result<T> {
    if !std::io::stderr().is_terminal() {
        let lines = Lines::new(BETWEEN_LINES);
        let progress = Progress::new(move |stage| {
            if let Some(line) = lines.due(stage) {
                eprintln!("{line}");
            }
        });
        let found = progress.watched(|| work(&progress, &|line| eprintln!("{line}")));
        return Ok(found?);
    }
    let style = ProgressStyle::with_template("{bar:20} {msg}, {elapsed}");
    let bar =
        ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(in_words(Stage::default()));
    bar.enable_steady_tick(TICK);
    let shown = bar.clone();
    let progress = Progress::new(move |stage| show(&shown, stage));
    let remark = |line: &str| bar.println(line);
    let found = progress.watched(|| work(&progress, &remark));
    bar.finish_and_clear();
    Ok(found?)
}

/// Lines with the progress at intervals.
struct Lines {
    begun: Instant,
    interval: Duration,
    last: Mutex<Instant>,
}

impl Lines {
    fn new(interval: Duration) -> Self {
        let begun = Instant::now();
        Lines {
            begun,
            interval,
            last: Mutex::new(begun),
        }
    }

    /// The line of a stage, if the last one is an interval ago.
    fn due(&self, stage: Stage) -> Option<String> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() < self.interval {
            return None;
        }
        *last = Instant::now();
        let seconds = self.begun.elapsed().as_secs();
        Some(format!("{}, {seconds} s", in_words(stage)))
    }
}

fn show(bar: &ProgressBar, stage: Stage) {
    bar.set_length(stage.of.max(1) as u64);
    bar.set_position(stage.done as u64);
    bar.set_message(in_words(stage));
}

/// Text of the progress of a step, if it is known, and of the number of solved eigenproblems.
fn in_words(stage: Stage) -> String {
    let Stage {
        what,
        done,
        of,
        eigenproblems,
    } = stage;
    let solved = match eigenproblems {
        0 => "begun".to_owned(),
        1 => "1 eigenproblem".to_owned(),
        count => format!("{count} eigenproblems"),
    };
    match what {
        "" => solved,
        _ => format!("{done}/{of} {what}, {solved}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_due_once_in_an_interval() {
        let stage = Stage {
            what: "saws",
            done: 3,
            of: 64,
            eigenproblems: 200,
        };
        let always = Lines::new(Duration::ZERO);
        let line = always.due(stage);
        assert_eq!(line.as_deref(), Some("3/64 saws, 200 eigenproblems, 0 s"));
        assert_eq!(Lines::new(BETWEEN_LINES).due(stage), None);
    }

    #[test]
    fn a_bar_says_what_is_being_done_between_two_steps_too() {
        let said = |what, done, of, eigenproblems| {
            in_words(Stage {
                what,
                done,
                of,
                eigenproblems,
            })
        };
        assert_eq!(said("", 0, 0, 0), "begun");
        assert_eq!(said("", 0, 0, 23), "23 eigenproblems");
        assert_eq!(
            said("sizes of the basis", 5, 11, 1),
            "5/11 sizes of the basis, 1 eigenproblem"
        );
    }
}
