//! The summary of guides with a gap.

use std::fmt::Write;

use super::{WIDTH, decimals_or, each, heading, sentence, shortened};
use crate::analyses::gap::{AtAmplitude, FrictionHeat, GapReport, Oscillation, OscillationAt};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &GapReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    sentence(text, &half_way(report))?;
    writeln!(
        text,
        "\nOver the amplitude at the guides (mean stiffness of an oscillation)"
    )?;
    writeln!(
        text,
        "  amplitude   stiffness   first critical   flutter speed   bands"
    )?;
    writeln!(
        text,
        "       [mm]                        [rpm]           [rpm]"
    )?;
    writeln!(text, "{}", row("inside gap", &report.free))?;
    for at in &report.amplitudes {
        let amplitude = at
            .amplitude_m
            .map_or_else(String::new, |m| shown_to(4, 1e3 * m));
        writeln!(text, "{}", row(&amplitude, at))?;
    }
    writeln!(text, "{}", row("linear", &report.linear))?;
    deviation(text, report)?;
    if let Some(found) = &report.oscillation {
        oscillation(text, report, found)?;
    }
    if let Some(friction) = &report.friction {
        heat(text, report, friction)?;
    }
    if let Some(error) = &report.deviation.basis_error {
        let line = format!(
            "Estimated error of these deflections: {} % at most, from {} modes at rest in the place of {}",
            shown_to(2, 1e2 * error.share),
            error.more_modes,
            error.modes
        );
        writeln!(text)?;
        sentence(text, &line)?;
    }
    writeln!(text)?;
    sentence(text, MEANING)?;
    each(text, "Warning", &report.warnings)
}

const MEANING: &str = "The chart over the amplitude is the linear one with the mean stiffness of the guides over a sinusoidal oscillation \
     of the same amplitude at all of them; it is an approximation. Deflections are stationary ones, unless an oscillation is named.";

fn oscillation(text: &mut String, report: &GapReport, found: &Oscillation) -> std::fmt::Result {
    let mm = |m: f64| format!("{:.4}", 1e3 * m);
    writeln!(
        text,
        "\nOscillation at {:.0} rpm under {} N, with the gap of the scene",
        report.deviation.rpm,
        shown_to(3, found.force_n)
    )?;
    let Some(at) = &found.at else {
        return writeln!(text, "  no periodic motion was found");
    };
    let moved = format!(
        "{} mm, amplitude {} mm, at most {} mm",
        mm(at.cut.mean_m),
        mm(at.cut.amplitude_m),
        mm(at.cut.largest_m)
    );
    let probe = format!(
        "{} mm, amplitude {} mm",
        mm(at.probe.mean_m),
        mm(at.probe.amplitude_m)
    );
    let rows = [
        ("rim at the cut, mean", moved),
        (
            "without oscillation",
            format!("{} mm", mm(found.still_deflection_m)),
        ),
        ("probe, mean", probe),
        ("small motions", decay(at)),
    ];
    for (name, value) in rows {
        writeln!(text, "  {name:<22}{value}")?;
    }
    for pad in &at.pads {
        let name = format!("guides[{}], mean force", pad.guide);
        writeln!(
            text,
            "  {name:<22}{} N, at most {} N, touches {:.0} % of the time",
            shown_to(3, pad.mean_force_n),
            shown_to(3, pad.largest_force_n),
            1e2 * pad.contact_share
        )?;
    }
    writeln!(
        text,
        "\n  order   frequency   at the cut     at probe   cause"
    )?;
    writeln!(text, "               [Hz]         [mm]         [mm]")?;
    let sizes = at.cut.lines_m.iter().zip(&at.probe.lines_m);
    for (line, (cut, probe)) in found.lines.iter().zip(sizes) {
        let row = format!(
            "  {:>5} {:>11} {:>12} {:>12}   {}",
            format!("{}×", line.order),
            shown_to(4, f64::from(line.order) * at.rpm / 60.0),
            shown_to(3, 1e3 * cut),
            shown_to(3, 1e3 * probe),
            line.name
        );
        writeln!(text, "{}", shortened(&row, WIDTH))?;
    }
    let error = |share: Option<f64>| {
        share.map_or_else(
            || "unknown".to_owned(),
            |share| format!("{} %", shown_to(2, 1e2 * share)),
        )
    };
    let line = format!(
        "Estimated error of this amplitude at the cut: {} with more harmonics, {} with more modes at rest",
        error(found.harmonics_error_share),
        error(found.basis_error_share)
    );
    sentence(text, &line)
}

