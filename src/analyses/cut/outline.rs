//! The text of a cut.

use super::{CutAtSpeed, CutCriterion, CutReport, CutVerdict};
use crate::analyses::campbell::Verdict;
use crate::analyses::verdict::{Answer, near_critical};
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::motion::transient::LINEAR_THICKNESSES;
use crate::page::outline::{Column, FREQUENCY, Fact, GROWTH, LENGTH, Outline, Table, Value};
use crate::page::text::shown_to;

pub fn outline(report: &CutReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    for run in &report.runs {
        text.headline(in_one_line(run, report.linear_limit_m));
    }
    for run in &report.runs {
        at_speed(&mut text, run, report.teeth);
    }
    text.remarks("Note", &report.warnings);
    text
}

/// The verdict at a speed; `linear_limit_m` is the largest deflection of the linear model.
fn in_one_line(run: &CutAtSpeed, linear_limit_m: f64) -> String {
    let (rpm, critical) = (run.rpm, run.at_critical_rpm);
    let reason = match run.verdict {
        CutVerdict::Stable => match (run.past_critical_rpm, run.largest_deflection_in_cut_m) {
            (Some(critical), _) => format!(
                "no vibration grows, but {:.0} % of the first critical speed ({critical:.0} rpm)",
                100.0 * rpm / critical
            ),
            (None, Some(found_m)) if run.answer == Answer::AtRisk => format!(
                "no vibration grows, but the rim moves {} mm, more than the thickness of the blade",
                shown_to(3, 1e3 * found_m)
            ),
            _ => "no vibration grows".to_owned(),
        },
        CutVerdict::AtCritical => critical.map_or("at a critical speed".to_owned(), near_critical),
        CutVerdict::LeavesModel if run.stretching.is_some() => format!(
            "no vibration grows, but slopes of the blade exceed {LARGEST_SLOPE}, where the model with stretching ends"
        ),
        CutVerdict::LeavesModel => format!(
            "no vibration grows, but the deflection exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm), where the linear model ends, more than any kerf",
            1e3 * linear_limit_m
        ),
        CutVerdict::Unstable => unstable(run),
    };
    let word = run.answer.in_words().to_uppercase();
    format!("Can it cut at {rpm} rpm? {word}: {reason}")
}

/// The verdict on an unstable cut: growth rate, frequency, and the criterion that decides.
fn unstable(run: &CutAtSpeed) -> String {
    let decisive = run.criteria.iter().find(|c| c.criterion == run.decided_by);
    let Some(entry) = decisive else {
        return "a vibration grows".to_owned();
    };
    let frequency = match entry.frequency_hz {
        Some(hz) if hz > 0.0 => format!(" at {hz:.2} Hz"),
        Some(_) => " without oscillation".into(),
        None => String::new(),
    };
    format!(
        "growth of {:.3} 1/s{frequency} ({})",
        entry.growth_per_s, entry.criterion
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
