//! The summary of a comparison.

use std::fmt::Write;

use super::answer::Answer;
use super::{ROWS, decimals_or, heading, more, sentence, shortened, wrapped};
use crate::analyses::compare::{CompareReport, ComparedSaw};

pub fn of_report(text: &mut String, report: &CompareReport) -> std::fmt::Result {
    heading(text, &report.scene.name, &report.condition(), &[])?;
    writeln!(
        text,
        "\n                        critical   flutter  bands   rim stiff.\n\
         saw                        [rpm]     [rpm]          [N/mm]      verdict"
    )?;
    for (place, saw) in report.saws.iter().enumerate() {
        line(text, place + 1, saw)?;
        if let (true, Some(first)) = (place > 0, report.saws.first()) {
            changes(text, first, saw)?;
        }
    }
    differences(text, report)?;
    for saw in &report.saws {
        for warning in &saw.warnings {
            writeln!(text, "\n{}", wrapped(&format!("{}: {warning}", saw.label)))?;
        }
    }
    Ok(())
}

fn line(text: &mut String, number_of_saw: usize, saw: &ComparedSaw) -> std::fmt::Result {
    let stiffness = saw
        .rim_stiffness_at_rest_n_per_m
        .map(|n_per_m| 1e-3 * n_per_m);
    let operating = saw.operating.as_ref();
    let verdict = operating.map_or("-".to_owned(), |operating| {
        format!(
            "{}: {}",
            operating.rpm.round(),
            Answer::new(operating).in_few_words()
        )
    });
    writeln!(
        text,
        "{:<22} {:>9} {:>9} {:>6} {:>9}    {verdict}",
        shortened(&format!("{number_of_saw} {}", saw.label), 22),
        decimals_or("-", 1, lowest(saw)),
        decimals_or("-", 1, saw.flutter_speed_rpm),
        saw.instabilities.len(),
        decimals_or("-", 2, stiffness),
    )
}

fn lowest(saw: &ComparedSaw) -> Option<f64> {
    saw.critical_speeds.first().map(|critical| critical.rpm)
}

/// Writes the relative differences of the speeds and the stiffness of a saw from those of the first, and the
/// difference of the numbers of bands.
fn changes(text: &mut String, first: &ComparedSaw, saw: &ComparedSaw) -> std::fmt::Result {
    let percent = |value: fn(&ComparedSaw) -> Option<f64>| {
        let change = value(first)
            .zip(value(saw))
            .map(|(from, to)| to / from - 1.0);
        change.map_or(String::new(), |change| format!("{:+.1} %", 1e2 * change))
    };
    let bands = saw.instabilities.len() as i64 - first.instabilities.len() as i64;
    let line = format!(
        "{:<22} {:>9} {:>9} {:>+6} {:>9}",
        "",
        percent(lowest),
        percent(|saw| saw.flutter_speed_rpm),
        bands,
        percent(|saw| saw.rim_stiffness_at_rest_n_per_m),
    );
    writeln!(text, "{}", line.trim_end())
}

fn differences(text: &mut String, report: &CompareReport) -> std::fmt::Result {
    if report.differences.is_empty() {
        return writeln!(text, "\nThe scenes have the same numbers.");
    }
    writeln!(text, "\nWhat differs in the scenes")?;
    for entry in report.differences.iter().take(ROWS) {
        let values = entry.values.iter().map(|value| match value.as_str() {
            "" => "none",
            value => value,
        });
        let values = values.collect::<Vec<_>>().join(" | ");
        sentence(text, &format!("  {}: {values}", entry.path))?;
    }
    more(text, report.differences.len(), ROWS, "compare.json")
}
