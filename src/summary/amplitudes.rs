//! Table of the amplitude to which the flutter of each band rises.

use std::fmt::{Result, Write};

use super::{ROWS, decimals_or, more, sentence};
use crate::report::{InstabilityBand, InstabilityKind, Report};

/// Writes a table of the flutter bands, in millimetres, if the report contains an amplitude.
pub fn amplitudes(text: &mut String, report: &Report) -> Result {
    let bands = report.instabilities.iter();
    let flutter = bands.filter(|band| band.kind == InstabilityKind::Flutter);
    let flutter: Vec<_> = flutter.collect();
    let is_known = |band: &&InstabilityBand| {
        band.saturated_amplitude_m.is_some() || band.amplitude_not_computed.is_some()
    };
    if !flutter.iter().any(is_known) {
        return Ok(());
    }
    writeln!(text, "\nFlutter           from       to    rises to")?;
    writeln!(text, "                 [rpm]    [rpm]        [mm]")?;
    for band in flutter.iter().take(ROWS) {
        let unknown = match &band.amplitude_not_computed {
            Some(_) => "not computed",
            None => "-",
        };
        let rises = decimals_or(unknown, 3, band.saturated_amplitude_m.map(|m| 1e3 * m));
        writeln!(
            text,
            "              {:>8.1} {:>8.1} {rises:>11}",
            band.from_rpm, band.to_rpm
        )?;
    }
    more(text, flutter.len(), ROWS, "report.json")?;
    for (band, reason) in flutter
        .iter()
        .filter_map(|band| Some((band, band.amplitude_not_computed.as_ref()?)))
    {
        let line = format!("Flutter from {:.1} rpm: {reason}", band.from_rpm);
        sentence(text, &line)?;
    }
    sentence(text, MEANING)
}

const MEANING: &str = "Rises to: largest deflection of a motion that begins small, at the speed of largest growth and \
     without damping, limited by stretching. Near one edge of a band it is up to 1.41 times as large and is reached later.";
