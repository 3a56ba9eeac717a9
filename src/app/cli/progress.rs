//! A bar on the terminal while a command computes, or a line now and then where the error stream is no terminal.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::modes::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};

/// Interval between updates of the bar, which shows that the program is running.
const TICK: Duration = Duration::from_millis(200);

/// Interval between lines, in the log of a job or of a test.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// Shortest part of a step from which the time of its rest is estimated.
const SEEN: Duration = Duration::from_secs(2);

/// Whether no progress is shown. The program has one error stream, and sets this once, before it computes.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Shows no progress from now on, if asked for.
pub fn hush(is_quiet: bool) {
    IS_QUIET.store(is_quiet, Ordering::Relaxed);
}

/// Whether the error stream shows a progress bar.
pub fn has_bar() -> bool {
    std::io::stderr().is_terminal() && !IS_QUIET.load(Ordering::Relaxed)
}

/// Runs work with a progress bar on the error stream, or with a line every half a minute if that is not a terminal. The
/// work reports the progress of its own loops by [`Progress::show`].
pub fn watched<T: Send>(work: impl FnOnce(&Progress) -> T + Send) -> anyhow::Result<T> {
    watched_with_remarks(|progress, _| work(progress))
}

/// Runs work with a progress bar, and prints its remarks on the error stream, above the bar.
pub fn watched_with_remarks<T: Send>(
    work: impl FnOnce(&Progress, &(dyn Fn(&str) + Sync)) -> T + Send,
) -> anyhow::Result<T> {
    if IS_QUIET.load(Ordering::Relaxed) {
        let progress = Progress::default();
        return Ok(progress.watched(|| work(&progress, &|line| eprintln!("{line}")))?);
    }
    if !has_bar() {
        let lines = Lines::new(BETWEEN_LINES);
        let pace = Pace::default();
        let progress = Progress::new(move |stage| {
            if let Some(line) = lines.due(stage, pace.left(stage)) {
                eprintln!("{line}");
            }
        });
        let found = progress.watched(|| work(&progress, &|line| eprintln!("{line}")));
        return Ok(found?);
    }
    let style = ProgressStyle::with_template("{bar:20} {msg}, {elapsed}");
    let bar =
        ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(in_words(Stage::default(), None));
    bar.enable_steady_tick(TICK);
    let (shown, pace) = (bar.clone(), Pace::default());
    let progress = Progress::new(move |stage| show(&shown, stage, pace.left(stage)));
    let remark = |line: &str| bar.println(line);
    let found = progress.watched(|| work(&progress, &remark));
    bar.finish_and_clear();
    Ok(found?)
}

/// The step under way, for an estimate of the time that is left of it.
#[derive(Default)]
struct Pace(Mutex<Option<Begun>>);

/// A step, and what was finished of it when it was first seen.
struct Begun {
    what: &'static str,
    done: usize,
    of: usize,
    at: Instant,
}

impl Pace {
    /// Time that is left of the step, if its items go on to take as long as those seen so far.
    fn left(&self, stage: Stage) -> Option<Duration> {
        let mut begun = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let step = begun
            .take()
            .filter(|step| {
                (step.what, step.of) == (stage.what, stage.of) && step.done <= stage.done
            })
            .unwrap_or_else(|| Begun {
                what: stage.what,
                done: stage.done,
                of: stage.of,
                at: Instant::now(),
            });
        let (seen, passed) = (stage.done - step.done, step.at.elapsed());
        *begun = Some(step);
        let is_known = seen > 0 && passed >= SEEN && stage.done < stage.of;
        is_known.then(|| passed.mul_f64((stage.of - stage.done) as f64 / seen as f64))
    }
}

/// Lines with the progress at intervals; the first one as soon as a step is seen to take longer than that.
struct Lines {
    begun: Instant,
    interval: Duration,
    last: Mutex<Option<Instant>>,
}

impl Lines {
    fn new(interval: Duration) -> Self {
        Lines {
            begun: Instant::now(),
            interval,
            last: Mutex::default(),
        }
    }

