//! The table of the crossings of multiples of the rotation speed with natural frequencies.

use std::fmt::{Result, Write};

use super::{ROWS, more, numbered, shortened};
use crate::report::Report;

/// Writes speed, order and frequency of each crossing, if the scene requests multiples of the speed.
pub fn crossings(text: &mut String, report: &Report) -> Result {
    let Some(excitation) = &report.excitation else {
        return Ok(());
    };
    let complete_hz = report.campbell.complete_to_hz;
    if excitation.crossings.is_empty() {
        return writeln!(
            text,
            "\nNo requested multiple of the speed equals a frequency below {complete_hz:.0} Hz"
        );
    }
    writeln!(
        text,
        "\nExcitation at multiples of the speed, up to {complete_hz:.0} Hz\n     rpm  order     [Hz]  mode"
    )?;
    for crossing in excitation.crossings.iter().take(ROWS) {
        let line = format!(
            "  {:>6.1} {:>5}× {:>8.2}  {}",
            crossing.rpm,
            crossing.order,
            crossing.frequency_hz,
            numbered(crossing.branch, &crossing.mode)
        );
        writeln!(text, "{}", shortened(&line, super::WIDTH))?;
    }
    more(text, excitation.crossings.len(), ROWS, "report.json")
}
