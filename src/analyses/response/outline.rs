//! The text of a response.

use super::{ResponseLine, ResponseReport};
use crate::page::outline::{Column, FREQUENCY, Fact, LENGTH, Outline, SPEED, Table};
use crate::page::text::shown_to;

pub fn outline(report: &ResponseReport) -> Outline {
    let mut text = Outline::of(
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    );
    text.headline(verdict(report));
    text.facts("", report.lines.iter().map(largest));
    text.table(amplitudes(report));
    for line in &report.lines {
        text.table(resonances(line));
    }
    if let Some(points) = &report.points {
        let known = points.receptance_m_per_n.iter().zip(&points.frequency_hz);
        let known = known.filter_map(|(m, hz)| Some(((*m)?, *hz)));
        let largest = known.max_by(|a, b| a.0.total_cmp(&b.0));
        let amplitude = match largest {
            None => "no steady state, the saw is unstable".to_owned(),
            Some((m, hz)) => format!(
                "at most {} mm/N, at {} Hz",
                shown_to(4, 1e3 * m),
                shown_to(5, hz)
            ),
        };
        text.sentence(format!(
            "Force to probe at {:.0} rpm: {amplitude}",
            points.rpm
        ));
    }
    text.remarks("Warning", &report.warnings);
    text
}

fn verdict(report: &ResponseReport) -> String {
    let Some(operating) = &report.operating else {
        let known = report.rpm.iter().zip(&report.board_deviation_m);
        let known = known.filter_map(|(rpm, m)| Some(((*m)?, *rpm)));
        return match known.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((m, rpm)) => format!(
                "Sawing deviation: at most {} mm, at {rpm:.0} rpm (all excitations added; the sweep contains no operating_rpm)",
                shown_to(3, 1e3 * m)
            ),
            None => "No steady state at any speed of the sweep".to_owned(),
        };
    };
    match operating.board_deviation_m {
        Some(deviation) => format!(
            "Sawing deviation at {:.0} rpm: at most {} mm (all excitations added)",
            operating.rpm,
            shown_to(3, 1e3 * deviation)
        ),
        None => format!(
            "No steady state at {:.0} rpm: the saw is unstable, or its deflection is beyond the linear model",
            operating.rpm
        ),
    }
}

/// The largest amplitude of an excitation at the probe.
fn largest(line: &ResponseLine) -> Fact {
    let known = line.amplitude_m.iter().flatten().copied();
    let name = format!("largest at the probe, {}", line.name);
    Fact::new(name, LENGTH.digits(4, known.reduce(f64::max)).or("none"))
}

/// Amplitude of each excitation at the probe, at the first speed and at the operating speed.
fn amplitudes(report: &ResponseReport) -> Table {
    let operating = report.operating.as_ref();
    let columns = [
        Column::words("excitation"),
        Column::of(format!("{:.0} rpm", report.from_rpm), &LENGTH),
        Column::of(
            operating.map_or("operating".to_owned(), |o| format!("{:.0} rpm", o.rpm)),
            &LENGTH,
        ),
    ];
    let rows = report.lines.iter().enumerate().map(|(place, line)| {
        let at_rest = line.amplitude_m.first().copied().flatten();
        let at_operating = operating.and_then(|o| o.amplitude_m.get(place).copied().flatten());
        [
            line.name.clone().into(),
            LENGTH.digits(4, at_rest),
            LENGTH.digits(4, at_operating),
        ]
    });
    Table::new("Amplitude at the probe", columns)
        .showing(usize::MAX)
        .with_rows(rows)
}

fn resonances(line: &ResponseLine) -> Table {
    let columns = [
        Column::of("speed", &SPEED),
        Column::of("frequency", &FREQUENCY),
        Column::of("amplitude", &LENGTH),
    ];
    let rows = line.resonances.iter().map(|resonance| {
        [
            SPEED.fixed(1, resonance.rpm),
            FREQUENCY.fixed(2, resonance.frequency_hz),
            LENGTH
                .digits(4, resonance.amplitude_m)
                .or("unbounded, or beyond the model"),
        ]
    });
    Table::new(format!("Resonances, {}", line.name), columns)
        .in_file("response.json")
        .with_rows(rows)
}
