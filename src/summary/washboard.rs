//! The summary of a washboarding analysis.

use std::fmt::Write;

use super::{decimals_or, each, heading, sentence, shortened};
use crate::analyses::washboard::{WashboardMode, WashboardReport};
use crate::report::Verdict;
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &WashboardReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    sentence(text, &verdict(report))?;
    sentence(text, &boundary(report))?;
    let facts = format!(
        "{:.0} teeth pass in a second; {} N/m across the blade, overlap {:.2}, arc of {:.1}°; modes up to {:.0} Hz",
        report.tooth_passing_hz,
        shown_to(4, report.stiffness_n_per_m),
        report.overlap,
        report.arc_deg,
        report.complete_to_hz
    );
    sentence(text, &facts)?;
    modes(text, report)?;
    each(text, "Warning", &report.warnings)
}

fn verdict(report: &WashboardReport) -> String {
    let rpm = report.rpm;
    match (report.verdict, report.growing_mode()) {
        (Verdict::Stable, _) => format!("{rpm} rpm: stable, no washboarding"),
        (Verdict::Unstable, None) => format!("{rpm} rpm: UNSTABLE"),
        (Verdict::Unstable, Some(mode)) => {
            let pattern = mode
                .pattern_pitch_m
                .map(|pitch| format!(", waves of {} along the feed", length(pitch)));
            format!(
                "{rpm} rpm: UNSTABLE, washboarding grows by {:.3} 1/s at {:.1} Hz ({}){}",
                mode.growth_per_s,
                mode.frequency_hz,
                mode.name,
                pattern.unwrap_or_default()
            )
        }
    }
}

/// Smallest cutting stiffness at which a motion grows, and its frequency.
fn boundary(report: &WashboardReport) -> String {
    match (
        report.critical_stiffness_n_per_m,
        report.critical_frequency_hz,
    ) {
        (Some(stiffness), Some(hz)) if stiffness > 0.0 => format!(
            "Smallest cutting stiffness at which a motion grows: {} N/m, at {hz:.1} Hz; the cut has {:.3} times that",
            shown_to(4, stiffness),
            report.stiffness_n_per_m / stiffness
        ),
        (Some(_), _) => "A motion grows without the delayed force".to_owned(),
        (None, _) => format!(
            "No motion grows up to a cutting stiffness of {} N/m",
            shown_to(2, report.ceiling_n_per_m)
        ),
    }
}

fn modes(text: &mut String, report: &WashboardReport) -> std::fmt::Result {
    writeln!(
        text,
        "\nModes             frequency    growth   without  beside teeth    pitch"
    )?;
    writeln!(
        text,
        "                       [Hz]     [1/s]     [1/s]          [Hz]"
    )?;
    for mode in &report.modes {
        writeln!(text, "{}", row(mode))?;
    }
    Ok(())
}

fn row(mode: &WashboardMode) -> String {
    let name = shortened(&mode.name, 16);
    let beside = mode.beside_tooth_passing_hz.map(|hz| {
        let multiple = mode.tooth_passing_multiple.unwrap_or_default();
        format!("{multiple}x {hz:+.1}")
    });
    format!(
        "  {name:<16} {:>8.1} {:>9.3} {:>9} {:>13} {:>8}",
        mode.frequency_hz,
        mode.growth_per_s,
        decimals_or("-", 3, mode.growth_without_per_s),
        beside.unwrap_or("-".into()),
        mode.pattern_pitch_m.map_or("-".into(), length)
    )
    .trim_end()
    .to_owned()
}

/// A length below a metre in millimetres, otherwise in metres.
fn length(metres: f64) -> String {
    match metres < 1.0 {
        true => format!("{:.1} mm", 1e3 * metres),
        false => format!("{metres:.2} m"),
    }
}
