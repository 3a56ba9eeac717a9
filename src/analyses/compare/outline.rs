//! The text of a comparison.

use super::{CompareReport, ComparedSaw};
use crate::page::outline::{Column, Outline, SPEED, Table, Value, shortened};
use crate::page::text::fixed;

/// Number of characters of the name of a saw.
const NAME: usize = 22;

pub fn outline(report: &CompareReport) -> Outline {
    let mut text = Outline::of(&report.scene.name, &report.condition(), &[]);
    let columns = [
        Column::words("saw"),
        Column::of("critical", &SPEED),
        Column::of("flutter", &SPEED),
        Column::words("bands"),
        Column::words("rim stiff.").in_unit("N/mm"),
        Column::words(heading(report)),
    ];
    let mut table = Table::new("", columns).showing(usize::MAX);
    for (place, saw) in report.saws.iter().enumerate() {
        table.row(row(place + 1, saw, common_rpm(report).is_some()));
        if let (true, Some(first)) = (place > 0, report.saws.first()) {
            table.row(changes(first, saw));
        }
    }
    text.table(table);
    for saw in &report.saws {
        let operating = saw.operating.as_ref();
        if let Some(deviation) = operating.and_then(|at| at.deviation.as_ref()) {
            text.sentence(format!("{}: {}", saw.name, deviation.in_words()));
        }
    }
    differences(&mut text, report);
    for saw in &report.saws {
        for warning in &saw.warnings {
            text.sentence(format!("{}: {warning}", saw.name));
        }
    }
    text
}

/// The operating speed of all saws, if they have one in common.
fn common_rpm(report: &CompareReport) -> Option<f64> {
    let first = report.saws.first()?.verdict.rpm?;
    let mut others = report.saws.iter();
    let is_common = others.all(|saw| saw.verdict.rpm == Some(first));
    is_common.then_some(first)
}

fn heading(report: &CompareReport) -> String {
    match common_rpm(report) {
        Some(rpm) => format!("at {} rpm", rpm.round()),
        None => "verdict".to_owned(),
    }
}

fn row(number_of_saw: usize, saw: &ComparedSaw, is_common: bool) -> [Value; 6] {
    let verdict = saw.verdict.rpm.map(|rpm| {
        let answer = saw.verdict.in_table();
        if is_common {
            answer
        } else {
            format!("{}: {answer}", rpm.round())
        }
    });
    let stiffness = saw.rim_stiffness_at_rest_n_per_m;
    [
        shortened(&format!("{number_of_saw} {}", saw.name), NAME).into(),
        SPEED.fixed(1, lowest(saw)),
        SPEED.fixed(1, saw.flutter_rpm),
        saw.instabilities.len().into(),
        stiffness.map_or(Value::Missing, |n_per_m| fixed(2, 1e-3 * n_per_m).into()),
        verdict.map_or(Value::Missing, Value::from),
    ]
}

fn lowest(saw: &ComparedSaw) -> Option<f64> {
    saw.critical_speeds.first().map(|critical| critical.rpm)
}

/// Relative differences of the speeds and the stiffness of a saw from those of the first, and the difference of the
/// numbers of bands.
fn changes(first: &ComparedSaw, saw: &ComparedSaw) -> [Value; 6] {
    let percent = |value: fn(&ComparedSaw) -> Option<f64>| {
        let change = value(first)
            .zip(value(saw))
            .map(|(from, to)| to / from - 1.0);
        change.map_or("".into(), |change| {
            Value::from(format!("{:+.1} %", 1e2 * change))
        })
    };
    let bands = saw.instabilities.len() as i64 - first.instabilities.len() as i64;
    [
        "".into(),
        percent(lowest),
        percent(|saw| saw.flutter_rpm),
        format!("{bands:+}").into(),
        percent(|saw| saw.rim_stiffness_at_rest_n_per_m),
        "".into(),
    ]
}

fn differences(text: &mut Outline, report: &CompareReport) {
    if report.differences.is_empty() {
        return text.sentence("The scenes have the same numbers.");
    }
    let columns = [Column::words("key"), Column::words("values")];
    let rows = report.differences.iter().map(|entry| {
        let values = entry
            .values
            .iter()
            .map(|value| match value.as_str() {
                "" => "none",
                value => value,
            })
            .collect::<Vec<_>>()
            .join(" | ");
        [entry.path.clone().into(), values.into()]
    });
    let table = Table::new("Differences of the scenes", columns).in_file("compare.json");
    text.table(table.with_rows(rows));
}
