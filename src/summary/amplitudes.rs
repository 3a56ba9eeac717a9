//! Table of the amplitude to which the flutter of each band rises.

use std::fmt::{Result, Write};

use super::{ROWS, decimals_or, more, sentence};
use crate::report::{InstabilityKind, Report};

/// Writes a table of the flutter bands, in millimetres, if the report contains an amplitude.
pub fn amplitudes(text: &mut String, report: &Report) -> Result {
    let bands = report.instabilities.iter();
    let flutter = bands.filter(|band| band.kind == InstabilityKind::Flutter);
    let flutter: Vec<_> = flutter.collect();
    if flutter
        .iter()
        .all(|band| band.saturated_amplitude_m.is_none())
    {
        return Ok(());
    }
    writeln!(text, "\nFlutter           from       to    rises to")?;
    writeln!(text, "                 [rpm]    [rpm]        [mm]")?;
    for band in flutter.iter().take(ROWS) {
        let rises = decimals_or("-", 3, band.saturated_amplitude_m.map(|m| 1e3 * m));
        writeln!(
            text,
            "              {:>8.1} {:>8.1} {rises:>11}",
            band.from_rpm, band.to_rpm
        )?;
    }
    more(text, flutter.len(), ROWS, "report.json")?;
    sentence(text, MEANING)
}

const MEANING: &str = "Rises to: largest deflection of a motion that begins small, at the speed of largest growth and \
     without damping, limited by stretching. Near one edge of a band it is up to 1.41 times as large and is reached later.";
