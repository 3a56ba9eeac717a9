//! Table of the modes at one speed.

use std::fmt::{Result, Write};

use crate::report::{Report, StabilityState, WhirlMode};
use crate::text::shown_to;

/// Writes the verdict at one speed, and the frequencies, growth rates and names of its modes: with damping ratio
/// and logarithmic decrement if the scene has damping, otherwise with Krein sign.
pub fn whirl(text: &mut String, report: &Report) -> Result {
    let Some(whirl) = &report.whirl else {
        return Ok(());
    };
    let state = match whirl.verdict {
        StabilityState::Stable => "stable",
        StabilityState::Divergence => "UNSTABLE, divergence",
        StabilityState::Flutter => "UNSTABLE, flutter",
        StabilityState::OutsideSweep => "outside the sweep",
    };
    let critical = whirl.at_critical_rpm;
    let critical = critical.map_or(String::new(), |rpm| {
        format!(", within 5 % of the critical speed {rpm:.1} rpm")
    });
    writeln!(text, "\nModes at {} rpm: {state}{critical}", whirl.rpm)?;
    let is_damped = whirl.modes.iter().any(|mode| mode.damping_ratio.is_some());
    match is_damped {
        true => writeln!(text, "       [Hz] Re λ [1/s] ratio [%] decrement  mode")?,
        false => writeln!(text, "       [Hz] Re λ [1/s] Krein  mode")?,
    }
    for mode in &whirl.modes {
        writeln!(
            text,
            "  {:>9.3} {}  {}",
            mode.frequency_hz,
            numbers(mode),
            mode.name
        )?;
    }
    Ok(())
}

/// Growth rate in 1/s, and damping ratio in percent with logarithmic decrement, or Krein sign.
fn numbers(mode: &WhirlMode) -> String {
    let growth = shown_to(3, mode.growth_per_s);
    let Some(ratio) = mode.damping_ratio else {
        let sign = match mode.krein_sign {
            0 => "none",
            1 => "+1",
            _ => "-1",
        };
        return format!("{growth:>10} {sign:>5}");
    };
    let decrement = mode.logarithmic_decrement;
    let decrement = decrement.map_or("none".to_owned(), |d| shown_to(4, d));
    format!(
        "{growth:>10} {:>9} {decrement:>9}",
        shown_to(3, 100.0 * ratio)
    )
}