    /// The line of a stage with the time that is left of it, if the last one is an interval ago.
    fn due(&self, stage: Stage, left: Option<Duration>) -> Option<String> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let is_long = last.is_none() && left.is_some_and(|left| left > self.interval);
        if !is_long && last.unwrap_or(self.begun).elapsed() < self.interval {
            return None;
        }
        *last = Some(Instant::now());
        let seconds = self.begun.elapsed().as_secs();
        Some(format!("{}, {seconds} s", in_words(stage, left)))
    }
}

fn show(bar: &ProgressBar, stage: Stage, left: Option<Duration>) {
    bar.set_length(stage.of.max(1) as u64);
    bar.set_position(stage.done as u64);
    bar.set_message(in_words(stage, left));
}

/// Text of the progress of a step, if it is known: the best result so far, and the time that is left of it or, while
/// that is unknown, the number of solved eigenproblems.
fn in_words(stage: Stage, left: Option<Duration>) -> String {
    let Stage {
        what,
        done,
        of,
        eigenproblems,
        best_rpm,
    } = stage;
    let best = best_rpm.map_or_else(String::new, |rpm| format!(", best {rpm:.0} rpm"));
    let solved = match (left, eigenproblems) {
        (Some(left), _) => format!("about {} left", rounded(left)),
        (None, 0) => "begun".to_owned(),
        (None, 1) => "1 eigenproblem".to_owned(),
        (None, count) => format!("{count} eigenproblems"),
    };
    match what {
        "" => solved,
        _ => format!("{done}/{of} {what}{best}, {solved}"),
    }
}

/// A time in seconds or minutes, to about a tenth.
fn rounded(time: Duration) -> String {
    match time.as_secs() {
        seconds @ ..10 => format!("{} s", seconds + 1),
        seconds @ ..100 => format!("{} s", (seconds + 5) / 10 * 10),
        seconds => format!("{} min", (seconds + 30) / 60),
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
            best_rpm: None,
        };
        let always = Lines::new(Duration::ZERO);
        let line = always.due(stage, None);
        assert_eq!(line.as_deref(), Some("3/64 saws, 200 eigenproblems, 0 s"));
        let seldom = Lines::new(BETWEEN_LINES);
        let [short, long] = [20, 200].map(|s| Some(Duration::from_secs(s)));
        assert_eq!(seldom.due(stage, short), None);
        // What will take longer than an interval says so once, at its start.
        let line = seldom.due(stage, long);
        assert_eq!(line.as_deref(), Some("3/64 saws, about 3 min left, 0 s"));
        assert_eq!(seldom.due(stage, long), None);
    }

    #[test]
    fn the_rest_of_a_step_takes_as_long_as_what_was_seen_of_it() {
        let stage = |what, done| Stage {
            what,
            done,
            of: 64,
            ..Stage::default()
        };
        let pace = Pace(Mutex::new(Some(Begun {
            what: "saws",
            done: 4,
            of: 64,
            at: Instant::now() - Duration::from_secs(30),
        })));
        let left = pace.left(stage("saws", 24)).unwrap();
        assert!((59..62).contains(&left.as_secs()), "{left:?}");
        assert_eq!(rounded(left), "60 s");
        assert_eq!(pace.left(stage("saws", 64)), None);
        // Another step begins anew.
        assert_eq!(pace.left(stage("map", 24)), None);
    }

    #[test]
    fn a_bar_says_what_is_being_done_between_two_steps_too() {
        let said = |what, done, of, eigenproblems| {
            let stage = Stage {
                what,
                done,
                of,
                eigenproblems,
                best_rpm: None,
            };
            in_words(stage, None)
        };
        assert_eq!(said("", 0, 0, 0), "begun");
        assert_eq!(said("", 0, 0, 23), "23 eigenproblems");
        assert_eq!(
            said("sizes of the basis", 5, 11, 1),
            "5/11 sizes of the basis, 1 eigenproblem"
        );
        let best = Stage {
            what: "refinement",
            done: 23,
            of: 180,
            eigenproblems: 5213,
            best_rpm: Some(2558.6),
        };
        let left = Some(Duration::from_secs(38));
        let said = in_words(best, left);
        assert_eq!(said, "23/180 refinement, best 2559 rpm, about 40 s left");
    }
}
