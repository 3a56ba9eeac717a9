//! The report in words, 80 columns wide.

mod answer;
mod bands;
mod excitation;
mod in_cut;
mod influences;
mod whirl;

use std::fmt::Write;

use textwrap::{Options, WordSeparator, WordSplitter};

use crate::report::{Report, RestMode};
use crate::scene::BladeFile;

/// Lines of a table before the rest is only counted.
const ROWS: usize = 12;
pub const WIDTH: usize = 80;

/// What a designer wants to know: the answer first, then what it rests on.
pub fn summary(report: &Report) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = header(&mut text, report);
    let _ = answer::answer(&mut text, report);
    let _ = in_cut::in_cut(&mut text, report);
    let _ = modes(&mut text, report);
    let _ = critical_speeds(&mut text, report);
    let _ = bands::bands(&mut text, report);
    let _ = excitation::crossings(&mut text, report);
    let _ = influences::heat(&mut text, report);
    let _ = influences::sensitivity(&mut text, report);
    let _ = whirl::whirl(&mut text, report);
    let _ = answer::trust(&mut text, report);
    text
}

fn header(text: &mut String, report: &Report) -> std::fmt::Result {
    let blade = &report.scene.blade;
    writeln!(text, "{}", shortened(&report.scene.name, WIDTH))?;
    writeln!(
        text,
        "{:.1} mm outside, {:.1} mm bore, {} thick; {} to {} rpm",
        1e3 * blade.outer_diameter_m,
        1e3 * blade.inner_diameter_m,
        thickness(blade),
        report.campbell.from_rpm.round(),
        report.campbell.to_rpm.round()
    )
}

fn thickness(blade: &BladeFile) -> String {
    let (least, largest) = blade.thickness_range_m();
    let [least, largest] = [least, largest].map(|thickness_m| 1e3 * thickness_m);
    match least == largest {
        true => format!("{largest:.2} mm"),
        false => format!("{least:.2} to {largest:.2} mm"),
    }
}

fn modes(text: &mut String, report: &Report) -> std::fmt::Result {
    let modes = &report.modes_at_rest;
    match modes.iter().any(|mode| mode.damping_ratio.is_some()) {
        true => writeln!(
            text,
            "\nModes at rest: [Hz], damping ratio [%], logarithmic decrement"
        )?,
        false => writeln!(text, "\nModes at rest [Hz]")?,
    }
    for mode in modes.iter().take(8) {
        let line = format!(
            "  {:>9.2}  {}{}",
            mode.frequency_hz,
            damping(mode),
            numbered(mode.branch, &mode.name)
        );
        writeln!(text, "{line}")?;
    }
    Ok(())
}

fn damping(mode: &RestMode) -> String {
    let Some(ratio) = mode.damping_ratio else {
        return String::new();
    };
    let decrement = mode.logarithmic_decrement;
    let decrement = decrement.map_or("-".to_owned(), |d| format!("{d:.2e}"));
    format!("{:>8} {decrement:>8}  ", format!("{:.2e}", 100.0 * ratio))
}

/// Number and name of a branch, as at the lines of the Campbell diagram.
fn numbered(branch: Option<usize>, name: &str) -> String {
    match branch {
        Some(number) => format!("{number}: {name}"),
        None => name.to_owned(),
    }
}

fn critical_speeds(text: &mut String, report: &Report) -> std::fmt::Result {
    let speeds = &report.critical_speeds;
    if speeds.is_empty() {
        return writeln!(
            text,
            "\nNo critical speed up to {:.0} rpm",
            report.campbell.to_rpm
        );
    }
    writeln!(text, "\nCritical speeds [rpm]")?;
    for critical in speeds.iter().take(ROWS) {
        let name = numbered(critical.branch, &critical.name);
        writeln!(text, "  {:>9.1}  {name}", critical.rpm)?;
    }
    more(text, speeds.len())
}

fn more(text: &mut String, rows: usize) -> std::fmt::Result {
    match rows.checked_sub(ROWS) {
        Some(rest) if rest > 0 => writeln!(text, "  … and {rest} more in report.json"),
        _ => Ok(()),
    }
}

pub fn shortened(line: &str, width: usize) -> String {
    if line.chars().count() <= width {
        return line.to_owned();
    }
    line.chars().take(width - 1).chain(['…']).collect()
}

/// Breaks a sentence into lines at spaces.
pub fn wrapped(sentence: &str) -> String {
    let at_spaces = Options::new(WIDTH)
        .subsequent_indent("  ")
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation)
        .break_words(false);
    textwrap::fill(sentence, at_spaces)
}
