//! The summary of a fit.

use std::fmt::Write;

use super::{each, heading, more, sentence};
use crate::analyses::fit::{FitReport, FittedParameter};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &FitReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    let verdict = format!(
        "Fitted to {} frequencies ({}): {:.3} Hz rms, before {:.3} Hz",
        report.measured_frequencies, report.source, report.rms_hz, report.rms_before_hz
    );
    sentence(text, &verdict)?;
    each(text, "Warning", &report.warnings)?;
    writeln!(
        text,
        "\n  {:<34} {:>10} {:>10}  {:.0} % interval",
        "",
        "before",
        "fitted",
        100.0 * report.confidence
    )?;
    for found in &report.parameters {
        let FittedParameter {
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
    let reached = report.starts.iter().filter_map(|start| start.rms_hz);
    let best = reached.clone().fold(f64::INFINITY, f64::min);
    let same = reached.clone().filter(|rms| *rms <= 1.001 * best);
    writeln!(
        text,
        "{} of {} starts led to this minimum (n up to {}, {} polynomials over the radius)",
        same.count(),
        reached.count(),
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
    more(text, speeds.len(), ROWS, "fit.json")
}

/// A fitted number with five significant digits.
fn short(value: f64) -> String {
    shown_to(5, value)
}
