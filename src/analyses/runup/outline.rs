//! The text of a run-up.

use super::RunUpReport;
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::motion::transient::LINEAR_THICKNESSES;
use crate::page::outline::{Column, Fact, LENGTH, Outline, PLAIN, SPEED, TIME, Table, Value};

pub fn outline(report: &RunUpReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(verdict(report));
    let largest = LENGTH.fixed(2, report.largest_deflection_m);
    let at = SPEED.fixed(0, report.largest_deflection_rpm);
    let mut facts = vec![
        Fact::new("largest deflection of the rim", largest),
        Fact::new("at a speed of", at),
    ];
    if let Some(rpm) = report.first_doubling_rpm {
        let name = "first band that amplifies a vibration more than twofold";
        facts.push(Fact::new(name, SPEED.fixed(0, rpm)));
    }
    text.facts("", facts);
    match (report.bands.is_empty(), report.first_doubling_rpm) {
        (true, _) => text.sentence("No instability: no vibration grows at any speed of the run-up"),
        (false, None) => text.sentence(format!(
            "At {:.1} rpm/s no band amplifies a vibration more than twofold",
            report.rate_rpm_per_s
        )),
        (false, Some(_)) => (),
    }
    if !report.bands.is_empty() {
        text.table(bands(report));
        text.sentence(MEANING);
    }
    text.remarks("Warning", &report.warnings);
    text
}

const MEANING: &str = "in/before: largest deflection at the probe in the band over that in as many rpm before it. All modes contribute: with a small exponent it shows beating, not growth.";

/// Speed up to which the model is valid.
fn verdict(report: &RunUpReport) -> String {
    let stretched = report.stretching.as_ref();
    let end = match (report.linear_until_rpm, stretched) {
        (None, Some(found)) => match found.valid_until_rpm {
            None => format!(
                "with stretching, slopes of the blade of {:.3} at most",
                found.largest_slope
            ),
            Some(rpm) => format!(
                "with stretching, valid up to about {:.0} rpm, where slopes of the blade exceed {LARGEST_SLOPE} and the model ends",
                10.0 * (0.1 * rpm).round()
            ),
        },
        (None, None) => "within the linear model".to_owned(),
        (Some(rpm), _) => format!(
            "valid up to about {:.0} rpm, where the deflection of the rim exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm) and the linear model ends",
            10.0 * (0.1 * rpm).round(),
            1e3 * report.linear_limit_m
        ),
    };
    format!(
        "Run-up from {:.0} to {:.0} rpm at {:.1} rpm/s: {end}",
        report.from_rpm, report.to_rpm, report.rate_rpm_per_s
    )
}

/// For each band the time spent in it, the exponent, and predicted and computed amplification.
fn bands(report: &RunUpReport) -> Table {
    let columns = [
        Column::words("band"),
        Column::of("from", &SPEED),
        Column::of("to", &SPEED),
        Column::of("time", &TIME),
        Column::words("∫Re λ dt"),
        Column::words("grows by"),
        Column::words("in/before"),
    ];
    let rows = report.bands.iter().map(|entry| {
        [
            entry.band.kind.to_string().into(),
            SPEED.fixed(1, entry.band.from_rpm),
            SPEED.fixed(1, entry.band.to_rpm),
            TIME.fixed(2, entry.time_s),
            PLAIN.fixed(3, entry.growth_exponent),
            times(entry.growth_exponent.exp()),
            entry.seen_amplification.map_or(Value::Missing, times),
        ]
    });
    Table::new("Bands of instability", columns)
        .in_file("runup.json")
        .with_rows(rows)
}

/// Amplifications above this factor are not distinguished: motions of practical size then exceed the linear
/// model.
const MOST_TIMES: f64 = 1e3;

fn times(factor: f64) -> Value {
    if factor <= MOST_TIMES {
        format!("{factor:.2} x").into()
    } else {
        format!("> {MOST_TIMES:.0} x").into()
    }
}
