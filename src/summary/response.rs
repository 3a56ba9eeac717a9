//! The summary of a response.

use std::fmt::Write;

use super::{ROWS, each, heading, more, sentence};
use crate::analyses::response::{ResponseLine, ResponseReport};
use crate::text::shown_to;

pub fn of_report(text: &mut String, report: &ResponseReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    sentence(text, &verdict(report))?;
    writeln!(text, "\nAmplitude at the probe [mm]")?;
    let rest = report.lines.iter().map(|line| line.amplitude_m.first());
    writeln!(
        text,
        "  {:<26} {:>12} {:>12} {:>12}",
        "",
        format!("{:.0} rpm", report.from_rpm),
        report
            .operating
            .as_ref()
            .map_or("operating".to_owned(), |o| format!("{:.0} rpm", o.rpm)),
        "largest"
    )?;
    for (place, (line, rest)) in report.lines.iter().zip(rest).enumerate() {
        let operating = report.operating.as_ref();
        let operating = operating.and_then(|o| o.amplitude_m.get(place).copied().flatten());
        let known = line.amplitude_m.iter().flatten().copied();
        writeln!(
            text,
            "  {:<26} {:>12} {:>12} {:>12}",
            line.name,
            millimetres(rest.copied().flatten()),
            millimetres(operating),
            millimetres(known.reduce(f64::max)),
        )?;
    }
    for line in &report.lines {
        resonances(text, line)?;
    }
    if let Some(points) = &report.points {
        let known = points.receptance_m_per_n.iter().zip(&points.frequency_hz);
        let known = known.filter_map(|(m, hz)| Some(((*m)?, *hz)));
        let largest = known.max_by(|a, b| a.0.total_cmp(&b.0));
        let amplitude = match largest {
            None => "the saw is unstable, no steady state".to_owned(),
            Some((m, hz)) => format!(
                "at most {} mm/N, at {} Hz",
                shown_to(4, 1e3 * m),
                shown_to(5, hz)
            ),
        };
        let rpm = points.rpm;
        writeln!(text, "\nForce to probe at {rpm:.0} rpm: {amplitude}")?;
    }
    writeln!(text)?;
    each(text, "Warning", &report.warnings)
}

fn verdict(report: &ResponseReport) -> String {
    match &report.operating {
        Some(operating) => match operating.board_deviation_m {
            Some(deviation) => format!(
                "The board deviates by at most {} mm at {:.0} rpm (sum of all causes)",
                shown_to(3, 1e3 * deviation),
                operating.rpm
            ),
            None => format!(
                "No steady state is known at {:.0} rpm: the saw is unstable, or its deflection is beyond the linear model",
                operating.rpm
            ),
        },
        None => {
            let known = report.rpm.iter().zip(&report.board_deviation_m);
            let known = known.filter_map(|(rpm, m)| Some(((*m)?, *rpm)));
            match known.max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((m, rpm)) => format!(
                    "The board deviates by at most {} mm, at {rpm:.0} rpm (the sweep contains no operating_rpm)",
                    shown_to(3, 1e3 * m)
                ),
                None => "No steady state is known at any speed of the sweep".to_owned(),
            }
        }
    }
}

fn millimetres(metres: Option<f64>) -> String {
    metres.map_or("–".to_owned(), |m| shown_to(4, 1e3 * m))
}

fn resonances(text: &mut String, line: &ResponseLine) -> std::fmt::Result {
    if line.resonances.is_empty() {
        return Ok(());
    }
    writeln!(text, "\nResonances, {}", line.name)?;
    for resonance in line.resonances.iter().take(ROWS) {
        let amplitude = match resonance.amplitude_m {
            Some(m) => format!("{} mm", shown_to(4, 1e3 * m)),
            None => "grows without bound, or beyond the model".to_owned(),
        };
        writeln!(
            text,
            "  {:>9.1} rpm {:>9.2} Hz   {amplitude}",
            resonance.rpm, resonance.frequency_hz
        )?;
    }
    more(text, line.resonances.len(), ROWS, "response.json")
}
