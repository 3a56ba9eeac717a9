//! The text of a response.

use super::report::{FrequencyResponse, ResponseLine, ResponseReport, SteadyState};
use crate::model::scene::ForceCause;
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
        if let Some(error) = line.resonance_error {
            text.sentence(format!(
                "On a larger basis these speeds change by at most {} %",
                shown_to(2, 1e2 * error)
            ));
        }
    }
    if let Some(points) = &report.points {
        text.sentence(force_to_probe(points));
    }
    text.remarks("Warning", &report.warnings);
    text
}

/// Number of frequencies that a sentence names.
const FIRST: usize = 4;

/// The largest deflection for a force of 1 N at one speed.
fn force_to_probe(points: &FrequencyResponse) -> String {
    let known = points
        .receptance_m_per_n
        .iter()
        .zip(&points.frequency_hz)
        .filter_map(|(m, hz)| Some(((*m)?, *hz)));
    let largest = known.max_by(|a, b| a.0.total_cmp(&b.0));
    let unbounded = points.unbounded_hz.iter();
    let first: Vec<String> = unbounded.take(FIRST).map(|hz| shown_to(5, *hz)).collect();
    let amplitude = match largest {
        _ if !first.is_empty() => {
            let more = match points.unbounded_hz.len() - first.len() {
                0 => String::new(),
                more => format!(" and {more} more natural frequencies"),
            };
            let first = first.join(", ");
            format!("unbounded at {first} Hz{more}, because nothing dissipates energy")
        }
        None => "no steady state, the saw is unstable".to_owned(),
        Some((m, hz)) => format!(
            "at most {} mm/N, at {} Hz",
            shown_to(4, 1e3 * m),
            shown_to(5, hz)
        ),
    };
    format!("Force to probe at {:.0} rpm: {amplitude}", points.rpm)
}

/// The deflection at the cut at the operating speed, in one sentence.
pub fn verdict(report: &ResponseReport) -> String {
    let Some(operating) = &report.operating else {
        let known = report
            .rpm
            .iter()
            .zip(&report.board_deviation_m)
            .filter_map(|(rpm, m)| Some(((*m)?, *rpm)));
        let mut resonances = report.lines.iter().flat_map(|line| &line.resonances);
        let first = resonances.clone().map(|at| at.rpm).reduce(f64::min);
        let largest = match (known.max_by(|a, b| a.0.total_cmp(&b.0)), first) {
            (None, _) => return "No steady state at any speed of the sweep".to_owned(),
            (_, Some(first)) if resonances.any(|at| at.amplitude_m.is_none()) => {
                format!("without an amplitude at resonances, the first at {first:.0} rpm")
            }
            (Some((m, rpm)), _) => format!("at most {} mm, at {rpm:.0} rpm", shown_to(3, 1e3 * m)),
        };
        return match report.constant_force_cause {
            Some(ForceCause::Assumed) => format!(
                "Deflection at the cut under {} N: {largest} (the sweep contains no operating_rpm)",
                shown_to(3, report.constant_force_n)
            ),
            _ => format!(
                "Sawing deviation: {largest} (all excitations added; the sweep contains no operating_rpm)"
            ),
        };
    };
    let is_still = report.lines.iter().all(|line| line.order == 0);
    if let Some(constant) = &operating.constant
        && (is_still || constant.deflection_m.is_none())
    {
        return constant.in_words();
    }
    match (operating.board_deviation_m, operating.steady_state) {
        (Some(deviation), _) => format!(
            "Sawing deviation at {:.0} rpm: at most {} mm (all excitations added)",
            operating.rpm,
            shown_to(3, 1e3 * deviation)
        ),
        (None, SteadyState::None) => {
            format!(
                "No steady state at {:.0} rpm: the saw is unstable",
                operating.rpm
            )
        }
        (None, state) => format!(
            "Sawing deviation at {:.0} rpm: {}",
            operating.rpm,
            state.said()
        ),
    }
}

/// The largest amplitude of an excitation at the probe, or that it is not bounded.
fn largest(line: &ResponseLine) -> Fact {
    let name = format!("largest at the probe, {}", line.name);
    let beyond = line
        .resonances
        .iter()
        .map(|at| at.steady_state)
        .filter(|state| matches!(state, SteadyState::Unbounded | SteadyState::BeyondModel));
    let known = line.amplitude_m.iter().flatten().copied();
    let value = match beyond.min_by_key(|state| *state as u8) {
        Some(state) => state.said().into(),
        None => LENGTH.digits(4, known.reduce(f64::max)).or("none"),
    };
    Fact::new(name, value)
}

/// Amplitude of each excitation at the probe, at the first speed and at the operating speed.
fn amplitudes(report: &ResponseReport) -> Table {
    let operating = report.operating.as_ref();
    let speeds = [report.from_rpm]
        .into_iter()
        .chain(operating.map(|at| at.rpm));
    let amplitude = |rpm: f64| Column::of(format!("{rpm:.0} rpm"), &LENGTH);
    let columns = [Column::words("excitation")]
        .into_iter()
        .chain(speeds.map(amplitude));
    let mut table = Table::new("Amplitude at the probe", columns).showing(usize::MAX);
    for (place, line) in report.lines.iter().enumerate() {
        let first = line.amplitude_m.first().copied().flatten();
        let at_operating = operating.map(|at| at.amplitude_m.get(place).copied().flatten());
        let cells = [first].into_iter().chain(at_operating);
        let name = line.name.clone().into();
        table.row([name].into_iter().chain(cells.map(|m| LENGTH.digits(4, m))));
    }
    table
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
                .or(resonance.steady_state.said()),
        ]
    });
    Table::new(format!("Resonances, {}", line.name), columns)
        .in_file("response.json")
        .with_rows(rows)
}
