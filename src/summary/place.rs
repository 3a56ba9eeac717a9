//! The summary of a placement.

use std::fmt::Write;

use super::{decimals_or, each, heading, sentence};
use crate::analyses::place::{
    FragileOptimum, Goal, Neighbour, Outcome, PlaceReport, PlacedParameter,
};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &PlaceReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    let goal = match report.goal {
        Goal::FlutterSpeed => "flutter speed",
        Goal::StableWindow => "stable window",
    };
    if let Some(amplitude) = report.amplitude_m {
        let line = format!(
            "Speeds with the mean stiffness of the guides over an oscillation of {} mm at them",
            shown_to(3, 1e3 * amplitude)
        );
        sentence(text, &line)?;
    }
    writeln!(text, "\n{:<30} {:>10} {:>10}", "", "before", "best")?;
    let mut line = |name: &str, before: Option<f64>, best: Option<f64>| {
        let [before, best] = [before, best].map(|rpm| decimals_or("none", 0, rpm));
        writeln!(text, "{name:<30} {before:>10} {best:>10}")
    };
    let mut both = |name: &str, of: fn(&Outcome) -> Option<f64>| {
        line(name, of(&report.before), of(&report.best))
    };
    both("flutter speed [rpm]", |o| o.flutter_rpm)?;
    both("lowest critical speed [rpm]", |o| o.critical_rpm)?;
    if report.goal == Goal::StableWindow {
        both("stable from [rpm]", |o| o.window_rpm.map(|w| w[0]))?;
        both("stable to [rpm]", |o| o.window_rpm.map(|w| w[1]))?;
    }
    let worst = |saw: Option<&Neighbour>| {
        let outcome = saw?.outcome?;
        match report.goal {
            Goal::FlutterSpeed => outcome.flutter_rpm,
            Goal::StableWindow => Some(outcome.goal_rpm),
        }
    };
    line(
        &format!("worst {goal} [rpm]"),
        worst(Some(&report.worst_before)),
        worst(report.worst_neighbour.as_ref()),
    )?;
    if report.max_deflection_m.is_some() {
        let mm = |saw: &Outcome| {
            let found = saw.deflection_m.map(|m| shown_to(4, 1e3 * m));
            found.unwrap_or_else(|| "unknown".to_owned())
        };
        let (before, best) = (mm(&report.before), mm(&report.best));
        writeln!(
            text,
            "{:<30} {before:>10} {best:>10}",
            "deflection at the cut [mm]"
        )?;
    }
    for p in &report.parameters {
        let [before, best, from, to] = [p.start, p.value, p.bound_from, p.bound_to].map(short);
        let bound = if p.at_bound { ", at bound" } else { "" };
        let path = &p.path;
        writeln!(
            text,
            "{path:<30} {before:>10} {best:>10}  {from} to {to}{bound}"
        )?;
    }
    neighbours(text, report, goal)?;
    if let Some(fragile) = &report.fragile_optimum {
        sentence(text, &fragile_optimum(report, fragile, goal))?;
    }
    for band in &report.almost {
        let line = format!(
            "A band from {:.0} rpm on grows by {:.2} 1/s, the threshold is {} 1/s: if the growth reached it, this would be the flutter speed",
            band.from_rpm, band.peak_growth_per_s, report.flutter_threshold_per_s
        );
        sentence(text, &line)?;
    }
    let certificate = &report.certificate.statement;
    sentence(text, &format!("Certificate of the best saw: {certificate}"))?;
    each(text, "Note", &report.warnings)?;
    writeln!(
        text,
        "{} saws analysed, {:.0} to {:.0} rpm",
        report.saws, report.from_rpm, report.to_rpm
    )
}

/// Writes the goal with each number changed by its tolerance, and the worst case of the tolerances.
fn neighbours(text: &mut String, report: &PlaceReport, goal: &str) -> std::fmt::Result {
    writeln!(
        text,
        "\nWith one number changed by its tolerance the {goal} is [rpm]"
    )?;
    for p in &report.parameters {
        let PlacedParameter {
            less_rpm, more_rpm, ..
        } = p;
        writeln!(
            text,
            "  {:<30} -{:<7} {:>10}   +{:<7} {:>10}",
            p.path,
            short(p.offset),
            decimals_or("no saw", 0, *less_rpm),
            short(p.offset),
            decimals_or("no saw", 0, *more_rpm)
        )?;
    }
    let verdict = if report.fragile { "FRAGILE" } else { "robust" };
    let share = 100.0 * report.worst_neighbour_share;
    let line = format!(
        "In the worst case of its tolerances, of single numbers and of all together, the best saw has {share:.0} % of its {goal}: {verdict}"
    );
    sentence(text, &line)
}

/// Describes the saw that is better than the best at its nominal numbers and worse in the worst case of the
/// tolerances.
fn fragile_optimum(report: &PlaceReport, fragile: &FragileOptimum, goal: &str) -> String {
    let rpm = |saw: &Neighbour| {
        let goal = saw.outcome.map(|outcome| outcome.goal_rpm);
        goal.map_or("unknown".to_owned(), |rpm| format!("{rpm:.0} rpm"))
    };
    let numbers = report.parameters.iter().zip(&fragile.saw.values);
    let numbers = numbers.map(|(p, value)| format!("{} = {}", p.path, short(*value)));
    let place = numbers.collect::<Vec<_>>().join(", ");
    let (itself, worst) = (rpm(&fragile.saw), rpm(&fragile.worst));
    format!(
        "Not the answer: {place} has a {goal} of {itself}, which falls to {worst} within the tolerances"
    )
}

/// A placed number with four significant digits.
fn short(value: f64) -> String {
    shown_to(4, value)
}
