//! Steady-state amplitude, phase and deviation of the board over the speed; amplitude and phase over the frequency.

use super::report::{FrequencyResponse, ResponseLine, ResponseReport};
use crate::analyses::campbell::InstabilityKind;
use crate::model::scene::ForceCause;
use crate::page::figure::axis::{Spread, extremes};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Points, Role, Shape, Upright, series};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::CURVE;
use crate::page::text::shown_to;

/// Colours of the excitations.
const HUES: [Hue; 6] = [
    Hue::Ink,
    Hue::Forward,
    Hue::Backward,
    Hue::Divergence,
    Hue::Flutter,
    Hue::Standing,
];
/// Largest number of decades between the lower end of an axis of amplitudes and the largest amplitude.
const DECADES: i32 = 6;
/// Heights of the panels of phases and of the board, relative to a panel of usual height.
const LOW: f64 = 0.4;
const BOARD: f64 = 0.55;
/// Diameter of the dots at resonances.
const RESONANCE: f64 = 7.0;

/// Amplitude, phase and deviation of the board over the speed.
pub fn chart(report: &ResponseReport) -> ChartData {
    let speeds = [report.from_rpm, report.to_rpm];
    let speed = AxisData::speed().within(speeds);
    let bands: Vec<Item> = report
        .instabilities
        .iter()
        .map(|b| Item::Band(Band::grown(b, speeds)))
        .collect();
    let all = report.lines.iter().flat_map(|line| &line.amplitude_m);
    let amplitude = amplitudes(
        "amplitude at the probe",
        "mm",
        all.flatten().map(|m| 1e3 * m),
    );
    let top = amplitude.range.map_or(1.0, |[_, top]| top);
    let lines = || report.lines.iter().zip(HUES);
    let amplitudes_of = lines().flat_map(|(line, hue)| {
        let points = series(&report.rpm, &line.amplitude_m, 1e3);
        [
            Item::Line(Line::new(points, hue, &line.name)),
            unknown_resonances(line, hue, top),
        ]
    });
    let phases = lines().map(|(line, hue)| {
        let points = unwound(series(&report.rpm, &line.phase_deg, 1.0));
        Item::Line(Line::new(points, hue, &line.name))
    });
    let known = report.board_deviation_m.iter().flatten();
    let board = amplitudes("board, sum", "mm", known.map(|m| 1e3 * m));
    let deviation = series(&report.rpm, &report.board_deviation_m, 1e3);
    let deviation = Item::Line(Line::new(deviation, Hue::Ink, deviation_name(report)));
    let in_panel = |share: f64, y: AxisData, items: Vec<Item>, is_first: bool| PanelData {
        share,
        ..PanelData::new(
            speed.clone(),
            y,
            [bands.clone(), items, operating(report, is_first)].concat(),
        )
    };
    let mut all = report.lines.iter().flat_map(|line| &line.amplitude_m);
    let note = if all.all(Option::is_none) {
        "no steady state is known at any of these speeds"
    } else {
        ""
    };
    let amplitudes = PanelData {
        note: note.to_owned(),
        ..in_panel(1.0, amplitude, amplitudes_of.collect(), true)
    };
    ChartData {
        title: report.scene.name.clone(),
        facts: facts(report),
        panels: vec![
            amplitudes,
            in_panel(LOW, phase(), phases.collect(), false),
            in_panel(BOARD, board, vec![deviation], false),
        ],
        columns: 1,
        key: key(report),
    }
}

/// Name of the curve of the board, which is that of linear guides.
fn deviation_name(report: &ResponseReport) -> &'static str {
    match report.constant_force_cause {
        _ if report.scene.has_gaps() => "at the cut, with linear guides",
        Some(ForceCause::Assumed) => "deflection at the cut",
        _ => "deviation of the board",
    }
}

fn facts(report: &ResponseReport) -> Vec<String> {
    let probe = format!(
        "probe at {} mm, {}°",
        shown_to(4, 1e3 * report.probe_radius_m),
        shown_to(4, report.probe_angle_deg)
    );
    let cut = format!("cut at {}°", shown_to(4, report.cut_angle_deg));
    let damping = if report.damped {
        "damped"
    } else {
        "without damping: no amplitude at a resonance"
    };
    vec![report.condition.clone(), probe, cut, damping.to_owned()]
}

/// A logarithmic axis for amplitudes, over at least one decade and at most [`DECADES`].
fn amplitudes(name: &str, unit: &str, values: impl Iterator<Item = f64>) -> AxisData {
    let [low, high] = extremes(values.filter(|value| *value > 0.0));
    let ends = if high > 0.0 {
        [
            low.max(high * 10f64.powi(-DECADES)).min(0.1 * high) / 1.5,
            1.5 * high,
        ]
    } else {
        [1e-3, 1.0]
    };
    let axis = AxisData::new(name, unit).within(ends);
    axis.spread(Spread::Logarithmic)
}

/// The axis of phases, with ticks at quarters of a turn.
fn phase() -> AxisData {
    AxisData {
        ticks: vec![-180.0, -90.0, 0.0, 90.0, 180.0],
        ..AxisData::new("phase", "°").within([-180.0, 180.0])
    }
}