/// Stability of the oscillation: largest growth rate of small motions about it.
fn decay(at: &OscillationAt) -> String {
    match at.growth_per_s {
        None => "unknown".to_owned(),
        Some(growth) if at.stable => format!("stable, growth {} 1/s at most", shown_to(2, growth)),
        Some(growth) => format!("unstable, growth {} 1/s", shown_to(2, growth)),
    }
}

fn heat(text: &mut String, report: &GapReport, friction: &FrictionHeat) -> std::fmt::Result {
    let map = &report.deviation;
    writeln!(
        text,
        "\nHeat of friction at {:.0} rpm under {} N, coefficient {}",
        map.rpm,
        shown_to(3, map.force_n),
        shown_to(3, friction.coefficient)
    )?;
    let rises = friction.radii_m.iter().zip(&friction.rise_k);
    let hottest = rises.fold((0.0, 0.0), |most: (f64, f64), (radius_m, rise_k)| {
        if *rise_k > most.1 {
            (*radius_m, *rise_k)
        } else {
            most
        }
    });
    let mm = |m: Option<f64>| decimals_or("unknown", 4, m.map(|m| 1e3 * m));
    let speed =
        |rpm: Option<f64>| rpm.map_or_else(|| "none".to_owned(), |rpm| format!("{rpm:.1} rpm"));
    let forces = friction
        .pad_forces_n
        .iter()
        .map(|force| shown_to(3, *force));
    let forces = forces.collect::<Vec<_>>().join("  ");
    let rows = [
        (
            "power",
            format!(
                "{} W, of which {} W heat the blade",
                shown_to(3, friction.power_w),
                shown_to(3, friction.heat_share * friction.power_w)
            ),
        ),
        (
            "largest rise",
            format!(
                "{} K at a radius of {} m",
                shown_to(3, hottest.1),
                shown_to(3, hottest.0)
            ),
        ),
        (
            "deflection",
            format!(
                "{} mm, without friction {} mm",
                mm(friction.deflection_m),
                mm(friction.cold_deflection_m)
            ),
        ),
        ("pad forces", format!("{forces} N")),
        (
            "first critical speed",
            format!(
                "{}, without friction {} (linear chart)",
                speed(friction.critical_rpm),
                speed(friction.cold_critical_rpm)
            ),
        ),
    ];
    for (name, value) in rows {
        writeln!(text, "  {name:<22}{value}")?;
    }
    let mm = |m: f64| shown_to(4, 1e3 * m);
    for pad in &friction.pads {
        let left = match pad.gap_left_m {
            None => "unknown".to_owned(),
            Some(m) if m < 0.0 => format!("none, pressed in by {} mm", mm(-m)),
            Some(m) => format!("{} mm", mm(m)),
        };
        let name = format!("guides[{}], gap left", pad.guide);
        let ends = [pad.from_radius_m, pad.to_radius_m].map(|m| shown_to(3, 1e3 * m));
        let place = match ends[0] == ends[1] {
            true => format!("{} mm", ends[0]),
            false => format!("{} to {} mm", ends[0], ends[1]),
        };
        writeln!(text, "  {name:<22}{left} (radius {place})")?;
    }
    Ok(())
}

fn half_way(report: &GapReport) -> String {
    let gap = shown_to(3, 1e3 * report.smallest_gap_m);
    match report.half_way_amplitude_m {
        None => format!(
            "The first critical speed inside the gap of {gap} mm is that of the linear chart to 0.1 %"
        ),
        Some(amplitude) => format!(
            "Up to an amplitude of {} mm at the guides (gap {gap} mm) the first critical speed is closer to that of the free blade than to that of the linear chart",
            shown_to(4, 1e3 * amplitude)
        ),
    }
}

