//! The summary of a check.

use std::fmt::Write;

use super::{WIDTH, shortened, wrapped};
use crate::report::{CheckReport, CriterionEntry};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &CheckReport) -> std::fmt::Result {
    writeln!(text, "{}", shortened(&report.scene.name, WIDTH))?;
    writeln!(text, "{}", wrapped(&verdict(report)))?;
    for number in &report.unusual_numbers {
        let line = match report.accept_unusual {
            true => format!("Unusual number, accepted: {number}"),
            false => format!(
                "FAIL unusual number: {number}. Correct it, or accept it by --accept-unusual"
            ),
        };
        writeln!(text, "{}", wrapped(&line))?;
    }
    for criterion in &report.criteria {
        writeln!(text, "{}", wrapped(&row(criterion)))?;
    }
    writeln!(text, "{}", wrapped(&report.rim_stiffness_in_words()))?;
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    Ok(())
}

fn verdict(report: &CheckReport) -> String {
    let speed = format!("at {} rpm", shown_to(6, report.operating_rpm));
    if report.passed {
        return format!("PASSED {speed}");
    }
    let failed = report.criteria.iter().filter(|c| !c.passed).count();
    let limits = match failed {
        0 => "every limit is kept".to_owned(),
        1 => format!("1 of {} limits is not kept", report.criteria.len()),
        _ => format!("{failed} of {} limits are not kept", report.criteria.len()),
    };
    let numbers = match report.unusual_numbers.is_empty() || report.accept_unusual {
        true => "",
        false => ", with numbers that no saw has",
    };
    format!("FAILED {speed}: {limits}{numbers}")
}

fn row(criterion: &CriterionEntry) -> String {
    let CriterionEntry { name, finding, .. } = criterion;
    let word = if criterion.passed { "PASS" } else { "FAIL" };
    format!("{word} {name}: {finding}")
}