/// Phases, interrupted between neighbours that differ by half a turn or more: the phase passes from one end of the axis to
/// the other there.
fn unwound(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = Vec::new();
    for point in points {
        if all
            .last()
            .is_some_and(|last| (last[1] - point[1]).abs() >= 180.0)
        {
            all.push([point[0], f64::NAN]);
        }
        all.push(point);
    }
    all
}

/// Dots at the upper edge, at resonances whose amplitude is not known.
fn unknown_resonances(line: &ResponseLine, hue: Hue, top: f64) -> Item {
    let unknown = line.resonances.iter().filter(|r| r.amplitude_m.is_none());
    let name = format!("{}: resonance without an amplitude", line.name);
    Item::Points(Points::new(
        unknown.map(|r| [r.rpm, top]),
        hue,
        RESONANCE,
        &name,
    ))
}

/// The operating speed, if the sweep contains it.
fn operating(report: &ResponseReport, is_labelled: bool) -> Vec<Item> {
    let within = |rpm: &f64| (report.from_rpm..=report.to_rpm).contains(rpm);
    let line = |rpm: f64| {
        let name = format!("operating {rpm:.0} rpm");
        Item::Upright(Upright {
            x: rpm,
            role: Role::Operating,
            colour: Hue::Alarm,
            dashed: true,
            label: if is_labelled {
                name.clone()
            } else {
                String::new()
            },
            name,
        })
    };
    let at = report.scene.operating_rpm.filter(within);
    at.map(line).into_iter().collect()
}

fn key(report: &ResponseReport) -> Vec<Item> {
    let lines = report
        .lines
        .iter()
        .zip(HUES)
        .map(|(line, hue)| Item::line_sample(CURVE, false, hue, &line.name));
    let mut resonances = report.lines.iter().flat_map(|line| &line.resonances);
    let unknown = resonances
        .any(|resonance| resonance.amplitude_m.is_none())
        .then(|| {
            let name = "resonance without an amplitude";
            Item::points_sample(RESONANCE, Shape::Disc, Hue::Quiet, name)
        });
    let kinds = [InstabilityKind::Divergence, InstabilityKind::Flutter]
        .into_iter()
        .filter(|kind| report.instabilities.iter().any(|band| band.kind == *kind))
        .map(|kind| {
            let [_, shade, _] = Hue::of_kind(kind);
            Item::area_sample(shade, &format!("{kind}: no steady state"))
        });
    lines.chain(unknown).chain(kinds).collect()
}

/// Amplitude and phase over the frequency at one speed; `None` if the report contains no frequency response.
pub fn points_chart(report: &ResponseReport) -> Option<ChartData> {
    let points = report.points.as_ref()?;
    let end = points.frequency_hz.last().copied().unwrap_or(1.0);
    let frequency = AxisData::new("frequency", "Hz").within([0.0, end]);
    let known = points.receptance_m_per_n.iter().flatten();
    let axis = amplitudes("deflection for 1 N", "µm/N", known.map(|m| 1e6 * m));
    let curve =
        |points: Vec<[f64; 2]>, name| vec![Item::Line(Line::new(points, Hue::Forward, name))];
    let receptance = series(&points.frequency_hz, &points.receptance_m_per_n, 1e6).collect();
    let phases = unwound(series(&points.frequency_hz, &points.phase_deg, 1.0));
    let is_unstable = points.receptance_m_per_n.iter().all(Option::is_none);
    let note = if is_unstable {
        "the saw is unstable at this speed: no steady state"
    } else {
        ""
    };
    Some(ChartData {
        title: report.scene.name.clone(),
        facts: points_facts(report, points),
        panels: vec![
            PanelData {
                note: note.to_owned(),
                ..PanelData::new(frequency.clone(), axis, curve(receptance, "receptance"))
            },
            PanelData {
                share: LOW,
                ..PanelData::new(frequency, phase(), curve(phases, "phase"))
            },
        ],
        columns: 1,
        key: Vec::new(),
    })
}

fn points_facts(report: &ResponseReport, points: &FrequencyResponse) -> Vec<String> {
    let place = |radius_m: f64, angle_deg: f64| {
        format!(
            "{} mm, {}°",
            shown_to(4, 1e3 * radius_m),
            shown_to(4, angle_deg)
        )
    };
    vec![
        report.condition.clone(),
        format!("{} rpm", shown_to(6, points.rpm)),
        format!(
            "force at {}",
            place(points.force_radius_m, points.force_angle_deg)
        ),
        format!(
            "probe at {}",
            place(report.probe_radius_m, report.probe_angle_deg)
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_response_without_any_amplitude_has_a_note() {
        let report = include_str!("../../../tests/golden/reports/response-resonance.json");
        let mut report: ResponseReport = serde_json::from_str(report).unwrap();
        assert_eq!(chart(&report).panels[0].note, "");
        for line in &mut report.lines {
            line.amplitude_m.fill(None);
        }
        assert!(chart(&report).panels[0].note.starts_with("no steady state"));
    }
}
