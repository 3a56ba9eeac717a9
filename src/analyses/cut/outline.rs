//! The text of a cut.

use super::{CutAtSpeed, CutCriterion, CutReport};
use crate::analyses::campbell::Verdict;
use crate::analyses::verdict::Answer;
use crate::page::outline::{Column, FREQUENCY, Fact, GROWTH, LENGTH, Outline, Table, Value};
use crate::page::text::shown_to;

pub fn outline(report: &CutReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    for run in &report.runs {
        text.headline(in_one_line(run));
    }
    for run in &report.runs {
        at_speed(&mut text, run, report.teeth);
    }
    text.remarks("Note", &report.warnings);
    text
}

/// The verdict at a speed.
fn in_one_line(run: &CutAtSpeed) -> String {
    let (rpm, reason) = (run.rpm, &run.verdict.reason);
    let answer = run.verdict.answer.map_or("", Answer::in_words);
    format!(
        "Can it cut at {rpm} rpm? {}: {reason}",
        answer.to_uppercase()
    )
}

fn at_speed(text: &mut Outline, run: &CutAtSpeed, teeth: f64) {
    let forces = format!(
        "{} rpm, on each tooth {} N against the rotation, {} N inwards, {} N across ({} N in all)",
        run.rpm,
        run.tangential_n_per_tooth.round(),
        run.radial_n_per_tooth.round(),
        shown_to(3, run.lateral_n_per_tooth),
        shown_to(3, teeth * run.lateral_n_per_tooth)
    );
    let columns = [
        Column::words("criterion"),
        Column::of("growth", &GROWTH),
        Column::of("frequency", &FREQUENCY),
        Column::words("verdict"),
    ];
    let rows = run.criteria.iter().map(|entry| {
        let verdict = match entry.verdict {
            Verdict::Stable => "stable",
            Verdict::Unstable => "UNSTABLE",
        };
        let remark = remark(run, entry.criterion);
        [
            entry.criterion.to_string().into(),
            GROWTH.fixed(3, entry.growth_per_s),
            FREQUENCY.fixed(2, entry.frequency_hz),
            format!("{verdict}{remark}").into(),
        ]
    });
    text.table(Table::new(forces, columns).with_rows(rows));
    text.facts("", deflections(run));
    text.details(|text| {
        let statement = &run.certificate.statement;
        text.sentence(format!("Certificate at {} rpm: {statement}", run.rpm));
    });
}

/// Remark after the verdict of a criterion.
fn remark(run: &CutAtSpeed, criterion: CutCriterion) -> String {
    match criterion {
        CutCriterion::TimeHistory => match run.agree {
            Some(true) => ", agrees".into(),
            _ => ", DISAGREES".into(),
        },
        CutCriterion::MovingToothLoads => {
            let per_second = run.tooth_passing.tooth_frequency_hz;
            format!(", {per_second:.0} teeth/s")
        }
        CutCriterion::SplineReaction => run.spline.as_ref().map_or(String::new(), |spline| {
            format!(", K_e changes by {:.0} %", 1e2 * spline.stiffness_change)
        }),
        CutCriterion::Eigenvalues | CutCriterion::OutOfCut => String::new(),
    }
}

/// Largest deflections of the rim in the cut and after it.
fn deflections(run: &CutAtSpeed) -> Vec<Fact> {
    let model = match run.stretching {
        Some(_) => "leaves the model with stretching",
        None => "leaves the linear model",
    };
    let at = |when: &str, deflection_m: Option<f64>| -> Fact {
        let name = format!("largest of the rim {when} at {} rpm", run.rpm);
        let unknown: Value = model.into();
        let value = deflection_m.map_or(unknown, |m| LENGTH.fixed(2, m));
        Fact::new(name, value)
    };
    let mut facts = vec![at("in the cut", run.largest_deflection_in_cut_m)];
    if run.largest_deflection_in_cut_m.is_some() {
        facts.push(at("after the cut", run.largest_deflection_after_m));
    }
    let slope = run.stretching.as_ref().map(|found| found.largest_slope);
    facts.extend(slope.map(|slope| Fact::new("largest slope of the blade", format!("{slope:.3}"))));
    facts
}
