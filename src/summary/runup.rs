//! The summary of a run-up.

use std::fmt::Write;

use super::{each, heading, sentence};
use crate::analyses::runup::RunUpReport;
use crate::stretched::LARGEST_SLOPE;
use crate::transient::LINEAR_THICKNESSES;

pub fn of_report(text: &mut String, report: &RunUpReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    sentence(text, &verdict(report))?;
    if report.bands.is_empty() {
        writeln!(
            text,
            "No instability: nothing grows at any speed of the run-up"
        )?;
    } else {
        sentence(text, &first_doubling(report))?;
        bands(text, report)?;
    }
    each(text, "Warning", &report.warnings)
}

/// Speed up to which the model is valid, and the largest deflection at the probe.
fn verdict(report: &RunUpReport) -> String {
    let stretched = report.stretching.as_ref();
    let end = match (report.linear_until_rpm, stretched) {
        (None, Some(found)) => match found.valid_until_rpm {
            None => format!(
                "with stretching, slopes of the blade of {:.3} at most",
                found.largest_slope
            ),
            Some(rpm) => format!(
                "with stretching, valid up to about {:.0} rpm, where slopes of the blade exceed {LARGEST_SLOPE} and the model ends",
                10.0 * (0.1 * rpm).round()
            ),
        },
        (None, None) => "within the linear model".to_owned(),
        (Some(rpm), _) => format!(
            "valid up to about {:.0} rpm, where the deflection at the probe exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm) and the linear model ends",
            10.0 * (0.1 * rpm).round(),
            1e3 * report.linear_limit_m
        ),
    };
    format!(
        "Run-up from {:.0} to {:.0} rpm at {:.1} rpm/s: {end}; largest deflection {:.2} mm, at {:.0} rpm",
        report.from_rpm,
        report.to_rpm,
        report.rate_rpm_per_s,
        1e3 * report.largest_deflection_m,
        report.largest_deflection_rpm
    )
}

fn first_doubling(report: &RunUpReport) -> String {
    match report.first_doubling_rpm {
        Some(rpm) => {
            format!("First band that more than doubles a motion at this rate: {rpm:.0} rpm")
        }
        None => "No band more than doubles a motion at this rate".to_owned(),
    }
}

/// Writes for each band the time spent in it, the exponent, and predicted and computed amplification.
fn bands(text: &mut String, report: &RunUpReport) -> std::fmt::Result {
    writeln!(
        text,
        "\nInstabilities        from         to     time  exponent    grows by  deflection"
    )?;
    writeln!(
        text,
        "                    [rpm]      [rpm]      [s]  ∫Re λ dt  e^exponent   in/before"
    )?;
    for entry in &report.bands {
        writeln!(
            text,
            "  {:<12} {:>10.1} {:>10.1} {:>8.2} {:>9.3} {:>11} {:>11}",
            entry.band.kind,
            entry.band.from_rpm,
            entry.band.to_rpm,
            entry.time_s,
            entry.growth_exponent,
            times(entry.growth_exponent.exp()),
            entry.seen_amplification.map_or("-".into(), times)
        )?;
    }
    let meaning = "in/before: largest deflection at the probe in the band over that in as many rpm before it. All modes contribute: with a small exponent it shows beating, not growth.";
    sentence(text, meaning)
}

/// Amplifications above this factor are not distinguished: motions of practical size then exceed the linear
/// model.
const MOST_TIMES: f64 = 1e3;

fn times(factor: f64) -> String {
    match factor <= MOST_TIMES {
        true => format!("{factor:.2} x"),
        false => format!("> {MOST_TIMES:.0} x"),
    }
}
