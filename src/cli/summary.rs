//! The report in words, 80 columns wide.

use std::fmt::Write;

use crate::report::{HeatLimitEntry, InstabilityEntry, InstabilityKind, Report};
use crate::spectrum::{Direction, in_words};

/// Lines of a table before the rest is only counted.
const ROWS: usize = 12;
const WIDTH: usize = 80;

/// What a designer wants to know, from top to bottom.
pub fn summary(report: &Report) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = header(&mut text, report);
    let _ = modes(&mut text, report);
    let _ = critical_speeds(&mut text, report);
    let _ = bands(&mut text, report);
    let _ = verdict(&mut text, report);
    let _ = sensitivity(&mut text, report);
    text
}

fn header(text: &mut String, report: &Report) -> std::fmt::Result {
    let blade = &report.scene.blade;
    writeln!(text, "{}", shortened(&report.scene.name, WIDTH))?;
    writeln!(
        text,
        "{:.1} mm outside, {:.1} mm bore, {:.2} mm thick; {} to {} rpm",
        1e3 * blade.outer_diameter_m,
        1e3 * blade.inner_diameter_m,
        1e3 * blade.thickness_m,
        report.campbell.from_rpm.round(),
        report.campbell.to_rpm.round()
    )
}

fn modes(text: &mut String, report: &Report) -> std::fmt::Result {
    writeln!(text, "\nModes at rest [Hz]")?;
    for mode in report.modes_at_rest.iter().take(8) {
        let name = numbered(mode.branch, &mode.name);
        writeln!(text, "  {:>9.2}  {name}", mode.frequency_hz)?;
    }
    Ok(())
}

/// Number and name of a branch, as at the lines of the Campbell diagram.
fn numbered(branch: Option<usize>, name: &str) -> String {
    match branch {
        Some(number) => format!("{number}: {name}"),
        None => name.to_owned(),
    }
}

fn critical_speeds(text: &mut String, report: &Report) -> std::fmt::Result {
    let speeds = &report.critical_speeds;
    if speeds.is_empty() {
        return writeln!(
            text,
            "\nNo critical speed up to {:.0} rpm",
            report.campbell.to_rpm
        );
    }
    writeln!(text, "\nCritical speeds [rpm]")?;
    for critical in speeds.iter().take(ROWS) {
        let name = numbered(critical.branch, &critical.name);
        writeln!(text, "  {:>9.1}  {name}", critical.rpm)?;
    }
    more(text, speeds.len())
}

fn bands(text: &mut String, report: &Report) -> std::fmt::Result {
    if report.instabilities.is_empty() {
        return writeln!(text, "\nNo instability: stable at every speed of the sweep");
    }
    writeln!(
        text,
        "\nInstabilities        from         to   growth   frequency"
    )?;
    writeln!(
        text,
        "                    [rpm]      [rpm]    [1/s]        [Hz]"
    )?;
    for band in report.instabilities.iter().take(ROWS) {
        writeln!(
            text,
            "  {:<12} {:>10.1} {:>10.1} {:>8.2} {:>11.2}{}",
            kind(band),
            band.from_rpm,
            band.to_rpm,
            band.peak_growth_per_s,
            band.frequency_hz,
            if band.closed { "" } else { "  (goes on)" }
        )?;
    }
    more(text, report.instabilities.len())
}

fn verdict(text: &mut String, report: &Report) -> std::fmt::Result {
    writeln!(text)?;
    let threshold = report.flutter_threshold_per_s;
    match report.flutter_speed_rpm {
        Some(rpm) => writeln!(
            text,
            "Flutter speed: {rpm:.0} rpm (growth of {threshold} 1/s or more)"
        )?,
        None => writeln!(
            text,
            "No flutter of {threshold} 1/s or more up to {:.0} rpm",
            report.campbell.to_rpm
        )?,
    }
    if let Some(rpm) = report.first_merge_rpm {
        writeln!(
            text,
            "First flutter of all, whatever its growth: {rpm:.0} rpm"
        )?;
    }
    operating(text, report)?;
    heat(text, report)?;
    if let Some(error) = report.accuracy.estimated_relative_error {
        writeln!(
            text,
            "Estimated error of the critical speeds: {:.3} % ({} functions)",
            100.0 * error,
            report.accuracy.degrees_of_freedom
        )?;
    }
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    Ok(())
}

