//! The lobe diagram: smallest cutting stiffness at which a vibration grows, over the speed, and its frequency.

use super::WashboardReport;
use crate::analyses::campbell::Verdict;
use crate::page::figure::axis::{Spread, proper_range};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Area, Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::HAIRLINE;
use crate::page::text::shown_to;

/// Diameter of the ring at the cut's own stiffness, and of the dots at frequencies.
const OWN_SIZE: f64 = 12.0;
const DOT_SIZE: f64 = 4.4;
/// Largest number of decades by which the boundary that is shown exceeds the stiffness of the cut and the smallest
/// stiffness of the boundary.
const DECADES: f64 = 2.5;
/// Space below and above the boundary, in decades.
const ROOM: f64 = 0.3;
/// Name of the stiffnesses at which a vibration grows.
const GROWS: &str = "above the smallest stiffness at which a vibration grows";
/// Name of the stiffnesses for which it is not known whether a vibration grows.
const UNKNOWN: &str = "not searched or not confirmed above";

/// The boundary and its frequencies, as numbers.
pub fn chart(report: &WashboardReport) -> ChartData {
    let lobes = &report.lobes;
    let sweep = [lobes.rpm.first(), lobes.rpm.last()];
    let ends = proper_range(sweep.map(|rpm| rpm.copied().unwrap_or(0.0)));
    let speed = AxisData::speed().within(ends);
    let decades = decades(report);
    let per_rpm = report.tooth_passing_hz / report.rpm;
    let shown = lobes.frequency_hz.iter().flatten().copied();
    let top = 1.05 * shown.fold(per_rpm * ends[1], f64::max);
    let own = Points {
        shape: Shape::Ring,
        ..Points::new(
            [[report.rpm, report.stiffness_n_per_m]],
            own_hue(report),
            OWN_SIZE,
            "this cut",
        )
    };
    let stiffness = AxisData::new("lateral cutting stiffness", "N/m").within(decades);
    let boundary = areas(report, decades).into_iter().chain([
        Item::Line(unknown_from(report, decades)),
        Item::Line(boundary(report, decades)),
        Item::Points(own),
    ]);
    let teeth = [
        (0.5, "half the tooth passing frequency"),
        (1.0, "tooth passing frequency"),
    ]
    .map(|(share, name)| {
        let points = ends.map(|rpm| [rpm, share * per_rpm * rpm]);
        Item::Line(Line {
            width: HAIRLINE,
            dashed: true,
            ..Line::new(points, Hue::Quiet, name)
        })
    });
    let at = lobes
        .rpm
        .iter()
        .zip(&lobes.frequency_hz)
        .map(|(rpm, hz)| [*rpm, hz.unwrap_or(f64::NAN)]);
    let dots = Points {
        said: said(report),
        ..Points::new(at, Hue::Flutter, DOT_SIZE, "frequency there")
    };
    let frequencies = teeth.into_iter().chain([Item::Points(dots)]).collect();
    ChartData {
        title: report.scene.name.clone(),
        facts: facts(report),
        panels: vec![
            PanelData::new(
                speed.clone(),
                stiffness.spread(Spread::Logarithmic),
                boundary.collect(),
            ),
            PanelData {
                harmonics: true,
                share: 0.55,
                ..PanelData::new(
                    speed,
                    AxisData::new("frequency there", "Hz").within([0.0, top]),
                    frequencies,
                )
            },
        ],
        columns: 1,
        key: key(report),
    }
}

/// The boundary in a panel from a smallest stiffness on. Where no vibration grows up to the largest stiffness of the search
/// it is interrupted, and where vibrations grow at any stiffness it is below the panel.
fn boundary(report: &WashboardReport, [least, _]: [f64; 2]) -> Line {
    let lobes = &report.lobes;
    let points = lobes
        .rpm
        .iter()
        .zip(&lobes.critical_stiffness_n_per_m)
        .map(|(rpm, k)| [*rpm, k.map_or(f64::NAN, |k| k.max(0.1 * least))]);
    Line {
        said: said(report),
        ..Line::new(points, Hue::Flutter, "a vibration grows above")
    }
}

/// The stiffness above which it is not known whether a vibration grows, at speeds where this is below the boundary.
fn unknown_from(report: &WashboardReport, [least, _]: [f64; 2]) -> Line {
    let lobes = &report.lobes;
    let points = lobes.rpm.iter().enumerate().map(|(k, rpm)| {
        let [from, to] = unknown(report, k);
        let start = if from < to {
            from.max(0.1 * least)
        } else {
            f64::NAN
        };
        [*rpm, start]
    });
    Line {
        width: HAIRLINE,
        dashed: true,
        said: said(report),
        ..Line::new(points, Hue::Quiet, UNKNOWN)
    }
}

