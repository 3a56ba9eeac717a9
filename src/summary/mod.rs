//! Summaries of reports, which the program prints and the live page and Python show.
//!
//! `summary()` of a report returns plain text of at most 80 columns, with the answer in the first lines.

mod amplitudes;
mod answer;
mod bands;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod cut;
pub(crate) mod deflect;
mod excitation;
pub(crate) mod fit;
pub(crate) mod gap;
mod in_cut;
mod influences;
pub(crate) mod map;
pub(crate) mod place;
pub(crate) mod report;
pub(crate) mod response;
pub(crate) mod runup;
pub(crate) mod study;
pub(crate) mod washboard;
mod whirl;

use std::fmt::Write;

#[cfg(any(feature = "cli", feature = "page"))]
pub use self::answer::Answer;
pub use self::answer::answer;
#[cfg(feature = "page")]
pub use self::answer::headline;
use crate::report::Report;
use textwrap::{Options, WordSeparator, WordSplitter};

/// Largest number of rows of a table; further rows are counted.
const ROWS: usize = 12;
/// Largest number of characters of a line.
const WIDTH: usize = 80;
/// Number of characters of a name that precedes a long condition of the saw.
const SHORT_NAME: usize = 40;

/// Whether the modes at rest have damping ratios.
pub fn is_damped(report: &Report) -> bool {
    let mut modes = report.modes_at_rest.iter();
    modes.any(|mode| mode.damping_ratio.is_some())
}

/// Number and name of a branch, "4: 2 forward", as in the Campbell diagram; the name alone without a number.
pub fn numbered(branch: Option<usize>, name: &str) -> String {
    match branch {
        Some(number) => format!("{number}: {name}"),
        None => name.to_owned(),
    }
}

/// Counts the rows that a table does not show, and names the file that contains all of them.
fn more(text: &mut String, rows: usize, shown: usize, file: &str) -> std::fmt::Result {
    match rows.saturating_sub(shown) {
        0 => Ok(()),
        rest => writeln!(text, "  … and {rest} more in {file}"),
    }
}

/// Writes the name of the scene, its condition and its unusual numbers. They are written before the verdict, because
/// another load or a mistyped number makes it the verdict on another saw.
fn heading(
    text: &mut String,
    name: &str,
    condition: &str,
    unusual_numbers: &[String],
) -> std::fmt::Result {
    named(text, name, condition)?;
    each(text, "Unusual number", unusual_numbers)
}

/// Writes a name, and whether the saw idles or is in its cut.
fn named(text: &mut String, name: &str, condition: &str) -> std::fmt::Result {
    let room = WIDTH.saturating_sub(": ".len() + condition.chars().count());
    let name = shortened(name, room.max(SHORT_NAME));
    sentence(text, &format!("{name}: {condition}"))
}

/// Writes sentences, each after a word: "Warning: …".
fn each(text: &mut String, word: &str, sentences: &[String]) -> std::fmt::Result {
    let mut lines = sentences.iter();
    lines.try_for_each(|line| sentence(text, &format!("{word}: {line}")))
}

/// Writes a sentence, see [`wrapped`].
fn sentence(text: &mut String, sentence: &str) -> std::fmt::Result {
    writeln!(text, "{}", wrapped(sentence))
}

/// A value with a number of decimals, or a word for a missing value.
fn decimals_or(missing: &str, decimals: usize, value: Option<f64>) -> String {
    value.map_or_else(|| missing.to_owned(), |value| format!("{value:.decimals$}"))
}

/// The line, cut off with an ellipsis if it has more characters than `width`.
pub fn shortened(line: &str, width: usize) -> String {
    if line.chars().count() <= width {
        return line.to_owned();
    }
    line.chars().take(width - 1).chain(['…']).collect()
}

/// Breaks a sentence at spaces into lines of at most 80 characters; all but the first are indented.
pub fn wrapped(sentence: &str) -> String {
    let at_spaces = Options::new(WIDTH)
        .subsequent_indent("  ")
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation)
        .break_words(false);
    textwrap::fill(sentence, at_spaces)
}
