//! The summary of a study.

use std::fmt::Write;

use crate::analyses::study::{
    GapStatistics, Group, NumberStatistics, Passing, SpeedStatistics, StudyReport,
};
use crate::text::{shown, shown_to};

use super::{WIDTH, decimals_or, each, named, shortened};

/// Largest number of rows of the table of a grid; further rows are counted.
const ROWS: usize = 24;
/// Largest number of quantiles in a row; the report contains all.
const COLUMNS: usize = 7;

pub fn of_report(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    header(text, report)?;
    quantiles(text, report)?;
    if let (Some(gap), Some(asked)) = (&report.all.gap, &report.study.gap)
        && let (Some(within), Some(limit)) = (gap.saws_within, asked.max_deviation_mm)
    {
        writeln!(
            text,
            "\n{within} of {} saws deflect by at most {} mm at the cut under {} N",
            report.all.saws,
            shown_to(3, limit),
            shown_to(3, report.scene.side_force_n())
        )?;
    }
    if let Some(passing) = &report.all.passing {
        limits(text, passing, report.all.saws)?;
    }
    reliability(text, report)?;
    if !report.groups.is_empty() {
        groups(text, report)?;
    }
    worst(text, report)?;
    remarks(text, report)
}

fn header(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    writeln!(text, "{}", shortened(&report.study.name, WIDTH))?;
    let saws = format!("{} saws of {}", report.all.saws, report.scene.name);
    named(text, &saws, &report.condition)?;
    for entry in &report.study.parameters {
        writeln!(text, "  {}", shortened(&entry.to_string(), WIDTH - 2))?;
    }
    each(text, "Unusual number", &report.unusual_numbers)
}

/// Writes the quantiles of the lowest critical speed and of the flutter speed.
fn quantiles(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    let all = &report.all;
    let columns = all.lowest_critical.quantiles.iter().take(COLUMNS);
    write!(text, "\nShare of saws below   ")?;
    for quantile in columns {
        write!(
            text,
            "{:>8}",
            format!("{} %", shown(100.0 * quantile.share))
        )?;
    }
    let speeds = [
        ("lowest critical [rpm]", &all.lowest_critical),
        ("flutter speed [rpm]", &all.flutter),
    ];
    for (name, speed) in speeds {
        write!(text, "\n  {name:<21}")?;
        for quantile in speed.quantiles.iter().take(COLUMNS) {
            write!(text, "{:>8}", decimals_or("beyond", 1, quantile.rpm))?;
        }
    }
    if let Some(gap) = &all.gap {
        numbers(text, gap)?;
    }
    writeln!(text)?;
    match (all.flutter.beyond, report.swept_to_rpm) {
        (0, _) => Ok(()),
        (beyond, to) => writeln!(text, "  {beyond} saws do not flutter up to {to:.0} rpm"),
    }
}

/// Writes the quantiles of deflection, pad force and critical speed of guides with a gap.
fn numbers(text: &mut String, gap: &GapStatistics) -> std::fmt::Result {
    let mut row = |name: &str, factor: f64, entry: &NumberStatistics| -> std::fmt::Result {
        write!(text, "\n  {name:<21}")?;
        for quantile in entry.quantiles.iter().take(COLUMNS) {
            let cell = quantile
                .value
                .map_or("unknown".into(), |value| shown_to(4, factor * value));
            write!(text, "{cell:>8}")?;
        }
        Ok(())
    };
    row("deflection [mm]", 1e3, &gap.deflection_at_cut)?;
    row("largest pad force [N]", 1.0, &gap.largest_pad_force)?;
    if let Some(critical) = &gap.critical_at_amplitude {
        row("at amplitude [rpm]", 1.0, critical)?;
    }
    Ok(())
}

/// Writes the probability that a saw keeps all limits, and the share that keeps each.
fn limits(text: &mut String, passing: &Passing, saws: usize) -> std::fmt::Result {
    let Passing { passed, .. } = passing;
    writeln!(
        text,
        "\nProbability of passing: {:.2} %  ({passed} of {saws} saws)",
        100.0 * passing.probability
    )?;
    if let Some([low, high]) = passing.interval {
        writeln!(
            text,
            "  with {} % confidence between {:.2} % and {:.2} %",
            shown(100.0 * passing.confidence),
            100.0 * low,
            100.0 * high
        )?;
    }
    for criterion in &passing.criteria {
        let share = 100.0 * criterion.passed as f64 / saws.max(1) as f64;
        writeln!(text, "  {share:>6.2} % pass: {}", criterion.name)?;
    }
    Ok(())
}

