//! The text of a washboarding analysis.

use std::f64::consts::LN_2;

use super::{WashboardMode, WashboardReport};
use crate::analyses::campbell::Verdict;
use crate::page::outline::{
    Column, FREQUENCY, Fact, GROWTH, LENGTH, METRES, Outline, STIFFNESS, Table, Value,
};
use crate::page::text::{shown, shown_to};

pub fn outline(report: &WashboardReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(verdict(report));
    boundary(&mut text, report);
    text.sentence(format!(
        "{:.0} teeth pass in a second; {} N/m across the blade, overlap {:.2}, arc of {:.1}°; modes up to {:.0} Hz",
        report.tooth_passing_hz,
        shown_to(4, report.stiffness_n_per_m),
        report.overlap,
        report.arc_deg,
        report.complete_to_hz
    ));
    text.table(modes(report));
    text.remarks("Warning", &report.warnings);
    text
}

fn verdict(report: &WashboardReport) -> String {
    let rpm = report.rpm;
    let threshold_per_s = report.scene.flutter_threshold_per_s;
    match (report.verdict, report.growing_mode()) {
        (Verdict::Stable, _) => format!("{rpm} rpm: stable, no washboarding"),
        (Verdict::Unstable, None) => format!("{rpm} rpm: UNSTABLE"),
        (Verdict::Unstable, Some(mode)) if mode.growth_per_s < threshold_per_s => format!(
            "{rpm} rpm: no washboarding of {} 1/s or more; a vibration grows by {} 1/s at {:.1} Hz ({}), twofold in {} s",
            shown(threshold_per_s),
            shown_to(2, mode.growth_per_s),
            mode.frequency_hz,
            mode.name,
            shown_to(2, LN_2 / mode.growth_per_s)
        ),
        (Verdict::Unstable, Some(mode)) => {
            let pattern = mode
                .pattern_pitch_m
                .map(|pitch| format!(", waves of {} along the feed", length(pitch).with_unit()));
            format!(
                "{rpm} rpm: UNSTABLE, washboarding grows by {:.3} 1/s at {:.1} Hz ({}){}",
                mode.growth_per_s,
                mode.frequency_hz,
                mode.name,
                pattern.unwrap_or_default()
            )
        }
    }
}

/// Adds the smallest cutting stiffness at which a vibration grows, and its frequency.
fn boundary(text: &mut Outline, report: &WashboardReport) {
    match report.critical_stiffness_n_per_m {
        Some(stiffness) if stiffness > 0.0 => {
            let share = report.stiffness_n_per_m / stiffness;
            let smallest = Fact::new(
                "smallest cutting stiffness at which a vibration grows",
                STIFFNESS.digits(4, stiffness),
            );
            let hz = FREQUENCY.fixed(1, report.critical_frequency_hz);
            let facts = [
                smallest.with(format!("(the cut has {share:.3} times that)")),
                Fact::new("frequency of this vibration", hz),
            ];
            text.facts("", facts);
        }
        Some(_) => text.sentence("A vibration grows without the delayed force"),
        None => text.sentence(format!(
            "No vibration grows up to a cutting stiffness of {} N/m",
            shown_to(2, report.ceiling_n_per_m)
        )),
    }
}

fn modes(report: &WashboardReport) -> Table {
    let columns = [
        Column::words("mode"),
        Column::of("frequency", &FREQUENCY),
        Column::of("growth", &GROWTH),
        Column::of("without", &GROWTH),
        Column::words("pitch"),
    ];
    let row = |mode: &WashboardMode| {
        [
            mode.name.clone().into(),
            FREQUENCY.fixed(1, mode.frequency_hz),
            GROWTH.fixed(3, mode.growth_per_s),
            GROWTH.fixed(3, mode.growth_without_per_s),
            mode.pattern_pitch_m
                .map_or(Value::Missing, |pitch| length(pitch).with_unit().into()),
        ]
    };
    Table::new("", columns)
        .showing(usize::MAX)
        .with_rows(report.modes.iter().map(row))
}

/// A length below a metre in millimetres, otherwise in metres.
fn length(metres: f64) -> Value {
    if metres < 1.0 {
        LENGTH.fixed(1, metres)
    } else {
        METRES.fixed(2, metres)
    }
}