fn operating(text: &mut String, report: &Report) -> std::fmt::Result {
    let Some(operating) = &report.operating else {
        return Ok(());
    };
    if let Some(band) = operating
        .inside_instability
        .and_then(|i| report.instabilities.get(i))
    {
        writeln!(
            text,
            "At {:.0} rpm the saw is UNSTABLE: {}",
            operating.rpm,
            kind(band)
        )?;
    }
    let Some(ratio) = operating.of_lowest_critical else {
        return Ok(());
    };
    let verdict = if ratio <= operating.limit {
        "keeps"
    } else {
        "breaks"
    };
    writeln!(
        text,
        "Operating speed {:.0} rpm is {:.0} % of the lowest critical speed:\n  it {verdict} the usual {:.0} % rule (at most {:.0} rpm)",
        operating.rpm,
        100.0 * ratio,
        100.0 * operating.limit,
        operating.limit * operating.rpm / ratio
    )
}

/// How hot the blade may become, on the scene's temperature profile.
fn heat(text: &mut String, report: &Report) -> std::fmt::Result {
    let heat = report.membrane.as_ref().and_then(|m| m.heat.as_ref());
    let Some(heat) = heat else {
        return Ok(());
    };
    writeln!(text, "Heat, peak of the profile now {:+.1} K:", heat.rise_k)?;
    let shape = |limit: &HeatLimitEntry| {
        let (diameters, circles) = (limit.nodal_diameters, limit.nodal_circles);
        in_words(diameters, circles, Direction::Standing)
    };
    if let Some(limit) = &heat.operating_limit {
        writeln!(
            text,
            "  {:+.1} K brings the first critical speed down to the operating speed\n    ({})",
            limit.rise_k,
            shape(limit)
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
        let (rise, shape) = (limit.rise_k, shape(limit));
        writeln!(text, "  below {rise:+.1} K it is buckled at rest ({shape})")?;
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
            shape(limit)
        ),
        None => writeln!(text, "  it never buckles the blade at rest"),
    }
}

fn sensitivity(text: &mut String, report: &Report) -> std::fmt::Result {
    if report.sensitivities.is_empty() {
        return Ok(());
    }
    let flutter = report
        .instabilities
        .iter()
        .position(|b| Some(b.from_rpm) == report.flutter_speed_rpm);
    writeln!(
        text,
        "\nWhat moves the first critical speed, and the flutter speed"
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

fn kind(band: &InstabilityEntry) -> &'static str {
    match band.kind {
        InstabilityKind::Divergence => "divergence",
        InstabilityKind::Flutter => "flutter",
    }
}

fn more(text: &mut String, rows: usize) -> std::fmt::Result {
    match rows.checked_sub(ROWS) {
        Some(rest) if rest > 0 => writeln!(text, "  … and {rest} more in report.json"),
        _ => Ok(()),
    }
}

pub fn shortened(line: &str, width: usize) -> String {
    if line.chars().count() <= width {
        return line.to_owned();
    }
    line.chars().take(width - 1).chain(['…']).collect()
}

/// Breaks a sentence into lines at spaces.
pub fn wrapped(sentence: &str) -> String {
    let mut lines = vec![String::new()];
    for word in sentence.split(' ') {
        let last = lines.last_mut().expect("there is always a line");
        if last.is_empty() {
            *last = word.to_owned();
        } else if last.chars().count() + 1 + word.chars().count() <= WIDTH {
            *last += &format!(" {word}");
        } else {
            lines.push(format!("  {word}"));
        }
    }
    lines.join("\n")
}
