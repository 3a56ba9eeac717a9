//! The summary of a map.

use std::fmt::Write;

use super::study::accuracy_of_saws;
use super::{ROWS, decimals_or, each, more, named, sentence, shortened};
use crate::analyses::map::{MapAxis, MapReport, MappedSaw};
use crate::stability::{CRITICAL_MARGIN, StabilityState};
use crate::text::{shown, shown_to};

/// A function that returns a speed of a saw in rpm; `None` if the saw has no such speed in the sweep.
type Speed = fn(&MappedSaw) -> Option<f64>;

pub fn of_report(text: &mut String, report: &MapReport) -> std::fmt::Result {
    each(text, "Unusual number", &report.unusual_numbers)?;
    sentence(text, &verdict(report))?;
    speeds(text, report)?;
    let saws = format!("{} saws of {}", report.saws.len(), report.scene.name);
    writeln!(text)?;
    named(text, &saws, &report.condition)?;
    for axis in std::iter::once(&report.x).chain(&report.y) {
        sentence(text, &format!("  {}", range(axis)))?;
    }
    if report.y.is_none() {
        table(text, report)?;
    }
    let (error, wrong) = (
        report.largest_estimated_relative_error,
        report.saws_with_krein_violations,
    );
    accuracy_of_saws(text, error, wrong, "")?;
    each(text, "Warning", &report.warnings)
}

/// Key and name of a number, its range, and its value in the scene.
fn range(axis: &MapAxis) -> String {
    let ends = [axis.values.first(), axis.values.last()].map(|end| end.copied().unwrap_or(0.0));
    let [from, to] = ends.map(|value| shown_to(6, value));
    let unit = match axis.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    format!(
        "{} ({}) from {from} to {to}{unit}; the scene has {}{unit}",
        axis.path,
        axis.name,
        shown(axis.of_scene)
    )
}

fn verdict(report: &MapReport) -> String {
    let Some(rpm) = report.rpm else {
        return "No saw is judged: the scene has no operating_rpm, and no speed was given (--rpm)"
            .to_owned();
    };
    let count = |state: StabilityState| {
        let saws = report.saws.iter();
        saws.filter(|saw| saw.state == Some(state)).count()
    };
    let judged = report.saws.iter().filter(|saw| saw.state.is_some()).count();
    let critical = report
        .saws
        .iter()
        .filter(|saw| saw.state == Some(StabilityState::Stable) && saw.at_critical_rpm.is_some());
    let critical = match critical.count() {
        0 => String::new(),
        count => format!(
            " ({count} of them within {:.0} % of a critical speed)",
            100.0 * CRITICAL_MARGIN
        ),
    };
    let [stable, divergence, flutter] = [
        StabilityState::Stable,
        StabilityState::Divergence,
        StabilityState::Flutter,
    ]
    .map(count);
    format!(
        "At {rpm:.0} rpm {stable} of {judged} saws are stable{critical}, {divergence} diverge, {flutter} flutter"
    )
}

/// Writes the saws with the lowest and the highest flutter speed and critical speed.
fn speeds(text: &mut String, report: &MapReport) -> std::fmt::Result {
    let kinds: [(&str, Speed); 2] = [
        ("Flutter speed", |saw| saw.flutter_speed_rpm),
        ("Lowest critical speed", |saw| saw.lowest_critical_rpm),
    ];
    for (name, of) in kinds {
        let known = report.saws.iter().filter_map(|saw| Some((of(saw)?, saw)));
        let by_speed = |a: &(f64, &MappedSaw), b: &(f64, &MappedSaw)| a.0.total_cmp(&b.0);
        let ends = known.clone().min_by(by_speed).zip(known.max_by(by_speed));
        let Some((low, high)) = ends else {
            let to = report.to_rpm;
            writeln!(text, "{name}: none up to {to:.0} rpm")?;
            continue;
        };
        let place = |saw: &MappedSaw| {
            let y = report.y.as_ref().zip(saw.y);
            let all = std::iter::once((&report.x, saw.x)).chain(y);
            let all = all.map(|(axis, value)| {
                let unit = axis.unit.as_str();
                let key = axis.path.rsplit('.').next().unwrap_or(&axis.path);
                format!("{key} = {} {unit}", shown_to(5, value))
                    .trim_end()
                    .to_owned()
            });
            all.collect::<Vec<_>>().join(", ")
        };
        let line = format!(
            "{name}: {:.1} rpm ({}) to {:.1} rpm ({})",
            low.0,
            place(low.1),
            high.0,
            place(high.1)
        );
        sentence(text, &line)?;
    }
    let beyond = report
        .saws
        .iter()
        .filter(|saw| saw.flutter_speed_rpm.is_none() && saw.not_analysed.is_none());
    match beyond.count() {
        0 => Ok(()),
        count => writeln!(
            text,
            "  {count} saws do not flutter up to {:.0} rpm",
            report.to_rpm
        ),
    }
}

/// Writes a table of at most [`ROWS`] evenly spaced saws, with the first and the last.
fn table(text: &mut String, report: &MapReport) -> std::fmt::Result {
    let key = report.x.path.rsplit('.').next().unwrap_or(&report.x.path);
    writeln!(
        text,
        "\n  {:<24} critical   flutter   bands   state",
        shortened(key, 24)
    )?;
    let last = report.saws.len().saturating_sub(1);
    let rows = ROWS.min(report.saws.len());
    let shown_rows = (0..rows).map(|k| k * last / rows.saturating_sub(1).max(1));
    for saw in shown_rows.filter_map(|k| report.saws.get(k)) {
        let state = match saw.state {
            _ if saw.not_analysed.is_some() => "not analysed",
            None => "–",
            Some(StabilityState::Stable) if saw.at_critical_rpm.is_some() => "at critical",
            Some(StabilityState::Stable) => "stable",
            Some(StabilityState::Divergence) => "divergence",
            Some(StabilityState::Flutter) => "flutter",
            Some(StabilityState::OutsideSweep) => "outside sweep",
        };
        writeln!(
            text,
            "  {:<24} {:>8} {:>9} {:>7}   {state}",
            shown_to(6, saw.x),
            decimals_or("–", 1, saw.lowest_critical_rpm),
            decimals_or("–", 1, saw.flutter_speed_rpm),
            saw.instabilities.len()
        )?;
    }
    more(text, report.saws.len(), rows, "map.json")
}
