//! The summary of a fit.

use std::fmt::Write;

use super::{unusual_numbers, wrapped};
use crate::report::{FitReport, ParameterEntry};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &FitReport) -> std::fmt::Result {
    writeln!(text, "{}", wrapped(&report.scene.name))?;
    unusual_numbers(text, &report.unusual_numbers)?;
    writeln!(
        text,
        "{}",
        wrapped(&format!(
            "Fitted to {} frequencies ({}): {:.3} Hz rms, before {:.3} Hz",
            report.measured_frequencies, report.source, report.rms_hz, report.rms_before_hz
        ))
    )?;
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    writeln!(
        text,
        "\n  {:<34} {:>10} {:>10}  {:.0} % interval",
        "",
        "before",
        "fitted",
        100.0 * report.confidence
    )?;
    for found in &report.parameters {
        let ParameterEntry {
            path, start, value, ..
        } = found;
        let interval = match (found.interval_from, found.interval_to) {
            (Some(from), Some(to)) => format!("{} … {}", short(from), short(to)),
            _ if found.at_bound => "at its bound".into(),
            _ => "not determined".into(),
        };
        writeln!(
            text,
            "  {path:<34} {:>10} {:>10}  {interval}",
            short(*start),
            short(*value)
        )?;
    }
    residuals(text, report)?;
    writeln!(text)?;
    let reached = |s: &&crate::fit::Start| s.rms_hz.is_some();
    let best = report
        .starts
        .iter()
        .filter_map(|s| s.rms_hz)
        .fold(f64::INFINITY, f64::min);
    let same = report
        .starts
        .iter()
        .filter(|s| s.rms_hz.is_some_and(|rms| rms <= 1.001 * best));
    writeln!(
        text,
        "{} of {} starts led to this minimum (n up to {}, {} polynomials over the radius)",
        same.count(),
        report.starts.iter().filter(reached).count(),
        report.max_diameters,
        report.radial_functions
    )
}

/// Largest number of rows of the table of residuals; further rows are counted.
const ROWS: usize = 20;
/// Largest number of frequencies in a row of this table; the report contains all.
const COLUMNS: usize = 7;

fn residuals(text: &mut String, report: &FitReport) -> std::fmt::Result {
    writeln!(
        text,
        "\nComputed minus measured frequency [Hz]\n     rpm    ascending"
    )?;
    let mut speeds: Vec<f64> = report.residuals.iter().map(|r| r.rpm).collect();
    speeds.dedup();
    for rpm in speeds.iter().take(ROWS) {
        let own = report.residuals.iter().filter(|r| r.rpm == *rpm);
        let mut line = format!("{:>8}", shown_to(6, *rpm));
        let mut fitted = true;
        for r in own {
            if r.place <= COLUMNS {
                let _ = write!(line, " {:>8.2}", r.fitted_hz - r.measured_hz);
            }
            fitted &= r.fitted;
        }
        writeln!(text, "{line}{}", if fitted { "" } else { "  (not fitted)" })?;
    }
    match speeds.len().checked_sub(ROWS) {
        Some(rest) if rest > 0 => writeln!(text, "  … and {rest} more in fit.json"),
        _ => Ok(()),
    }
}

/// A fitted number with five significant digits.
fn short(value: f64) -> String {
    shown_to(5, value)
}
