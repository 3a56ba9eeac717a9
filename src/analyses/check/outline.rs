//! The text of a check.

use super::{CheckReport, Criterion};
use crate::analyses::campbell::side_force_in_words;
use crate::page::outline::Outline;
use crate::page::text::shown_to;

pub fn outline(report: &CheckReport) -> Outline {
    let mut text = Outline::of(&report.scene.name, &report.condition, &[]);
    text.headline(verdict(report));
    for number in &report.unusual_numbers {
        text.sentence(if report.accept_unusual {
            format!("Unusual number, accepted: {number}")
        } else {
            format!("FAIL unusual number: {number}. Correct it, or accept it by --accept-unusual")
        });
    }
    for Criterion {
        name,
        finding,
        passed,
        ..
    } in &report.criteria
    {
        let word = if *passed { "PASS" } else { "FAIL" };
        text.sentence(format!("{word} {name}: {finding}"));
    }
    text.sentence(report.rim_stiffness_in_words());
    if let Some(words) = side_force_in_words(
        report.operating_rpm,
        report.side_force_factor,
        &report.scene,
    ) {
        text.sentence(words);
    }
    if let Some(deviation) = &report.deviation {
        text.sentence(deviation.in_words());
    }
    text.remarks("Warning", &report.warnings);
    text
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
    let numbers = if report.unusual_numbers.is_empty() || report.accept_unusual {
        ""
    } else {
        ", with numbers that no saw has"
    };
    format!("FAILED {speed}: {limits}{numbers}")
}
