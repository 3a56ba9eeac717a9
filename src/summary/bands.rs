//! The table of bands of instability.

use std::fmt::{Result, Write};

use super::{ROWS, more, shortened};
use crate::report::{InstabilityBand, Report};

/// Longest name, in characters, that has room at the end of a row; a longer one is on a line of its own.
const WAVES: usize = 29;

/// Writes every band of instability, and whether its growth exceeds the threshold.
pub fn bands(text: &mut String, report: &Report) -> Result {
    let bands = &report.instabilities;
    if bands.is_empty() {
        return writeln!(
            text,
            "\nNo instability: nothing grows at any speed of the sweep"
        );
    }
    writeln!(
        text,
        "\n{:<14} {:>8} {:>8} {:>8} {:>7}  waves",
        "Bands", "from", "to", "growth", "at"
    )?;
    writeln!(
        text,
        "{:<14} {:>8} {:>8} {:>8} {:>7}",
        "", "[rpm]", "[rpm]", "[1/s]", "[Hz]"
    )?;
    for band in bands.iter().take(ROWS) {
        row(text, report, band)?;
    }
    more(text, bands.len(), ROWS, "report.json")?;
    if bands.iter().any(|band| band.counted_rpm.is_empty()) {
        writeln!(
            text,
            "(in brackets: flutter below the threshold of {} 1/s, which does not count)",
            report.flutter_threshold_per_s
        )?;
    }
    Ok(())
}

fn row(text: &mut String, report: &Report, band: &InstabilityBand) -> Result {
    let kind = match band.counted_rpm.is_empty() {
        true => format!("({})", band.kind),
        false => band.kind.to_string(),
    };
    let is_open = |at: f64, end: f64| !band.closed && (at - end).abs() <= 1e-9 * end.abs();
    let (first, last) = (report.campbell.from_rpm, report.campbell.to_rpm);
    let from = match is_open(band.from_rpm, first) {
        true => "before".to_owned(),
        false => format!("{:.1}", band.from_rpm),
    };
    let to = match is_open(band.to_rpm, last) {
        true => "beyond".to_owned(),
        false => format!("{:.1}", band.to_rpm),
    };
    let growth = match band.peak_growth_per_s < 0.005 {
        true => format!("{:.0e}", band.peak_growth_per_s),
        false => format!("{:.2}", band.peak_growth_per_s),
    };
    let waves = band.name.as_deref().unwrap_or_default();
    let is_long = waves.chars().count() > WAVES;
    writeln!(
        text,
        "  {kind:<12} {from:>8} {to:>8} {growth:>8} {:>7.2}  {}",
        band.frequency_hz,
        if is_long { "as follows" } else { waves }
    )?;
    if is_long {
        writeln!(text, "    {}", shortened(waves, super::WIDTH - 4))?;
    }
    partly(text, band)
}

/// Writes the ranges of speed in which the growth exceeds the threshold, unless they are the whole band.
fn partly(text: &mut String, band: &InstabilityBand) -> Result {
    let [stretches @ .., last] = band.counted_rpm.as_slice() else {
        return Ok(());
    };
    let whole = [band.from_rpm, band.to_rpm];
    if stretches.is_empty() && *last == whole {
        return Ok(());
    }
    let words = |[from, to]: &[f64; 2]| format!("{from:.1} to {to:.1}");
    let counted: Vec<String> = band.counted_rpm.iter().map(words).collect();
    let line = format!("    counts from {} rpm", counted.join(", and from "));
    writeln!(text, "{}", shortened(&line, super::WIDTH))
}
