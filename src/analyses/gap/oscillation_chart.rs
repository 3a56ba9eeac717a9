//! Oscillation of the blade between guides with a gap, over the speed: amplitudes of the harmonics at the probe, and
//! mean and amplitude of the deflection at the cut.

use super::oscillation_report::{Oscillation, OscillationLine};
use super::report::GapReport;
use crate::page::figure::axis::{Spread, extremes};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Area, Item, Line, Role, Upright, series};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, HAIRLINE};
use crate::page::text::shown_to;

/// Share of the colour of speeds without a motion.
const UNKNOWN_TINT: f64 = 0.4;
/// Share of the colour of the deflections between mean and amplitude.
const AMPLITUDE_TINT: f64 = 0.16;
/// Colours of the harmonics.
const HUES: [Hue; 6] = [
    Hue::Forward,
    Hue::Backward,
    Hue::Divergence,
    Hue::Flutter,
    Hue::Standing,
    Hue::Ink,
];
/// Largest number of decades between the lower end of the axis of amplitudes and the largest amplitude.
const DECADES: i32 = 4;

/// Both panels, as numbers; `None` without an oscillation.
pub fn chart(report: &GapReport) -> Option<ChartData> {
    let found = report.oscillation.as_ref()?;
    let last = found.rpm.last().copied().unwrap_or(1.0);
    let speed = AxisData::speed().within([0.0, last]);
    let map_speed = Item::Upright(Upright {
        x: report.deviation.rpm,
        role: Role::Guide,
        colour: Hue::Alarm,
        dashed: true,
        label: String::new(),
        name: "speed of the map".to_owned(),
    });
    let panel = |y: AxisData, share: f64, items: Vec<Item>| PanelData {
        share,
        ..PanelData::new(
            speed.clone(),
            y.clone(),
            [
                vec![Item::Area(unknown(found, &y))],
                items,
                vec![map_speed.clone()],
            ]
            .concat(),
        )
    };
    let parts: Vec<Item> = found
        .lines
        .iter()
        .zip(HUES)
        .map(|(line, hue)| part(found, line, hue))
        .collect();
    let mut chart = ChartData::new(
        "Oscillation between guides with a gap",
        facts(report, found),
        vec![
            panel(amplitudes(found), 0.8, parts.clone()),
            panel(deflections(found), 0.7, at_the_cut(report, found, last)),
        ],
    );
    let samples = chart.panels[1].items.iter().filter(|item| match item {
        Item::Line(line) => line.width != HAIRLINE && !line.name.is_empty(),
        _ => true,
    });
    chart.key = parts.iter().chain(samples).map(Item::sample).collect();
    chart.key.dedup();
    Some(chart)
}

fn facts(report: &GapReport, found: &Oscillation) -> Vec<String> {
    let force = (found.oscillating_order > 0).then(|| {
        format!(
            "{} N oscillating with {}×",
            shown_to(3, found.oscillating_force_n),
            found.oscillating_order
        )
    });
    let place = report.scene.side_force_place_in_words();
    let steady = format!("{} N steady {place}", shown_to(3, found.force_n));
    let gap = format!(
        "smallest gap {} mm",
        shown_to(3, 1e3 * report.smallest_gap_m)
    );
    let all = [
        Some(heading::of_saw(&report.scene.name, &report.condition)),
        Some(gap),
        Some(steady),
        force,
    ];
    all.into_iter().flatten().collect()
}

/// Speeds without a motion, over the height of an axis.
fn unknown(found: &Oscillation, y: &AxisData) -> Area {
    let [low, high] = y.range.unwrap_or([0.0, 1.0]);
    let columns = found
        .rpm
        .iter()
        .zip(&found.probe_mean_m)
        .map(|(rpm, mean)| match mean {
            Some(_) => [*rpm, f64::NAN, f64::NAN],
            None => [*rpm, low, high],
        });
    let name = "no stable motion, or beyond the thickness";
    Area {
        tint: UNKNOWN_TINT,
        ..Area::new(columns, Hue::Blank, name)
    }
}

fn amplitudes(found: &Oscillation) -> AxisData {
    let all = found.lines.iter().flat_map(|line| &line.probe_m).flatten();
    let [low, high] = extremes(all.map(|m| 1e3 * m).filter(|mm| *mm > 0.0));
    let ends = if high > 0.0 {
        [low.max(high * 10f64.powi(-DECADES)) / 1.5, 1.5 * high]
    } else {
        [1e-3, 1.0]
    };
    let axis = AxisData::new("parts at the probe", "mm").within(ends);
    axis.spread(Spread::Logarithmic)
}

/// A harmonic; it is dashed if it is caused by contact alone.
fn part(found: &Oscillation, line: &OscillationLine, hue: Hue) -> Item {
    let is_contact = line.name == "contact";
    let name = format!("{}× {}", line.order, line.name);
    Item::Line(Line {
        width: if is_contact { CURVE } else { 1.4 * CURVE },
        dashed: is_contact,
        ..Line::new(series(&found.rpm, &line.probe_m, 1e3), hue, &name)
    })
}

/// Mean deflection at the cut minus or plus its amplitude, in mm for each speed; NaN where there is no motion.
fn cut_mm(found: &Oscillation, side: f64) -> impl Iterator<Item = f64> {
    let both = found.cut_mean_m.iter().zip(&found.cut_amplitude_m);
    both.map(move |(mean, amplitude)| match (mean, amplitude) {
        (Some(mean), Some(amplitude)) => 1e3 * (mean + side * amplitude),
        _ => f64::NAN,
    })
}

fn deflections(found: &Oscillation) -> AxisData {
    let ends = [-1.0, 1.0].map(|side| cut_mm(found, side).filter(|mm| mm.is_finite()));
    let [low, high] = ends.map(|values| extremes(values.chain([0.0])));
    let room = 0.08 * (high[1] - low[0]).max(1e-6);
    AxisData::new("deflection at the cut", "mm").within([low[0] - room, high[1] + room])
}

fn at_the_cut(report: &GapReport, found: &Oscillation, last: f64) -> Vec<Item> {
    let points = |side| found.rpm.iter().zip(cut_mm(found, side));
    let curve = |side, width, tint, name| {
        let points = points(side).map(|(rpm, mm)| [*rpm, mm]);
        Item::Line(Line {
            width,
            tint,
            ..Line::new(points, Hue::Forward, name)
        })
    };
    let between = points(-1.0)
        .zip(cut_mm(found, 1.0))
        .map(|((rpm, low), high)| [*rpm, low, high]);
    let between = Area {
        tint: AMPLITUDE_TINT,
        stepped: false,
        ..Area::new(between, Hue::Forward, "mean ± amplitude")
    };
    let zero = Line {
        width: HAIRLINE,
        ..Line::new([[0.0, 0.0], [last, 0.0]], Hue::Ink, "")
    };
    let limits = report
        .deviation
        .max_deflection_m
        .into_iter()
        .flat_map(|m| [1e3 * m, -1e3 * m])
        .map(|mm| {
            let ends = [[0.0, mm], [last, mm]];
            Item::Line(Line {
                width: CURVE,
                ..Line::guide(ends, Hue::Alarm, "largest deflection allowed")
            })
        });
    let curves = [
        Item::Area(between),
        Item::Line(zero),
        curve(1.0, HAIRLINE, 0.6, "mean ± amplitude"),
        curve(-1.0, HAIRLINE, 0.6, "mean ± amplitude"),
        curve(0.0, 1.4 * CURVE, 1.0, "mean at the cut"),
    ];
    curves.into_iter().chain(limits).collect()
}