/// Writes the highest operating speeds at which given shares of the saws run without instability.
fn reliability(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    let Some(reliability) = &report.reliability else {
        return Ok(());
    };
    write!(text, "\nShare of saws that run")?;
    for fastest in &reliability.fastest {
        write!(text, "{:>8}", format!("{} %", shown(100.0 * fastest.share)))?;
    }
    write!(text, "\n  up to [rpm]          ")?;
    for fastest in &reliability.fastest {
        write!(text, "{:>8}", decimals_or("–", 1, fastest.rpm))?;
    }
    writeln!(
        text,
        "\n  (at most {} of the lowest critical speed, and no flutter up to there)",
        shown_to(6, reliability.margin)
    )
}

/// Writes the saws with the lowest critical speed and with the lowest flutter speed.
fn worst(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    let speeds = [
        ("first critical", &report.worst_lowest_critical),
        ("flutter", &report.worst_flutter),
    ];
    for (name, saws) in speeds {
        let Some(first) = saws.first() else {
            continue;
        };
        writeln!(
            text,
            "\nLowest {name} speed: {:.1} rpm, saw {}",
            first.rpm, first.saw
        )?;
        for (parameter, value) in report.study.parameters.iter().zip(&first.values) {
            let line = format!("{} = {value}", parameter.path);
            writeln!(text, "  {}", shortened(&line, WIDTH - 2))?;
        }
    }
    Ok(())
}

fn groups(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    writeln!(text, "\nIn each point of the grid: medians [rpm]")?;
    writeln!(text, "  critical  flutter   pass")?;
    let median = |speed: &SpeedStatistics| decimals_or("beyond", 1, speed.median_rpm);
    let pass = |group: &Group| {
        let passing = group.passing.as_ref();
        passing.map_or("–".into(), |p| format!("{:.1} %", 100.0 * p.probability))
    };
    for group in report.groups.iter().take(ROWS) {
        let place: Vec<String> = group
            .grid
            .iter()
            .map(|entry| format!("{} = {}", entry.parameter, entry.value))
            .collect();
        writeln!(
            text,
            "  {:>8} {:>8} {:>6}  {}",
            median(&group.lowest_critical),
            median(&group.flutter),
            pass(group),
            shortened(&place.join(", "), WIDTH - 28)
        )?;
    }
    if report.groups.len() > ROWS {
        writeln!(
            text,
            "  and {} more in study.json",
            report.groups.len() - ROWS
        )?;
    }
    Ok(())
}

/// Writes the largest estimated error of the saws, and the number of saws whose Krein index does not match.
pub(super) fn accuracy_of_saws(
    text: &mut String,
    largest_error: f64,
    wrong: usize,
    which: &str,
) -> std::fmt::Result {
    writeln!(
        text,
        "\nEstimated error of critical speeds: {} % at most",
        shown_to(2, 100.0 * largest_error)
    )?;
    match wrong {
        0 => Ok(()),
        wrong => writeln!(
            text,
            "The Krein index does not match in {wrong} saws{which}"
        ),
    }
}

fn remarks(text: &mut String, report: &StudyReport) -> std::fmt::Result {
    let all = &report.all;
    let (error, wrong) = (
        report.largest_estimated_relative_error,
        report.saws_with_krein_violations,
    );
    accuracy_of_saws(text, error, wrong, ": column krein_violations of study.csv")?;
    if !report.processors.is_empty() {
        writeln!(
            text,
            "Computed by processors of several kinds, whose last digits may differ:"
        )?;
        for name in &report.processors {
            writeln!(text, "  {}", shortened(name, WIDTH - 2))?;
        }
    }
    for (count, word) in [(all.refused, "refused"), (all.failed, "failed")] {
        if count > 0 {
            writeln!(text, "{count} saws were {word} and count as not passing:")?;
        }
    }
    for refusal in report.not_analysed.iter().take(3) {
        let reason = shortened(&refusal.reason, WIDTH - 12);
        writeln!(text, "  saw {}: {reason}", refusal.saw)?;
    }
    Ok(())
}
