//! The text of a sized number.

use super::{SizeReport, SizedEach, SizedWindow};
use crate::analyses::scene_number::{DIGITS, FigureUnit, unit, with_unit};
use crate::analyses::verdict::Answer;
use crate::page::outline::{Column, Outline, PERCENT, PLAIN, Table, Value};
use crate::page::text::{capitalized, counted, shown, shown_to};

/// Number of rows of the table.
const ROWS: usize = 24;

pub fn outline(report: &SizeReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(headline(report));
    for window in &report.windows {
        let sides = [
            ("below", window.from, &window.below),
            ("above", window.to, &window.above),
        ];
        for (side, end, broken) in sides {
            if let Some(broken) = broken {
                text.sentence(format!("{side} {}: {broken}", of(report, end)));
            }
        }
    }
    if report.windows.is_empty() {
        let closest = report
            .limits
            .iter()
            .filter_map(|limit| {
                let margins = limit.margins.iter().copied().flatten();
                Some((limit, margins.reduce(f64::max)?))
            })
            .filter(|(_, most)| *most < 0.0);
        for (limit, most) in closest {
            text.sentence(format!(
                "{}: missed by {} % at least",
                limit.name,
                shown_to(2, -100.0 * most)
            ));
        }
    }
    if let Some(answer) = &report.answer {
        let whose = if answer.is_of_scene {
            ", the value of the scene"
        } else {
            ""
        };
        text.sentence(format!(
            "{}{whose}: {}: {}",
            of(report, answer.value),
            Answer::Yes.in_words().to_uppercase(),
            answer.verdict.reason
        ));
        let critical = answer
            .critical_rpm_per_percent
            .map(|rpm| format!("first critical speed {rpm:+.1} rpm"));
        let deflection = answer
            .deflection_m_per_percent
            .map(|m| format!("deflection at the cut {:+.2} µm", 1e6 * m));
        let changes: Vec<String> = critical.into_iter().chain(deflection).collect();
        if !changes.is_empty() {
            text.reason(format!("1 % more: {}", changes.join(", ")));
        }
    }
    text.reason(format!(
        "{} from {} to {}; the scene has {}",
        report.paths.join(", "),
        of(report, report.from),
        of(report, report.to),
        of(report, report.of_scene)
    ));
    if let Some(each) = &report.each {
        text.table(rows(report, each));
    }
    text.table(saws(report));
    text.remarks("Warning", &report.warnings);
    text.details(|text| {
        text.sentence(format!(
            "{} checked; ranges were searched with a tolerance of {}",
            counted(report.saws, ["saw was", "saws were"]),
            shown(report.searched_tolerance)
        ));
    });
    text
}

/// A value in the unit of figures.
pub fn of(report: &SizeReport, value: f64) -> String {
    with_unit(report.path(), value)
}

/// The answer in one line.
pub fn headline(report: &SizeReport) -> String {
    let at = match report.operating_rpm {
        Some(rpm) => format!(" for {} rpm", shown_to(6, rpm)),
        None => String::new(),
    };
    let ranges = ranges(report, &report.windows, [report.from, report.to]);
    format!("{}{at}: {ranges}", capitalized(&report.name))
}

/// The ranges in words, of values between two bounds.
fn ranges(report: &SizeReport, windows: &[SizedWindow], bounds: [f64; 2]) -> String {
    let range = |window: &SizedWindow| {
        let [from, to] = [window.from, window.to].map(|end| of(report, end));
        match (&window.below, &window.above) {
            (Some(_), None) => format!("at least {from}"),
            (None, Some(_)) => format!("at most {to}"),
            (Some(_), Some(_)) => format!("{from} to {to}"),
            (None, None) => format!("any from {from} to {to}"),
        }
    };
    let ranges: Vec<String> = windows.iter().map(range).collect();
    if ranges.is_empty() {
        let [from, to] = bounds.map(|end| of(report, end));
        return format!("no value from {from} to {to} keeps all limits");
    }
    ranges.join(", or ")
}

/// The ranges for every value of another number.
fn rows(report: &SizeReport, each: &SizedEach) -> Table {
    let path = each.paths.first().map_or("", String::as_str);
    let FigureUnit { symbol, factor } = unit(path);
    let columns = [
        Column::of(each.name.clone(), &PLAIN).in_unit(symbol),
        Column::words(report.name.clone()),
        Column::words(""),
    ];
    let mut table = Table::new("", columns).showing(usize::MAX);
    for row in &each.rows {
        let own = if row.is_of_scene { "the scene" } else { "" };
        table.row([
            PLAIN.digits(DIGITS, factor * row.value),
            Value::Word(ranges(report, &row.windows, [row.from, row.to])),
            Value::Word(own.to_owned()),
        ]);
    }
    table
}

/// The saws, with the limit that is nearest, or missed most.
fn saws(report: &SizeReport) -> Table {
    let FigureUnit { symbol, factor } = unit(report.path());
    let columns = [
        Column::of(report.name.clone(), &PLAIN).in_unit(symbol),
        Column::words("answer"),
        Column::of("margin", &PERCENT),
        Column::words("of"),
    ];
    let mut table = Table::new("Saws", columns).showing(ROWS);
    for (k, (value, answer)) in report.values.iter().zip(&report.answers).enumerate() {
        let known = report
            .limits
            .iter()
            .filter_map(|limit| Some((limit.margins[k]?, limit)));
        let nearest = known.min_by(|x, y| x.0.total_cmp(&y.0));
        let word = answer.map_or("refused", Answer::in_words);
        table.row([
            PLAIN.digits(DIGITS, factor * value),
            Value::Word(word.to_owned()),
            PERCENT.fixed(1, nearest.map(|(margin, _)| margin)),
            nearest.map_or(Value::Missing, |(_, limit)| Value::Word(limit.name.clone())),
        ]);
    }
    table
}

impl SizeReport {
    /// Path of the number, or of that of the first guide.
    pub(super) fn path(&self) -> &str {
        self.paths.first().map_or("", String::as_str)
    }
}