fn row(name: &str, at: &AtAmplitude) -> String {
    let share = at.stiffness_shares.iter().copied().fold(0.0, f64::max);
    format!(
        "{name:>11} {:>9} % {:>16} {:>15} {:>7}",
        shown_to(3, 1e2 * share),
        decimals_or("none", 1, at.critical_rpm.first().copied()),
        decimals_or("none", 1, at.flutter_speed_rpm),
        at.instabilities.len()
    )
}

/// The tables list every third force and gap; the report contains all of them.
const EVERY: usize = 3;

/// Whether a row is in the tables: the first, which is that of linear guides, and every third gap.
fn is_shown(row: usize) -> bool {
    row == 0 || (row - 1).is_multiple_of(EVERY)
}

fn deviation(text: &mut String, report: &GapReport) -> std::fmt::Result {
    let map = &report.deviation;
    writeln!(
        text,
        "\nDeflection of the rim at the cut at {:.0} rpm [mm] under a side force of",
        map.rpm
    )?;
    let forces = map.forces_n.iter().step_by(EVERY);
    let heads = forces.map(|force| format!("{:>9}", format!("{} N", shown_to(3, *force))));
    writeln!(text, "  gap [mm] {}", heads.collect::<String>())?;
    let rows = map.gap_factors.iter().zip(&map.deflection_m).enumerate();
    for (_, (factor, deflections)) in rows.filter(|(row, _)| is_shown(*row)) {
        let gap = match *factor == 0.0 {
            true => "linear".to_owned(),
            false => shown_to(3, 1e3 * factor * report.smallest_gap_m),
        };
        let cells = deflections.iter().step_by(EVERY);
        let cells = cells.map(|m| format!("{:>9}", decimals_or("-", 4, m.map(|m| 1e3 * m))));
        writeln!(text, "{gap:>10} {}", cells.collect::<String>())?;
    }
    if let Some(limit) = map.max_deflection_m {
        writeln!(
            text,
            "\nLargest side force within {} mm at the cut at {:.0} rpm, and speed under {} N",
            shown_to(3, 1e3 * limit),
            map.rpm,
            shown_to(3, map.force_n)
        )?;
        let within = map.force_within_n.iter().zip(&map.speed_within_rpm);
        let rows = map.gap_factors.iter().zip(within).enumerate();
        for (_, (factor, (force, speed))) in rows.filter(|(row, _)| is_shown(*row)) {
            let gap = match *factor == 0.0 {
                true => "linear guides".to_owned(),
                false => format!(
                    "gap {} mm",
                    shown_to(3, 1e3 * factor * report.smallest_gap_m)
                ),
            };
            let [first, last] = [map.forces_n.first(), map.forces_n.last()]
                .map(|force| force.map_or(0.0, |force| force.abs()));
            let force = match force {
                None => format!("less than {} N", shown_to(3, first)),
                Some(force) if *force >= last => format!("{} N or more", shown_to(3, last)),
                Some(force) => format!("{} N", shown_to(3, *force)),
            };
            let end = map.speeds_rpm.last().copied().unwrap_or_default();
            let speed = match speed {
                None => "at no speed".to_owned(),
                Some(speed) if *speed >= end => format!("{end:.0} rpm or more"),
                Some(speed) => format!("{speed:.0} rpm"),
            };
            writeln!(text, "  {gap:<18} {force:<18} {speed}")?;
        }
    }
    writeln!(
        text,
        "\nOver the speed under {} N, with the gap of the scene",
        shown_to(3, map.force_n)
    )?;
    writeln!(text, "     [rpm]   deflection [mm]   pad forces [N]")?;
    let series = map.speeds_rpm.iter().zip(&map.deflection_over_speed_m);
    for (k, (rpm, deflection)) in series.enumerate() {
        let forces = map.pad_forces_over_speed_n.iter().filter_map(|pad| pad[k]);
        let shown = decimals_or("leans", 4, deflection.map(|m| 1e3 * m));
        let forces: Vec<String> = forces.map(|force| shown_to(3, force)).collect();
        let line = format!("{rpm:>10.0} {shown:>17}   {}", forces.join("  "));
        writeln!(text, "{}", line.trim_end())?;
    }
    Ok(())
}
