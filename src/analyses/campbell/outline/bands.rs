//! The table of bands of instability.

use crate::analyses::campbell::{InstabilityBand, InstabilityKind, Report};
use crate::page::outline::{Column, FREQUENCY, GROWTH, LENGTH, Outline, SPEED, Table, Value};

/// Growth below which the rate has an exponent, in 1/s.
const SMALL: f64 = 0.005;

/// Adds every band of instability, whether its growth exceeds the threshold, and the amplitude to which flutter rises
/// if it was computed.
pub fn bands(text: &mut Outline, report: &Report) {
    let bands = &report.instabilities;
    if bands.is_empty() {
        return text.sentence("No instability: no vibration grows at any speed of the sweep");
    }
    let rises = bands
        .iter()
        .any(|band| band.saturated_amplitude_m.is_some() || band.amplitude_not_computed.is_some());
    let mut columns = vec![
        Column::words("kind"),
        Column::of("from", &SPEED),
        Column::of("to", &SPEED),
        Column::of("growth", &GROWTH),
        Column::of("at", &FREQUENCY),
    ];
    columns.extend(rises.then(|| Column::of("rises to", &LENGTH)));
    columns.push(Column::words("waves"));
    let mut table = Table::new("Bands of instability", columns).in_file("report.json");
    for band in bands {
        let mut row = numbers(report, band);
        row.extend(rises.then(|| amplitude(band)));
        row.push(band.name.clone().unwrap_or_default().into());
        table.row_with(row, counts(band));
    }
    text.table(table);
    if bands.iter().any(|band| band.counted_rpm.is_empty()) {
        text.sentence(format!(
            "(in brackets: flutter below the threshold of {} 1/s, which does not count)",
            report.flutter_threshold_per_s
        ));
    }
    if rises {
        for band in bands {
            if let Some(reason) = &band.amplitude_not_computed {
                let from = band.from_rpm;
                text.sentence(format!(
                    "Flutter from {from:.1} rpm: amplitude not computed: {reason}"
                ));
            }
        }
        text.sentence(RISES);
    }
}

const RISES: &str = "Rises to: largest deflection of a motion that begins small, at the speed of largest growth and \
     without damping, limited by stretching. Near one edge of a band it is up to 1.41 times as large and is reached later.";

fn numbers(report: &Report, band: &InstabilityBand) -> Vec<Value> {
    let is_open = |at: f64, end: f64| !band.closed && (at - end).abs() <= 1e-9 * end.abs();
    let (first, last) = (report.campbell.from_rpm, report.campbell.to_rpm);
    let speed = |rpm: f64, end: f64, word: &str| {
        if is_open(rpm, end) {
            word.into()
        } else {
            SPEED.fixed(1, rpm)
        }
    };
    let growth = band.peak_growth_per_s;
    vec![
        if band.counted_rpm.is_empty() {
            format!("({})", band.kind).into()
        } else {
            band.kind.to_string().into()
        },
        speed(band.from_rpm, first, "before"),
        speed(band.to_rpm, last, "beyond"),
        if growth < SMALL {
            format!("{growth:.0e}").into()
        } else {
            GROWTH.fixed(2, growth)
        },
        FREQUENCY.fixed(2, band.frequency_hz),
    ]
}

fn amplitude(band: &InstabilityBand) -> Value {
    match (band.kind, &band.amplitude_not_computed) {
        (InstabilityKind::Divergence, _) => "".into(),
        (_, Some(_)) => "unknown".into(),
        (_, None) => LENGTH.fixed(3, band.saturated_amplitude_m),
    }
}

/// The ranges of speed in which the growth exceeds the threshold, unless they are the whole band.
fn counts(band: &InstabilityBand) -> Option<String> {
    let [stretches @ .., last] = band.counted_rpm.as_slice() else {
        return None;
    };
    if stretches.is_empty() && *last == [band.from_rpm, band.to_rpm] {
        return None;
    }
    let words = |[from, to]: &[f64; 2]| format!("{from:.1} to {to:.1}");
    let counted: Vec<String> = band.counted_rpm.iter().map(words).collect();
    Some(format!("counts from {} rpm", counted.join(", and from ")))
}
