//! The text of a map.

use std::collections::BTreeSet;

use super::{MapAxis, MapReport, MappedSaw};
use crate::analyses::study::accuracy_of_saws;
use crate::analyses::verdict::{Answer, Criterion, Verdict};
use crate::page::outline::{Column, Outline, PLAIN, SPEED, Table, Value};
use crate::page::text::{counted, shown, shown_to};

/// Number of evenly spaced saws in the table.
const SAWS: usize = 12;

/// A function that returns a speed of a saw in rpm; `None` if the saw has no such speed in the sweep.
type Speed = fn(&MappedSaw) -> Option<f64>;

pub fn outline(report: &MapReport) -> Outline {
    let mut text = Outline::default();
    text.remarks("Unusual number", &report.unusual_numbers);
    text.headline(verdict(report));
    speeds(&mut text, report);
    let saws = format!("{} saws of {}", report.saws.len(), report.scene.name);
    text.heading(&saws, &report.condition);
    for axis in std::iter::once(&report.x).chain(&report.y) {
        text.reason(range(axis));
    }
    if report.y.is_none() {
        if let Some(words) = windows(report) {
            text.reason(words);
        }
        for words in kept(report) {
            text.reason(words);
        }
        text.table(saws_of(report));
    }
    let (error, wrong) = (
        report.largest_estimated_relative_error,
        report.saws_with_krein_violations,
    );
    accuracy_of_saws(&mut text, error, wrong, "");
    text.remarks("Warning", &report.warnings);
    text
}

/// Key and name of a number, its range, and its value in the scene.
fn range(axis: &MapAxis) -> String {
    let ends = [axis.values.first(), axis.values.last()].map(|end| end.copied().unwrap_or(0.0));
    let [from, to] = ends.map(|value| shown_to(6, value));
    let unit = match axis.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    format!(
        "{} ({}) from {from} to {to}{unit}; the scene has {}{unit}",
        axis.path,
        axis.name,
        shown(axis.of_scene)
    )
}

fn verdict(report: &MapReport) -> String {
    let Some(rpm) = report.rpm else {
        return "No saw is judged: the scene has no operating_rpm, and no speed was given (--rpm)"
            .to_owned();
    };
    let judged: Vec<&Verdict> = verdicts(report).collect();
    let words = [
        (Answer::Yes, "can run"),
        (Answer::AtRisk, "at risk"),
        (Answer::No, "cannot run"),
    ];
    let counts = words.map(|(answer, word)| {
        let own = judged
            .iter()
            .filter(|verdict| verdict.answer == Some(answer));
        let mut causes: Vec<(&str, usize)> = Vec::new();
        for cause in own.clone().filter_map(|verdict| verdict.cause.as_deref()) {
            match causes.iter_mut().find(|(known, _)| *known == cause) {
                Some((_, count)) => *count += 1,
                None => causes.push((cause, 1)),
            }
        }
        let of: Vec<String> = causes
            .iter()
            .map(|(cause, count)| format!("{} {count}", cause.replace('_', " ")))
            .collect();
        let of = match of.as_slice() {
            [] => String::new(),
            all => format!(" ({})", all.join(", ")),
        };
        format!("{} {word}{of}", own.count())
    });
    format!(
        "At {rpm:.0} rpm, of {} saws: {}",
        judged.len(),
        counts.join(", ")
    )
}

fn verdicts(report: &MapReport) -> impl Iterator<Item = &Verdict> {
    let of_saws = report.saws.iter().filter_map(|saw| saw.verdict.as_ref());
    of_saws.filter(|verdict| verdict.answer.is_some())
}

/// Values of the number of which every saw can run: "yes from 2.4 to 3.2 mm".
fn windows(report: &MapReport) -> Option<String> {
    report.rpm?;
    let is_yes = |saw: &&MappedSaw| {
        let verdict = saw.verdict.as_ref();
        verdict.and_then(|verdict| verdict.answer) == Some(Answer::Yes)
    };
    let runs = report.saws.chunk_by(|x, y| is_yes(&x) == is_yes(&y));
    let ranges: Vec<String> = runs
        .filter(|run| run.first().as_ref().is_some_and(is_yes))
        .map(|run| {
            let [from, to] = [&run[0], &run[run.len() - 1]].map(|saw| shown_to(5, saw.x));
            format!("{from} to {to} {}", report.x.unit)
                .trim_end()
                .to_owned()
        })
        .collect();
    Some(match ranges.as_slice() {
        [] => "no saw of the map can run at this speed".to_owned(),
        all => format!("saws that can run: {} = {}", key(&report.x), all.join(", ")),
    })
}

/// Where each limit of a speed begins or ceases to be kept: "85 % rule: kept from 2.36 mm on".
fn kept(report: &MapReport) -> Vec<String> {
    let criteria = report.saws.iter().flat_map(MappedSaw::criteria);
    let mut limits: Vec<&Criterion> = Vec::new();
    for criterion in criteria.filter(|criterion| criterion.distance().is_some()) {
        if limits.iter().all(|limit| limit.key != criterion.key) {
            limits.push(criterion);
        }
    }
    let words = limits.into_iter().filter_map(|limit| {
        let of = |saw: &MappedSaw| {
            let mut own = saw
                .criteria()
                .filter(|criterion| criterion.key == limit.key);
            own.next()?.distance()
        };
        let ends = crossings(report.saws.iter().map(|saw| Some([saw.x, of(saw)?])));
        if ends.is_empty() {
            return None;
        }
        let value = |x: f64| {
            format!("{} {}", shown_to(4, x), report.x.unit)
                .trim_end()
                .to_owned()
        };
        let ends = ends.into_iter().map(|(x, rises)| {
            if rises {
                format!("from {} on", value(x))
            } else {
                format!("up to {}", value(x))
            }
        });
        let ends: Vec<String> = ends.collect();
        Some(format!("{}: kept {}", limit.name, ends.join(", ")))
    });
    words.collect()
}

