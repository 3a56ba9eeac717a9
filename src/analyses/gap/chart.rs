//! Speeds over the amplitude at guides with a gap, and the deflection at the cut over the gap.

use super::report::{AtAmplitude, GapReport};
use crate::analyses::campbell::InstabilityKind;
use crate::page::figure::axis::{Axis, Spread, extremes, tick_label};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Points, Role, Shape, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, HAIRLINE};
use crate::page::text::shown_to;

/// Share of a logarithmic axis at its ends for the free blade and for linear guides, which have no place on the axis.
const BESIDE: f64 = 0.09;
/// Place of these within the share, from the end of the axis.
const WITHIN: f64 = 0.4;
/// Distance of the ticks of the amplitude, on an axis of usual length.
const TICKS: (f64, f64) = (60.0, 850.0);
/// Every third force has a curve.
const EVERY: usize = 3;
/// Width of the stroke of a band.
const BAND: f64 = 7.0;
const DOT_SIZE: f64 = 5.2;
const FLUTTER_SIZE: f64 = 9.0;
const LINEAR_SIZE: f64 = 7.0;

/// Speeds over the amplitude, and deflections over the gap, as numbers.
pub fn chart(report: &GapReport) -> ChartData {
    ChartData {
        key: key(report),
        ..ChartData::new(
            &report.scene.name,
            facts(report),
            vec![speeds(report), deflections(report)],
        )
    }
}

fn facts(report: &GapReport) -> Vec<String> {
    let gap = format!(
        "smallest gap {} mm",
        shown_to(3, 1e3 * report.smallest_gap_m)
    );
    let half = report.half_way_amplitude_m.map(|m| {
        format!(
            "first critical speed half way at an amplitude of {} mm",
            shown_to(4, 1e3 * m)
        )
    });
    let map = format!(
        "deflection of the rim at {}°, {:.0} rpm",
        report.deviation.angle_deg, report.deviation.rpm
    );
    let saw = report.condition.clone();
    [Some(saw), Some(gap), half, Some(map)]
        .into_iter()
        .flatten()
        .collect()
}

/// A logarithmic axis with places for what lies beyond its ends.
struct Beyond {
    /// Ends of the values, and of the axis.
    values: [f64; 2],
    ends: [f64; 2],
    /// Places before the first and after the last value.
    before: f64,
    after: f64,
}

impl Beyond {
    /// The axis of some positive values, with room at one end or at both.
    fn of(values: impl Iterator<Item = f64>, sides: [bool; 2]) -> Self {
        let [low, high] = match extremes(values) {
            [low, high] if low > 0.0 && high.is_finite() => [low, high.max(1.1 * low)],
            _ => [1.0, 10.0],
        };
        let shares = sides.map(|side| if side { BESIDE } else { 0.0 });
        let length = (high / low).ln() / (1.0 - shares[0] - shares[1]);
        let [before, after] = shares.map(|share| (share * length).exp());
        let within = 1.0 - WITHIN;
        Beyond {
            values: [low, high],
            ends: [low / before, high * after],
            before: low / before.powf(within),
            after: high * after.powf(within),
        }
    }

    fn axis(&self, name: &str, unit: &str) -> AxisData {
        let axis = AxisData::new(name, unit).within(self.ends);
        axis.spread(Spread::Logarithmic)
    }
}

/// Difference of the amplitude and the smallest gap in µm; `None` without an amplitude.
fn beyond_um(report: &GapReport, at: &AtAmplitude) -> Option<f64> {
    Some(1e6 * (at.amplitude_m? - report.smallest_gap_m))
}

