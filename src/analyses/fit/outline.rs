//! The text of a fit.

use super::{FitReport, FittedParameter};
use crate::analyses::changed::changed;
use crate::page::outline::{Column, FREQUENCY, Fact, Outline, SPEED, Table, Value};
use crate::page::text::{counted, shown_to};

/// Number of speeds of which the text shows the deviations.
const SPEEDS: usize = 20;
/// Largest number of frequencies in a row of this table; the report contains all.
const FREQUENCIES: usize = 7;

pub fn outline(report: &FitReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(format!(
        "Fitted to {} ({})",
        counted(report.measured_frequencies, ["frequency", "frequencies"]),
        report.source
    ));
    text.remarks("Warning", &report.warnings);
    let rms = FREQUENCY.fixed(3, report.rms_hz);
    let before = FREQUENCY.fixed(3, report.rms_before_hz);
    let deviation = Fact::new("deviation (rms)", rms).after(before);
    let numbers = |parameters: &[FittedParameter]| -> Vec<Fact> {
        let each = parameters.iter();
        each.map(|found| number(found, report)).collect()
    };
    text.facts(
        "",
        std::iter::once(deviation).chain(numbers(&report.parameters)),
    );
    for other in &report.other_minima {
        let deviation = Fact::new("deviation (rms)", FREQUENCY.fixed(3, other.rms_hz));
        text.facts(
            "Another saw that fits about as well",
            std::iter::once(deviation).chain(numbers(&other.parameters)),
        );
    }
    text.table(deviations(report));
    let reached = report.starts.iter().filter_map(|start| start.rms_hz);
    let best = reached.clone().fold(f64::INFINITY, f64::min);
    let same = reached.clone().filter(|rms| *rms <= 1.001 * best);
    text.sentence(format!(
        "{} of {} starts led to this minimum (n up to {}, {} polynomials over the radius)",
        same.count(),
        reached.count(),
        report.max_diameters,
        report.radial_functions
    ));
    text
}

/// A fitted number after its value in the scene, with its interval of confidence.
fn number(found: &FittedParameter, report: &FitReport) -> Fact {
    let percent = 100.0 * report.confidence;
    let condition = if report.other_minima.is_empty() {
        ""
    } else {
        " if it is this saw"
    };
    let interval = match (found.interval_from, found.interval_to) {
        (Some(from), Some(to)) => format!(
            "({percent:.0} % interval {} … {}{condition})",
            shown_to(5, from),
            shown_to(5, to)
        ),
        _ if found.at_bound => "(at its bound)".into(),
        _ => "(not determined)".into(),
    };
    changed(&found.path, found.start, found.value, 5).with(interval)
}

/// Deviations of the computed from the measured frequencies, ascending, a row for each speed.
fn deviations(report: &FitReport) -> Table {
    let mut speeds: Vec<f64> = report.residuals.iter().map(|r| r.rpm).collect();
    speeds.dedup();
    let most = report.residuals.iter().map(|r| r.place).max().unwrap_or(0);
    let places = 1..=most.min(FREQUENCIES);
    let is_partly = report.residuals.iter().any(|r| !r.fitted);
    let mut columns = vec![Column::of("speed", &SPEED)];
    columns.extend(
        places
            .clone()
            .map(|place| Column::of(place.to_string(), &FREQUENCY)),
    );
    columns.extend(is_partly.then(|| Column::words("")));
    let title = "Computed minus measured frequency, in ascending order";
    let mut table = Table::new(title, columns)
        .showing(SPEEDS)
        .in_file("fit.json");
    for rpm in speeds {
        let own = || report.residuals.iter().filter(|r| r.rpm == rpm);
        let at = |place: usize| {
            let residual = own().find(|r| r.place == place);
            FREQUENCY.fixed(2, residual.map(|r| r.fitted_hz - r.measured_hz))
        };
        let mut row = vec![SPEED.digits(6, rpm)];
        row.extend(places.clone().map(at));
        let fitted: Value = if own().all(|r| r.fitted) {
            "".into()
        } else {
            "not fitted".into()
        };
        row.extend(is_partly.then_some(fitted));
        table.row(row);
    }
    table
}