/// Places at which a number changes its sign between two neighbours, by linear interpolation, and whether it rises there.
fn crossings(points: impl Iterator<Item = Option<[f64; 2]>>) -> Vec<(f64, bool)> {
    let points: Vec<Option<[f64; 2]>> = points.collect();
    let pairs = points.windows(2).filter_map(|pair| pair[0].zip(pair[1]));
    pairs
        .filter(|([_, left], [_, right])| (*left < 0.0) != (*right < 0.0))
        .map(|([x, left], [next, right])| (x + (next - x) * left / (left - right), right > left))
        .collect()
}

/// Last part of the path of a number.
fn key(axis: &MapAxis) -> &str {
    axis.path.rsplit('.').next().unwrap_or(&axis.path)
}

/// Adds the saws with the lowest and the highest flutter speed and critical speed.
fn speeds(text: &mut Outline, report: &MapReport) {
    let kinds: [(&str, Speed); 2] = [
        ("Flutter speed", |saw| saw.flutter_rpm),
        ("First critical speed", |saw| saw.first_critical_rpm),
    ];
    for (name, of) in kinds {
        let known = report.saws.iter().filter_map(|saw| Some((of(saw)?, saw)));
        let by_speed = |a: &(f64, &MappedSaw), b: &(f64, &MappedSaw)| a.0.total_cmp(&b.0);
        let ends = known.clone().min_by(by_speed).zip(known.max_by(by_speed));
        let Some((low, high)) = ends else {
            text.sentence(format!("{name}: none up to {:.0} rpm", report.to_rpm));
            continue;
        };
        text.sentence(format!(
            "{name}: {:.1} rpm ({}) to {:.1} rpm ({})",
            low.0,
            place(report, low.1),
            high.0,
            place(report, high.1)
        ));
    }
    side_force(text, report);
    let beyond = report
        .saws
        .iter()
        .filter(|saw| saw.flutter_rpm.is_none() && saw.not_analysed.is_none());
    match beyond.count() {
        0 => (),
        count => text.reason(format!(
            "{} not flutter up to {:.0} rpm",
            counted(count, ["saw does", "saws do"]),
            report.to_rpm
        )),
    }
}

/// Adds the saws that a side force deflects least and most.
fn side_force(text: &mut Outline, report: &MapReport) {
    let known = report.saws.iter().filter_map(|saw| {
        let factor = saw.side_force_factor?;
        Some((factor.abs(), saw))
    });
    let by_factor = |a: &(f64, &MappedSaw), b: &(f64, &MappedSaw)| a.0.total_cmp(&b.0);
    let ends = known.clone().min_by(by_factor).zip(known.max_by(by_factor));
    if let Some((least, most)) = ends {
        text.sentence(format!(
            "Side force at the cut: deflects stable blades {} times as far as at rest ({}) to {} times ({})",
            shown_to(2, least.0),
            place(report, least.1),
            shown_to(2, most.0),
            place(report, most.1)
        ));
    }
}

/// The numbers of a saw of the map.
fn place(report: &MapReport, saw: &MappedSaw) -> String {
    let y = report.y.as_ref().zip(saw.y);
    let all = std::iter::once((&report.x, saw.x))
        .chain(y)
        .map(|(axis, value)| {
            format!("{} = {} {}", key(axis), shown_to(5, value), axis.unit)
                .trim_end()
                .to_owned()
        });
    all.collect::<Vec<_>>().join(", ")
}

/// Evenly spaced saws, with the first, the last and that of the scene.
fn saws_of(report: &MapReport) -> Table {
    let columns = [
        Column::words(key(&report.x)),
        Column::of("critical", &SPEED),
        Column::of("flutter", &SPEED),
        Column::words("bands"),
        Column::words("verdict"),
        Column::words(""),
    ];
    let last = report.saws.len().saturating_sub(1);
    let count = SAWS.min(report.saws.len());
    let spaced = (0..count).map(|k| k * last / count.saturating_sub(1).max(1));
    let is_own = |saw: &MappedSaw| saw.x == report.x.of_scene;
    let own = report.saws.iter().position(is_own);
    let shown: BTreeSet<usize> = spaced.chain(own).collect();
    let count = shown.len();
    let rows = shown
        .into_iter()
        .filter_map(|k| report.saws.get(k))
        .map(|saw| {
            let state: Value = match &saw.verdict {
                _ if saw.not_analysed.is_some() => "not analysed".into(),
                None => Value::Missing,
                Some(verdict) => verdict.in_table().into(),
            };
            [
                PLAIN.digits(6, saw.x),
                SPEED.fixed(1, saw.first_critical_rpm),
                SPEED.fixed(1, saw.flutter_rpm),
                saw.instabilities.len().into(),
                state,
                Value::Word(if is_own(saw) { "the scene" } else { "" }.to_owned()),
            ]
        });
    let title = match report.saws.len() {
        all if all > count => format!("{count} of {all} saws; map.json has all"),
        _ => String::new(),
    };
    Table::new(title, columns)
        .showing(usize::MAX)
        .with_rows(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_kept_from_where_its_distance_rises_through_zero() {
        let points = [[1.0, -3.0], [2.0, 1.0], [3.0, 2.0], [4.0, -2.0]];
        let found = crossings(points.into_iter().map(Some));
        assert_eq!(found, [(1.75, true), (3.5, false)]);
        // A saw that was not analysed leaves the crossing open.
        let hole = [Some([1.0, -1.0]), None, Some([3.0, 1.0])];
        assert!(crossings(hole.into_iter()).is_empty());
    }
}
