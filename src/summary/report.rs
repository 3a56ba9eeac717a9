//! The summary of a Campbell diagram.

use std::fmt::Write;

use super::amplitudes::amplitudes;
use super::answer::{answer, trust};
use super::bands::bands;
use super::excitation::crossings;
use super::in_cut::in_cut;
use super::influences::{heat, rolled, sensitivity, straight_edge};
use super::whirl::whirl;
use super::{ROWS, each, is_damped, more, named, numbered};
use crate::report::{Report, RestMode};
use crate::scene::BladeFile;
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &Report) -> std::fmt::Result {
    header(text, report)?;
    each(text, "Unusual number", &report.unusual_numbers)?;
    writeln!(text)?;
    for line in answer(report) {
        writeln!(text, "{line}")?;
    }
    in_cut(text, report)?;
    modes(text, report)?;
    critical_speeds(text, report)?;
    bands(text, report)?;
    amplitudes(text, report)?;
    crossings(text, report)?;
    rolled(text, report)?;
    straight_edge(text, report)?;
    heat(text, report)?;
    sensitivity(text, report)?;
    whirl(text, report)?;
    trust(text, report)
}

/// Writes name and size of the saw, and the range of speeds.
fn header(text: &mut String, report: &Report) -> std::fmt::Result {
    let blade = &report.scene.blade;
    named(text, &report.scene.name, &report.condition)?;
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

/// The thickness in millimetres, or its smallest and largest value.
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
    match is_damped(report) {
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
    match report.overdamped_modes_at_rest {
        0 => Ok(()),
        1 => writeln!(text, "  1 other decays without oscillating (overdamped)"),
        many => writeln!(
            text,
            "  {many} others decay without oscillating (overdamped)"
        ),
    }
}

/// Damping ratio in percent and logarithmic decrement; empty without damping.
fn damping(mode: &RestMode) -> String {
    let Some(ratio) = mode.damping_ratio else {
        return String::new();
    };
    let decrement = mode.logarithmic_decrement;
    let decrement = decrement.map_or("-".to_owned(), |d| shown_to(3, d));
    format!("{:>8} {decrement:>8}  ", shown_to(3, 100.0 * ratio))
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
    match report.critical_speeds_without_damping {
        true => writeln!(
            text,
            "\nCritical speeds of the saw without its damping [rpm]"
        )?,
        false => writeln!(text, "\nCritical speeds [rpm]")?,
    }
    for critical in speeds.iter().take(ROWS) {
        let branch = critical
            .branch
            .map_or(String::new(), |number| format!("  (branch {number})"));
        writeln!(text, "  {:>9.1}  {}{branch}", critical.rpm, critical.name)?;
    }
    more(text, speeds.len(), ROWS, "report.json")
}