fn speeds(report: &GapReport) -> PanelData {
    let amplitudes = report.amplitudes.iter();
    let places: Vec<(f64, &AtAmplitude)> = amplitudes
        .filter_map(|at| Some((beyond_um(report, at)?, at)))
        .collect();
    let beyond = Beyond::of(places.iter().map(|(um, _)| *um), [true; 2]);
    let ticks = Axis::new(beyond.values, [0.0, TICKS.1], Spread::Logarithmic)
        .ticks(TICKS.0)
        .into_iter()
        .map(|tick| (tick, tick_label(tick)));
    let free = (beyond.before, "free".to_owned());
    let linear = (beyond.after, "linear".to_owned());
    let axis = beyond
        .axis("amplitude at the guides beyond the gap", "µm")
        .named([free].into_iter().chain(ticks).chain([linear]));
    let columns: Vec<(f64, &AtAmplitude)> = [(beyond.before, &report.free)]
        .into_iter()
        .chain(places)
        .chain([(beyond.after, &report.linear)])
        .collect();
    let mut items: Vec<Item> = half_way(report, beyond.ends).into_iter().collect();
    items.extend(columns.iter().flat_map(|(x, at)| bands(*x, at)));
    items.extend(critical_speeds(&columns));
    let flutter = columns
        .iter()
        .filter_map(|(x, at)| Some([*x, at.flutter_rpm?]));
    items.push(Item::Points(Points {
        shape: Shape::Ring,
        ..Points::new(flutter, Hue::Alarm, FLUTTER_SIZE, "flutter speed")
    }));
    let is_empty = |at: &AtAmplitude| at.critical_rpm.is_empty() && at.instabilities.is_empty();
    let note = if columns.iter().all(|(_, at)| is_empty(at)) {
        "no critical speed and no band within the sweep, at any amplitude"
    } else {
        ""
    };
    let speed = AxisData::speed().within([report.from_rpm, report.to_rpm]);
    PanelData {
        note: note.to_owned(),
        ..PanelData::new(axis, speed, items)
    }
}

/// A line at the amplitude at which the first critical speed is half way.
fn half_way(report: &GapReport, [first, last]: [f64; 2]) -> Option<Item> {
    let um = 1e6 * (report.half_way_amplitude_m? - report.smallest_gap_m);
    Some(Item::Upright(Upright {
        x: um.clamp(first, last),
        role: Role::Guide,
        colour: Hue::Quiet,
        dashed: true,
        label: String::new(),
        name: "first critical speed half way".to_owned(),
    }))
}

fn bands(x: f64, at: &AtAmplitude) -> impl Iterator<Item = Item> {
    at.instabilities.iter().map(move |band| {
        let [_, _, streak] = Hue::of_kind(band.kind);
        let name = format!("{} {:.0}–{:.0} rpm", band.kind, band.from_rpm, band.to_rpm);
        Item::Line(Line {
            width: BAND,
            ..Line::new([[x, band.from_rpm], [x, band.to_rpm]], streak, &name)
        })
    })
}

/// Dots at the critical speeds, with lines from each amplitude to the next.
fn critical_speeds(columns: &[(f64, &AtAmplitude)]) -> Vec<Item> {
    let most = columns.iter().map(|(_, at)| at.critical_rpm.len()).max();
    let of = |k: usize| {
        let points = columns.iter().map(move |(x, at)| {
            let rpm = at.critical_rpm.get(k).copied();
            [*x, rpm.unwrap_or(f64::NAN)]
        });
        let name = "critical speeds";
        let line = Line {
            tint: 0.5,
            width: HAIRLINE,
            ..Line::new(points.clone(), Hue::Forward, name)
        };
        [
            Item::Line(line),
            Item::Points(Points::new(points, Hue::Forward, DOT_SIZE, name)),
        ]
    };
    (0..most.unwrap_or_default()).flat_map(of).collect()
}

