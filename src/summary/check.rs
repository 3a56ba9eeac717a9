//! The summary of a check.

use super::{each, heading, sentence};
use crate::analyses::check::{CheckReport, Criterion};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &CheckReport) -> std::fmt::Result {
    heading(text, &report.scene.name, &report.condition, &[])?;
    sentence(text, &verdict(report))?;
    for number in &report.unusual_numbers {
        let line = match report.accept_unusual {
            true => format!("Unusual number, accepted: {number}"),
            false => format!(
                "FAIL unusual number: {number}. Correct it, or accept it by --accept-unusual"
            ),
        };
        sentence(text, &line)?;
    }
    for Criterion {
        name,
        finding,
        passed,
        ..
    } in &report.criteria
    {
        let word = if *passed { "PASS" } else { "FAIL" };
        sentence(text, &format!("{word} {name}: {finding}"))?;
    }
    sentence(text, &report.rim_stiffness_in_words())?;
    each(text, "Warning", &report.warnings)
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
