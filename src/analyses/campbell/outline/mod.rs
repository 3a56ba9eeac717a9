//! The text of a Campbell diagram.

mod answer;
mod bands;
mod checks;
mod in_cut;
mod influences;
mod whirl;

#[cfg(feature = "page")]
pub use answer::usable;
pub use answer::{answer, caution};
pub use checks::checks;

use super::{Report, SplitPairs};
use crate::model::scene::BladeFile;
use crate::page::outline::{Column, FREQUENCY, Outline, PERCENT, PLAIN, SPEED, Table};

/// Number of modes at rest that a text shows.
const MODES: usize = 8;

pub fn outline(report: &Report) -> Outline {
    let mut text = Outline::default();
    text.heading(&report.scene.name, &report.condition);
    text.sentence(size(report));
    text.remarks("Unusual number", &report.unusual_numbers);
    text.extend(answer(report));
    in_cut::in_cut(&mut text, report);
    text.table(modes(report));
    match report.overdamped_modes_at_rest {
        0 => (),
        1 => text.reason("1 other decays without oscillating (overdamped)"),
        many => text.reason(format!(
            "{many} others decay without oscillating (overdamped)"
        )),
    }
    critical_speeds(&mut text, report);
    bands::bands(&mut text, report);
    if let Some(words) = report
        .split_pairs
        .as_ref()
        .and_then(SplitPairs::not_certain_in_words)
    {
        text.sentence(words);
    }
    crossings(&mut text, report);
    influences::rolled(&mut text, report);
    influences::straight_edge(&mut text, report);
    influences::heat(&mut text, report);
    text.table(influences::sensitivity(report));
    whirl::whirl(&mut text, report);
    checks(&mut text, report);
    text.remarks("Warning", &report.warnings);
    text
}

/// Size of the saw, and the range of speeds.
fn size(report: &Report) -> String {
    let blade = &report.scene.blade;
    format!(
        "{:.1} mm outside, {:.1} mm bore, {} thick; {} to {} rpm",
        1e3 * blade.outer_diameter_m,
        1e3 * blade.inner_diameter_m,
        thickness(blade),
        report.campbell.from_rpm.round(),
        report.campbell.to_rpm.round()
    )
}

/// The thickness in millimetres, or its smallest and largest value.
fn thickness(blade: &BladeFile) -> String {
    let [least, largest] = blade
        .thickness_range_m()
        .map(|thickness_m| 1e3 * thickness_m);
    if least == largest {
        format!("{largest:.2} mm")
    } else {
        format!("{least:.2} to {largest:.2} mm")
    }
}

/// Whether the modes at rest have damping ratios.
fn is_damped(report: &Report) -> bool {
    let mut modes = report.modes_at_rest.iter();
    modes.any(|mode| mode.damping_ratio.is_some())
}

/// Number and name of a branch, "4: 2 forward", as in the Campbell diagram; the name alone without a number.
fn numbered(branch: Option<usize>, name: &str) -> String {
    match branch {
        Some(number) => format!("{number}: {name}"),
        None => name.to_owned(),
    }
}

fn modes(report: &Report) -> Table {
    let is_damped = is_damped(report);
    let mut columns = vec![Column::of("frequency", &FREQUENCY)];
    if is_damped {
        columns.push(Column::of("damping ratio", &PERCENT));
        columns.push(Column::words("decrement"));
    }
    columns.push(Column::words("mode"));
    let mut table = Table::new("Modes at rest", columns)
        .showing(MODES)
        .in_file("report.json");
    for mode in &report.modes_at_rest {
        let mut row = vec![FREQUENCY.fixed(2, mode.frequency_hz)];
        if is_damped {
            row.push(PERCENT.digits(3, mode.damping_ratio));
            row.push(PLAIN.digits(3, mode.logarithmic_decrement));
        }
        row.push(numbered(mode.branch, &mode.name).into());
        table.row(row);
    }
    table
}

fn critical_speeds(text: &mut Outline, report: &Report) {
    let speeds = &report.critical_speeds;
    if speeds.is_empty() {
        return text.sentence(format!(
            "No critical speed up to {:.0} rpm",
            report.campbell.to_rpm
        ));
    }
    let title = if report.critical_speeds_without_damping {
        "Critical speeds of the saw without its damping"
    } else {
        "Critical speeds"
    };
    let columns = [
        Column::of("speed", &SPEED),
        Column::words("wave that stands still"),
    ];
    let rows = speeds.iter().map(|critical| {
        let speed = SPEED.fixed(1, critical.rpm);
        [speed, critical.name.clone().into()]
    });
    let table = Table::new(title, columns).in_file("report.json");
    text.table(table.with_rows(rows));
    if let Some(words) = report
        .split_pairs
        .as_ref()
        .and_then(SplitPairs::upper_in_words)
    {
        text.sentence(words);
    }
}

/// Adds the crossings of multiples of the rotation speed with natural frequencies, if the scene requests multiples.
fn crossings(text: &mut Outline, report: &Report) {
    let Some(excitation) = &report.excitation else {
        return;
    };
    let complete_hz = report.campbell.complete_to_hz;
    if excitation.crossings.is_empty() {
        return text.sentence(format!(
            "No requested multiple of the speed equals a frequency below {complete_hz:.0} Hz"
        ));
    }
    let columns = [
        Column::of("speed", &SPEED),
        Column::words("order"),
        Column::of("frequency", &FREQUENCY),
        Column::words("mode"),
    ];
    let rows = excitation.crossings.iter().map(|crossing| {
        [
            SPEED.fixed(1, crossing.rpm),
            format!("{}×", crossing.order).into(),
            FREQUENCY.fixed(2, crossing.frequency_hz),
            numbered(crossing.branch, &crossing.mode).into(),
        ]
    });
    let title = format!("Excitation at multiples of the speed, up to {complete_hz:.0} Hz");
    let table = Table::new(title, columns).in_file("report.json");
    text.table(table.with_rows(rows));
}