fn deflections(report: &GapReport) -> PanelData {
    let map = &report.deviation;
    let gaps_mm: Vec<f64> = map
        .gap_factors
        .iter()
        .map(|f| 1e3 * f * report.smallest_gap_m)
        .collect();
    let above_zero = || gaps_mm.iter().copied().filter(|mm| *mm > 0.0);
    let beyond = Beyond::of(above_zero(), [true, false]);
    let ticks = above_zero().map(|mm| (mm, shown_to(2, mm)));
    let linear = (beyond.before, "linear".to_owned());
    let axis = beyond
        .axis("smallest gap, all gaps in proportion", "mm")
        .named([linear].into_iter().chain(ticks));
    let limit = map.max_deflection_m.map(|m| {
        let ends = beyond.ends.map(|x| [x, 1e3 * m]);
        Item::Line(Line {
            width: CURVE,
            ..Line::guide(ends, Hue::Alarm, "largest deflection allowed")
        })
    });
    let curves = (0..map.forces_n.len())
        .step_by(EVERY)
        .flat_map(|k| under_force(report, k, &gaps_mm, beyond.before));
    PanelData {
        share: 0.75,
        ..PanelData::new(
            axis,
            sizes(report),
            limit.into_iter().chain(curves).collect(),
        )
    }
}

/// The axis of deflections at the cut.
fn sizes(report: &GapReport) -> AxisData {
    let map = &report.deviation;
    let all = map
        .deflection_m
        .iter()
        .flatten()
        .flatten()
        .copied()
        .chain(map.max_deflection_m)
        .map(|m| 1e3 * m.abs());
    let [low, high] = match extremes(all.filter(|mm| *mm > 0.0)) {
        ends if ends[0].is_finite() => ends,
        _ => [1e-3, 1.0],
    };
    let axis = AxisData::new("deflection at the cut", "mm").within([low / 1.3, 1.3 * high]);
    axis.spread(Spread::Logarithmic)
}

/// The deflection under the k-th force: a curve over the gap, and a ring for linear guides.
fn under_force(report: &GapReport, k: usize, gaps_mm: &[f64], linear: f64) -> [Item; 3] {
    let map = &report.deviation;
    let tint = 0.4 + 0.6 * k as f64 / map.forces_n.len() as f64;
    let name = format!("{} N", shown_to(3, map.forces_n[k]));
    let rows = gaps_mm
        .iter()
        .zip(&map.deflection_m)
        .map(|(mm, row)| (*mm, row[k].map_or(f64::NAN, |m| 1e3 * m.abs())));
    let over_gap = rows
        .clone()
        .filter(|(mm, _)| *mm > 0.0)
        .map(<[f64; 2]>::from);
    let of_linear = rows.filter(|(mm, _)| *mm == 0.0).map(|(_, y)| [linear, y]);
    [
        Item::Line(Line {
            tint,
            end: name.clone(),
            ..Line::new(over_gap.clone(), Hue::Forward, &name)
        }),
        Item::Points(Points {
            tint,
            ..Points::new(over_gap, Hue::Forward, DOT_SIZE, &name)
        }),
        Item::Points(Points {
            tint,
            shape: Shape::Ring,
            ..Points::new(of_linear, Hue::Forward, LINEAR_SIZE, &name)
        }),
    ]
}

fn key(report: &GapReport) -> Vec<Item> {
    let limit = report.deviation.max_deflection_m.map(|_| {
        let name = "largest deflection allowed";
        Item::line_sample(CURVE, true, Hue::Alarm, name)
    });
    let half = half_way(report, [1.0, 1.0]);
    let kinds = [InstabilityKind::Divergence, InstabilityKind::Flutter].map(|kind| {
        let [_, _, streak] = Hue::of_kind(kind);
        Item::area_sample(streak, &kind.to_string())
    });
    let critical = Item::points_sample(DOT_SIZE, Shape::Disc, Hue::Forward, "critical speeds");
    let flutter = Item::points_sample(FLUTTER_SIZE, Shape::Ring, Hue::Alarm, "flutter speed");
    [critical]
        .into_iter()
        .chain(kinds)
        .chain([flutter])
        .chain(half)
        .chain(limit)
        .collect()
}
