//! The text of a check.

use super::CheckReport;
use crate::analyses::campbell::side_force_in_words;
use crate::analyses::verdict::{Answer, Criterion};
use crate::page::outline::Outline;

pub fn outline(report: &CheckReport) -> Outline {
    let mut text = Outline::of(&report.scene.name, &report.condition, &[]);
    text.headline(report.verdict.headline());
    for number in &report.unusual_numbers {
        text.sentence(if report.accept_unusual {
            format!("Unusual number, accepted: {number}")
        } else {
            format!("FAIL unusual number: {number}. Correct it, or accept it by --accept-unusual")
        });
    }
    for criterion in &report.verdict.limits {
        let Criterion { name, finding, .. } = criterion;
        let word = in_one_word(criterion);
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

/// The result of a limit in capital letters.
pub fn in_one_word(criterion: &Criterion) -> &'static str {
    match criterion.answer {
        Answer::Yes => "PASS",
        Answer::AtRisk => "RISK",
        Answer::No => "FAIL",
    }
}