/// Ends of the stiffnesses at the k-th speed for which it is not known whether a vibration grows; they are equal if there are
/// none.
fn unknown(report: &WashboardReport, k: usize) -> [f64; 2] {
    let from = report.lobes.stable_to_n_per_m.get(k);
    let to = critical(report, k).unwrap_or(f64::INFINITY);
    [from.copied().unwrap_or(0.0), to]
}

fn critical(report: &WashboardReport, k: usize) -> Option<f64> {
    let lobes = &report.lobes;
    lobes.critical_stiffness_n_per_m.get(k).copied().flatten()
}

/// Description of the boundary at each speed.
fn said(report: &WashboardReport) -> Vec<String> {
    let lobes = &report.lobes;
    let said = lobes.rpm.iter().enumerate().map(|(k, rpm)| {
        let critical =
            critical(report, k).map(|k| format!("a vibration grows above {} N/m", shown_to(3, k)));
        let [from, to] = unknown(report, k);
        let unknown = (from < to).then(|| format!("{UNKNOWN} {} N/m", shown_to(3, from)));
        let hz = lobes
            .frequency_hz
            .get(k)
            .copied()
            .flatten()
            .map(|hz| format!("{hz:.1} Hz"));
        let lines: Vec<String> = [Some(format!("{rpm:.0} rpm")), unknown, critical, hz]
            .into_iter()
            .flatten()
            .collect();
        lines.join("\n")
    });
    said.collect()
}

fn facts(report: &WashboardReport) -> Vec<String> {
    let verdict = match report.growing_mode() {
        Some(mode) => format!(
            "{:.0} rpm: unstable at {:.1} Hz, {:.2} 1/s",
            report.rpm, mode.frequency_hz, mode.growth_per_s
        ),
        None if report.verdict == Verdict::Unstable => format!("{:.0} rpm: unstable", report.rpm),
        None => format!("{:.0} rpm: stable", report.rpm),
    };
    let pitch = report
        .growing_mode()
        .and_then(|mode| mode.pattern_pitch_m)
        .map(|metres| format!("waves of {:.1} mm along the feed", 1e3 * metres));
    let teeth = format!("{:.0} teeth pass in a second", report.tooth_passing_hz);
    let all = [
        Some(report.condition.clone()),
        Some(verdict),
        pitch,
        Some(teeth),
    ];
    all.into_iter().flatten().collect()
}

/// Ends of the axis of stiffness in N/m: whole decades that include the boundary and the stiffness of the cut.
fn decades(report: &WashboardReport) -> [f64; 2] {
    let known = report
        .lobes
        .critical_stiffness_n_per_m
        .iter()
        .flatten()
        .filter(|k| **k > 0.0)
        .map(|k| k.log10());
    let own = report.stiffness_n_per_m.log10();
    let least = known.clone().fold(f64::INFINITY, f64::min);
    let highest = own.max(if least.is_finite() { least } else { own }) + DECADES;
    let most = known.filter(|k| *k <= highest).fold(own, f64::max);
    [(own.min(least) - ROOM).floor(), (most + ROOM).ceil()].map(|log| 10f64.powf(log))
}

/// The unstable stiffnesses, and those for which it is not known whether a vibration grows.
fn areas(report: &WashboardReport, [least, most]: [f64; 2]) -> [Item; 2] {
    let column = |k: usize, [low, high]: [f64; 2]| {
        let rpm = report.lobes.rpm[k];
        [rpm, low.clamp(least, most), high.clamp(least, most)]
    };
    let all = 0..report.lobes.rpm.len();
    let grows = all
        .clone()
        .map(|k| column(k, [unknown(report, k)[1], most]));
    let open = all.map(|k| column(k, unknown(report, k)));
    [
        Item::Area(Area::new(open, Hue::Blank, UNKNOWN)),
        Item::Area(Area::new(grows, Hue::FlutterShade, GROWS)),
    ]
}

fn own_hue(report: &WashboardReport) -> Hue {
    match report.verdict {
        Verdict::Stable => Hue::Ink,
        Verdict::Unstable => Hue::Alarm,
    }
}

fn key(report: &WashboardReport) -> Vec<Item> {
    let [_, most] = decades(report);
    let is_unknown = |k: usize| unknown(report, k)[0] < unknown(report, k)[1].min(most);
    let open = (0..report.lobes.rpm.len())
        .any(is_unknown)
        .then(|| Item::area_sample(Hue::Blank, "not searched, or not confirmed"));
    let others = [
        Item::points_sample(OWN_SIZE, Shape::Ring, own_hue(report), "this cut"),
        Item::line_sample(
            HAIRLINE,
            true,
            Hue::Quiet,
            "tooth passing frequency, and half of it",
        ),
    ];
    let grows = Item::area_sample(Hue::FlutterShade, GROWS);
    [grows].into_iter().chain(open).chain(others).collect()
}
