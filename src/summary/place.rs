//! A placement in words.

use std::fmt::Write;

use super::wrapped;
use crate::report::{GoalEntry, OutcomeEntry, PlaceReport, PlacedEntry};

impl PlaceReport {
    /// The report in words, 80 columns wide, the verdict first.
    pub fn summary(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = table(&mut text, self);
        text
    }
}

fn table(text: &mut String, report: &PlaceReport) -> std::fmt::Result {
    writeln!(text, "{}", wrapped(&report.scene.name))?;
    let goal = match report.goal {
        GoalEntry::FlutterSpeed => "flutter speed",
        GoalEntry::StableWindow => "stable window",
    };
    writeln!(text, "\n{:<36} {:>12} {:>12}", "", "before", "best")?;
    let number = |rpm: Option<f64>| rpm.map_or("none".to_owned(), |rpm| format!("{rpm:.0}"));
    let mut line = |name: &str, of: fn(&OutcomeEntry) -> Option<f64>| {
        let (before, best) = (number(of(&report.before)), number(of(&report.best)));
        writeln!(text, "{name:<36} {before:>12} {best:>12}")
    };
    line("flutter speed [rpm]", |o| o.flutter_rpm)?;
    line("lowest critical speed [rpm]", |o| o.critical_rpm)?;
    if report.goal == GoalEntry::StableWindow {
        line("stable from [rpm]", |o| o.window_rpm.map(|w| w[0]))?;
        line("stable to [rpm]", |o| o.window_rpm.map(|w| w[1]))?;
    }
    for p in &report.parameters {
        let bound = if p.at_bound { "  at its bound" } else { "" };
        let (before, best) = (short(p.start), short(p.value));
        writeln!(text, "{:<36} {before:>12} {best:>12}{bound}", p.path)?;
    }
    neighbours(text, report, goal)?;
    for band in &report.almost {
        let line = format!(
            "From {:.0} rpm a band grows by {:.2} 1/s, of {} that count: were it to count, this would be the flutter speed",
            band.from_rpm, band.peak_growth_per_s, report.flutter_threshold_per_s
        );
        writeln!(text, "{}", wrapped(&line))?;
    }
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Note: {warning}")))?;
    }
    writeln!(
        text,
        "{} saws analysed, {:.0} to {:.0} rpm",
        report.saws, report.from_rpm, report.to_rpm
    )
}

fn neighbours(text: &mut String, report: &PlaceReport, goal: &str) -> std::fmt::Result {
    writeln!(text, "\nA little off, the {goal} becomes [rpm]")?;
    for p in &report.parameters {
        let PlacedEntry {
            less_rpm, more_rpm, ..
        } = p;
        let side = |rpm: &Option<f64>| rpm.map_or("past bound".into(), |r| format!("{r:.0}"));
        writeln!(
            text,
            "  {:<30} -{:<7} {:>10}   +{:<7} {:>10}",
            p.path,
            short(p.offset),
            side(less_rpm),
            short(p.offset),
            side(more_rpm)
        )?;
    }
    let verdict = if report.fragile { "FRAGILE" } else { "robust" };
    let share = 100.0 * report.worst_neighbour_share;
    writeln!(
        text,
        "The worst of these saws and their corners has {share:.0} % of it: {verdict}"
    )
}

/// A number in nine columns.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.2e}");
    }
    let decimals = (3.0 - size.max(1e-3).log10().floor()).clamp(0.0, 4.0) as usize;
    format!("{value:.decimals$}")
}
