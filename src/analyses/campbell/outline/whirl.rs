//! The modes at one speed.

use crate::analyses::campbell::{Report, StabilityState, WhirlMode};
use crate::analyses::verdict::near_critical;
use crate::page::outline::{Column, FREQUENCY, GROWTH, Outline, PERCENT, PLAIN, Table, Value};

/// Adds the verdict at one speed, and the frequencies, growth rates and names of its modes: with damping ratio
/// and logarithmic decrement if the scene has damping, otherwise with Krein sign.
pub fn whirl(text: &mut Outline, report: &Report) {
    let Some(whirl) = &report.whirl else {
        return;
    };
    let state = match whirl.verdict {
        StabilityState::Stable => "stable",
        StabilityState::Divergence => "UNSTABLE, divergence",
        StabilityState::Flutter => "UNSTABLE, flutter",
        StabilityState::TooClose => "TOO CLOSE TO CALL at the edge of a band",
        StabilityState::NotDetermined => "UNKNOWN, the search for bands failed",
        StabilityState::NotCovered => "NOT CERTAIN, slots pass guides",
        StabilityState::OutsideSweep => "outside the sweep",
    };
    let critical = whirl
        .at_critical_rpm
        .map_or(String::new(), |rpm| format!(", {}", near_critical(rpm)));
    let title = format!("Modes at {} rpm: {state}{critical}", whirl.rpm);
    let is_damped = whirl.modes.iter().any(|mode| mode.damping_ratio.is_some());
    let mut columns = vec![
        Column::of("frequency", &FREQUENCY),
        Column::of("Re λ", &GROWTH),
    ];
    if is_damped {
        columns.push(Column::of("ratio", &PERCENT));
        columns.push(Column::words("decrement"));
    } else {
        columns.push(Column::words("Krein"))
    }
    columns.push(Column::words("mode"));
    let mut table = Table::new(title, columns).showing(usize::MAX);
    for mode in &whirl.modes {
        let mut row = vec![
            FREQUENCY.fixed(3, mode.frequency_hz),
            GROWTH.digits(3, mode.growth_per_s),
        ];
        if is_damped {
            row.push(PERCENT.digits(3, mode.damping_ratio));
            row.push(PLAIN.digits(4, mode.logarithmic_decrement).or("none"));
        } else {
            row.push(krein_sign(mode))
        }
        row.push(mode.name.clone().into());
        table.row(row);
    }
    text.table(table);
}

fn krein_sign(mode: &WhirlMode) -> Value {
    match mode.krein_sign {
        0 => "none".into(),
        1 => "+1".into(),
        _ => "-1".into(),
    }
}
