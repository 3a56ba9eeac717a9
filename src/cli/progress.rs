//! A bar on the terminal while a command computes.

use std::io::IsTerminal;
use std::time::Duration;

use crate::spectrum::{Progress, Stage};
use indicatif::{ProgressBar, ProgressStyle};

/// Seen as movement.
const TICK: Duration = Duration::from_millis(200);

/// Does work with a bar on the terminal's error stream, and without one where that is not a terminal. The loops
/// of a command itself are shown by [`Progress::show`].
pub fn watched<T: Send>(work: impl FnOnce(&Progress) -> T + Send) -> anyhow::Result<T> {
    if !std::io::stderr().is_terminal() {
        return Ok(work(&Progress::default()));
    }
    let style = ProgressStyle::with_template("{bar:20} {pos}/{len} {msg}, {elapsed}");
    let bar =
        ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(TICK);
    let shown = bar.clone();
    let progress = Progress::new(move |stage| show(&shown, stage));
    let found = progress.watched(|| work(&progress));
    bar.finish_and_clear();
    Ok(found?)
}

fn show(bar: &ProgressBar, stage: Stage) {
    bar.set_length(stage.of.max(1) as u64);
    bar.set_position(stage.done as u64);
    bar.set_message(in_words(stage));
}

fn in_words(stage: Stage) -> String {
    match (stage.what, stage.eigenproblems) {
        (what, 0) => what.to_owned(),
        ("", count) => format!("{count} eigenproblems"),
        (what, count) => format!("{what}, {count} eigenproblems"),
    }
}
