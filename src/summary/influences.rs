//! Rolled bands, light gap, limits of heat, and effects of the numbers of the scene on the speeds.

use std::fmt::{Result, Write};

use crate::report::{InstabilityBand, Report, ToleratedRise};
use crate::text::shown_to;

/// Writes position and width of the rolled bands, their eigenstrain, and the equivalent depth of a groove.
pub fn rolled(text: &mut String, report: &Report) -> Result {
    for band in report.membrane.iter().flat_map(|m| &m.roll_bands) {
        writeln!(
            text,
            "Rolled band at {} mm, {} mm wide: eigenstrain {},\n  as a groove {} µm deep on each face",
            shown_to(4, 1e3 * band.radius_m),
            shown_to(3, 1e3 * band.width_m),
            shown_to(3, band.eigenstrain),
            shown_to(3, 1e6 * band.groove_depth_m)
        )?;
    }
    Ok(())
}

/// Writes the computed light gap under the straight edge, and the rolling that follows from a measured one.
pub fn straight_edge(text: &mut String, report: &Report) -> Result {
    let membrane = report.membrane.as_ref();
    let Some(edge) = membrane.and_then(|m| m.straight_edge.as_ref()) else {
        return Ok(());
    };
    let mm = |length_m: f64| shown_to(3, 1e3 * length_m);
    writeln!(
        text,
        "Straight edge of {} mm, blade level on two points at {} mm:",
        shown_to(4, 1e3 * edge.length_m),
        shown_to(4, 1e3 * edge.support_radius_m)
    )?;
    match edge.gap_m {
        Some(gap_m) => writeln!(text, "  light gap {} mm at the bore", mm(gap_m))?,
        None => writeln!(text, "  the blade buckles, so that it has no light gap")?,
    }
    if let Some(factor) = edge.buckling_factor {
        writeln!(
            text,
            "  without rolling {} mm; {} times the rolling buckles the blade",
            mm(edge.gap_without_rolling_m),
            shown_to(3, factor)
        )?;
    }
    let Some(measured) = &edge.measured else {
        return Ok(());
    };
    writeln!(
        text,
        "  measured {} mm: {} times the rolling,",
        mm(measured.gap_m),
        shown_to(3, measured.factor)
    )?;
    for band in &measured.roll_bands {
        writeln!(
            text,
            "    eigenstrain {} at {} mm, as a groove {} µm deep on each face",
            shown_to(3, band.eigenstrain),
            shown_to(4, 1e3 * band.radius_m),
            shown_to(3, 1e6 * band.groove_depth_m)
        )?;
    }
    Ok(())
}

/// Writes the peak temperature rises at which the operating speed becomes critical and the blade buckles, for
/// the temperature profile of the scene.
pub fn heat(text: &mut String, report: &Report) -> Result {
    let heat = report.membrane.as_ref().and_then(|m| m.heat.as_ref());
    let Some(heat) = heat else {
        return Ok(());
    };
    writeln!(text, "Heat, peak of the profile now {:+.1} K:", heat.rise_k)?;
    if let Some(limit) = &heat.operating_limit {
        writeln!(
            text,
            "  {:+.1} K brings the first critical speed down to the operating speed\n    ({})",
            limit.rise_k, limit.name
        )?;
    } else if heat.past_critical_when_cold {
        writeln!(
            text,
            "  the operating speed is critical even for the cold blade"
        )?;
    } else if report.operating.is_some() && !heat.buckles_first {
        writeln!(
            text,
            "  it never brings a critical speed down to the operating speed"
        )?;
    }
    if let Some(limit) = &heat.flat_from {
        let ToleratedRise { rise_k, name, .. } = limit;
        writeln!(
            text,
            "  below {rise_k:+.1} K it is buckled at rest ({name})"
        )?;
    }
    match &heat.buckling {
        Some(limit) => writeln!(
            text,
            "  {:+.1} K buckles the blade at rest{}\n    ({})",
            limit.rise_k,
            match heat.buckles_first {
                true => ", before a critical speed is that low",
                false => "",
            },
            limit.name
        ),
        None => writeln!(text, "  it never buckles the blade at rest"),
    }
}

/// Writes the relative changes of the first critical speed and of the flutter speed by a change of each number
/// of the scene.
pub fn sensitivity(text: &mut String, report: &Report) -> Result {
    if report.sensitivities.is_empty() {
        return Ok(());
    }
    let begins = |b: &InstabilityBand| Some(b.from_rpm) == report.flutter_speed_rpm;
    let flutter = report.instabilities.iter().position(begins);
    writeln!(
        text,
        "\nInfluences on the first critical speed, and the flutter speed"
    )?;
    for entry in &report.sensitivities {
        let critical = entry.critical_speeds_percent.first().copied();
        let onset = flutter.and_then(|i| entry.onsets_percent.get(i).copied().flatten());
        let percent = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:+.3} %"));
        writeln!(
            text,
            "  {:<8} more {:<36} {:>11} {:>11}",
            entry.change,
            entry.parameter,
            percent(critical),
            percent(onset)
        )?;
    }
    Ok(())
}
