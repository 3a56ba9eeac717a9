//! The text of a report for a decision.

use super::{Change, DecisiveSpeed, DesignReport, LoadedPad};
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::{Report, answer, checks};
use crate::analyses::{gap, response, size};
use crate::model::scene::{ForceCause, Quantity};
use crate::page::outline::{Column, FORCE, Fact, Outline, SPEED, Table, Value};
use crate::page::text::{shown, shown_to};

pub fn outline(report: &DesignReport) -> Outline {
    let mut text = Outline::default();
    let addressed = [&report.customer, &report.date];
    let words: Vec<&str> = addressed
        .into_iter()
        .flatten()
        .map(String::as_str)
        .collect();
    if !words.is_empty() {
        text.sentence(words.join(", "));
    }
    text.remarks("Unusual number", &report.unusual_numbers);
    for analysis in conditions(report) {
        text.heading(&report.scene.name, &analysis.condition);
        text.extend(answer(analysis));
    }
    let sawing = response::verdict(&report.response);
    if deviations(report).all(|deviation| deviation.in_words() != sawing) {
        text.sentence(sawing);
    }
    text.extend(windows(report));
    text.table(speeds(report));
    if let Some(other) = &report.other_clamp {
        text.sentence(other.in_words());
    }
    if let Some(sized) = &report.thickness {
        text.sentence(size::headline(sized));
    }
    text.table(changes(report));
    text.extend(pads(report));
    if let Some(gap) = &report.gap {
        text.extend(gap::answer(gap));
        text.extend(gap::wear(gap));
    }
    for analysis in conditions(report) {
        if report.in_cut.is_some() {
            text.sentence(format!("Accuracy, {}:", analysis.condition));
        }
        checks(&mut text, analysis);
    }
    text.extend(assumed(report));
    text.remarks("Warning", &report.warnings);
    text
}

/// All speeds at which the saw keeps its limits, and what was not judged.
fn windows(report: &DesignReport) -> Outline {
    let mut text = Outline::default();
    if let [_, _, ..] = report.verdict.windows_rpm.as_slice() {
        let all = report.verdict.windows_rpm.iter();
        let all: Vec<String> = all
            .map(|[from, to]| format!("{from:.0} to {to:.0}"))
            .collect();
        text.sentence(format!("It can run at {} rpm", all.join(", ")));
    }
    if report.scene.cut.is_none() {
        text.sentence("In the cut: not judged, the scene has no cut");
    }
    text
}

/// The forces of linear pads under the side force.
fn pads(report: &DesignReport) -> Outline {
    let mut text = Outline::default();
    if let Some(LoadedPad {
        rpm, side_force_n, ..
    }) = report.pads.first()
    {
        let force = |pad: &LoadedPad| FORCE.digits(3, pad.force_n);
        let each = report
            .pads
            .iter()
            .map(|pad| Fact::new(format!("guides[{}]", pad.guide), force(pad)));
        let title = format!(
            "Forces on the pads under {} N at the cut at {rpm:.0} rpm",
            shown_to(3, *side_force_n)
        );
        text.facts(title, each.collect::<Vec<_>>());
    }
    text
}

/// What the program took where the scene says nothing.
fn assumed(report: &DesignReport) -> Outline {
    let scene = &report.scene;
    let is_assumed = report.response.constant_force_cause == Some(ForceCause::Assumed);
    let parts = [
        is_assumed.then(|| {
            format!(
                "a side force of {} N (side_force.force_n)",
                shown(report.response.constant_force_n)
            )
        }),
        scene.sweep.is_none().then(|| {
            format!(
                "speeds up to {:.0} rpm (sweep)",
                report.idling.campbell.to_rpm
            )
        }),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let mut text = Outline::default();
    if !parts.is_empty() {
        text.sentence(format!("Assumed, not in the scene: {}", parts.join(", ")));
    }
    text
}

/// The deviations of the board in the answers.
fn deviations(report: &DesignReport) -> impl Iterator<Item = &BoardDeviation> {
    conditions(report).filter_map(|report| report.operating.as_ref()?.deviation.as_ref())
}

fn conditions(report: &DesignReport) -> impl Iterator<Item = &Report> {
    [&report.idling].into_iter().chain(&report.in_cut)
}

/// The speeds that decide, their distance from the operating speed, and what tolerances take of it.
fn speeds(report: &DesignReport) -> Table {
    let columns = [
        Column::words("speed"),
        Column::words("condition"),
        Column::of("value", &SPEED),
        Column::of("above operating", &SPEED),
        Column::of("tolerances", &SPEED),
    ];
    let rows = report.speeds.iter().map(|decisive: &DecisiveSpeed| {
        let condition = decisive.condition.split(" at ").next().unwrap_or_default();
        [
            decisive.speed.name().into(),
            condition.into(),
            SPEED.fixed(0, decisive.rpm),
            decisive
                .margin_rpm
                // Adding zero makes −0 a 0.
                .map_or(Value::Missing, |rpm| {
                    format!("{:+.0}", rpm.round() + 0.0).into()
                }),
            decisive
                .tolerance_rpm
                .map_or(Value::Missing, |rpm| format!("± {rpm:.0}").into()),
        ]
    });
    Table::new(
        "Margins, and what usual tolerances of production take of them",
        columns,
    )
    .with_rows(rows)
}

/// The changes that raise the deciding speed most.
fn changes(report: &DesignReport) -> Table {
    let columns = [
        Column::words("number"),
        Column::words("from"),
        Column::words("to"),
        Column::of("critical", &SPEED),
        Column::of("flutter", &SPEED),
    ];
    let rows = report.changes.iter().map(|change: &Change| {
        let unit = Quantity::of(&change.path).map_or("", |quantity| quantity.unit);
        let value =
            |number: f64| Value::from(format!("{} {unit}", shown(number)).trim_end().to_owned());
        [
            change.path.clone().into(),
            value(change.from),
            value(change.to),
            SPEED.fixed(0, change.first_critical_rpm),
            SPEED.fixed(0, change.flutter_rpm),
        ]
    });
    let title = format!("Changes that raise the {} most", report.raised.name());
    Table::new(title, columns).with_rows(rows)
}
