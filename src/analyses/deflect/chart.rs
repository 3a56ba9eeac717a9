//! Equilibria over speed, and the frequencies of small motions about them beside the frequencies of the flat blade.

use super::report::{DeflectReport, EquilibriumCurve, Jump, SlowSweep};
use crate::page::figure::axis::proper_range;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Points, Role, Shape, Upright, lines_by_look};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{HAIRLINE, STRONG_CURVE};
use crate::page::text::shown_to;

const UP: Hue = Hue::Forward;
const DOWN: Hue = Hue::Backward;
/// Diameter of the ring at a fold or bifurcation.
const TURN_SIZE: f64 = 6.0;
/// Share of the colour of the branches of the flat blade in a mixture with that of the paper.
const FLAT_TINT: f64 = 0.6;
/// Width of the curve for rising speed. It is wider than that for falling speed, so that both are visible where they
/// coincide.
const WIDER: f64 = STRONG_CURVE;
const NARROWER: f64 = 1.4;
/// Number of frequencies at the first speed that the diagram includes.
const SHOWN: usize = 6;

/// Equilibria, and the frequencies of small motions about them, as numbers.
pub fn chart(report: &DeflectReport) -> ChartData {
    let speeds = proper_range([report.from_rpm, report.to_rpm]);
    let speed = AxisData::speed().within(speeds);
    let bands: Vec<Item> = report
        .instabilities
        .iter()
        .map(|band| Item::Band(Band::new(band, speeds)))
        .collect();
    ChartData {
        title: report.scene.name.clone(),
        facts: facts(report),
        columns: 1,
        key: key(),
        panels: vec![
            PanelData::new(
                speed.clone(),
                AxisData::new("deflection", "mm").within(reach_mm(report)),
                [bands.clone(), leans(report)].concat(),
            ),
            PanelData {
                harmonics: true,
                ..PanelData::new(
                    speed,
                    AxisData::new("frequency in space", "Hz").within(shown_hz(report)),
                    [bands, frequencies(report)].concat(),
                )
            },
        ],
    }
}

/// Each sweep with its colour, the width of its curve, the size of its dots, and its name.
fn sweeps(report: &DeflectReport) -> [(&SlowSweep, Hue, f64, f64, &'static str); 2] {
    [
        (&report.up, UP, WIDER, 4.4, "stable, while the speed rises"),
        (&report.down, DOWN, NARROWER, 2.2, "while it falls"),
    ]
}

/// The considerable jumps of a sweep.
fn shown_jumps<'a>(
    report: &'a DeflectReport,
    sweep: &'a SlowSweep,
) -> impl Iterator<Item = &'a Jump> {
    let thickness_m = report.scene.blade.thickness_m;
    sweep
        .jumps
        .iter()
        .filter(move |jump| jump.is_considerable(thickness_m))
}

fn facts(report: &DeflectReport) -> Vec<String> {
    let place = report.scene.side_force_place_in_words();
    let force = format!("{} N {place}", report.force_n);
    let probe = format!("deflection at the probe at {}°", report.probe_angle_deg);
    let jumps = |sweep| shown_jumps(report, sweep).count();
    let jumps = format!(
        "jumps: {} while the speed rises, {} while it falls",
        jumps(&report.up),
        jumps(&report.down)
    );
    vec![report.condition.clone(), force, probe, jumps]
}

/// Ends of the axis of deflections in millimetres.
fn reach_mm(report: &DeflectReport) -> [f64; 2] {
    let of_curves = report.curves.iter().flat_map(|curve| &curve.deflection_m);
    let sweeps = [&report.up, &report.down];
    let of_sweeps = sweeps
        .iter()
        .flat_map(|sweep| &sweep.arcs)
        .flat_map(|arc| &arc.deflection_m);
    let most = of_curves
        .chain(of_sweeps)
        .fold(0.0_f64, |most, m| most.max(m.abs()));
    let reach = 1.1e3 * most.max(1e-9);
    [-reach, reach]
}

/// The curves of equilibria, and the parts that are reached while the speed rises and falls.
fn leans(report: &DeflectReport) -> Vec<Item> {
    let mut items: Vec<Item> = report.curves.iter().flat_map(curve_lines).collect();
    for (sweep, colour, width, _, name) in sweeps(report) {
        for arc in &sweep.arcs {
            let points = arc
                .rpm
                .iter()
                .zip(&arc.deflection_m)
                .map(|(rpm, m)| [*rpm, 1e3 * m]);
            let say = |[rpm, mm]: [f64; 2]| format!("{rpm:.1} rpm\n{} mm", shown_to(4, mm));
            items.push(Item::Line(Line {
                width,
                said: points.clone().map(say).collect(),
                ..Line::new(points, colour, name)
            }));
        }
        items.extend(shown_jumps(report, sweep).map(|jump| {
            let ends = [jump.from_m, jump.to_m].map(|m| [jump.rpm, 1e3 * m]);
            Item::Line(Line {
                width: HAIRLINE,
                arrow: true,
                ..Line::new(ends, colour, "jump")
            })
        }));
        items.extend(sweep.valid_until_rpm.map(|rpm| {
            Item::Upright(Upright {
                x: rpm,
                role: Role::Guide,
                colour: Hue::Alarm,
                dashed: false,
                label: String::new(),
                name: "the model ends".to_owned(),
            })
        }));
    }
    let turns = report
        .curves
        .iter()
        .flat_map(|curve| &curve.turns)
        .map(|turn| [turn.rpm, 1e3 * turn.deflection_m]);
    items.push(Item::Points(Points {
        shape: Shape::Ring,
        ..Points::new(turns, Hue::Ink, TURN_SIZE, "fold or bifurcation")
    }));
    items
}

/// Lines of a curve of equilibria: solid where stable, dashed where unstable.
fn curve_lines(curve: &EquilibriumCurve) -> Vec<Item> {
    let is_stable = |k: usize| curve.negative_eigenvalues[k] == 0;
    let found = lines_by_look(curve.rpm.len(), |k| Some(is_stable(k)));
    let lines = found.into_iter().map(|(stable, samples)| {
        let at = |k: usize| [curve.rpm[k], 1e3 * curve.deflection_m[k]];
        let points = samples.into_iter().map(|k| k.map_or([f64::NAN; 2], at));
        let (width, name) = if stable {
            (NARROWER, "stable, not reached")
        } else {
            (HAIRLINE, "unstable")
        };
        Item::Line(Line {
            width,
            dashed: !stable,
            ..Line::new(points, Hue::Standing, name)
        })
    });
    lines.collect()
}

/// Ends of the axis of frequencies in Hz.
fn shown_hz(report: &DeflectReport) -> [f64; 2] {
    let branches = report.campbell.branches.iter();
    let mut at_rest: Vec<f64> = branches
        .filter_map(|branch| branch.frequency_hz.first())
        .copied()
        .collect();
    at_rest.sort_by(f64::total_cmp);
    let top = at_rest.get(SHOWN - 1).or(at_rest.last()).copied();
    [0.0, 1.1 * top.unwrap_or(1.0)]
}

/// Frequencies of the flat blade, and about the equilibria.
fn frequencies(report: &DeflectReport) -> Vec<Item> {
    let branches = report.campbell.branches.iter().map(|branch| {
        let samples = branch
            .rpm
            .iter()
            .zip(&branch.frequency_hz)
            .map(|(rpm, hz)| [*rpm, *hz]);
        Item::Line(Line {
            tint: FLAT_TINT,
            width: NARROWER,
            branch: Some(branch.branch),
            ..Line::new(samples, Hue::Standing, &branch.name)
        })
    });
    let dots = sweeps(report).map(|(sweep, colour, _, size, name)| {
        let samples = sweep
            .arcs
            .iter()
            .flat_map(|arc| arc.rpm.iter().zip(&arc.frequencies_hz));
        let at = samples.flat_map(|(rpm, all)| all.iter().map(|hz| [*rpm, *hz]));
        Item::Points(Points::new(at, colour, size, name))
    });
    branches.chain(dots).collect()
}

fn key() -> Vec<Item> {
    vec![
        Item::line_sample(WIDER, false, UP, "stable, while the speed rises"),
        Item::line_sample(NARROWER, false, DOWN, "while it falls"),
        Item::line_sample(NARROWER, false, Hue::Standing, "stable, not reached"),
        Item::line_sample(HAIRLINE, true, Hue::Standing, "unstable"),
        Item::points_sample(TURN_SIZE, Shape::Ring, Hue::Ink, "fold or bifurcation"),
        Item::Line(Line {
            tint: FLAT_TINT,
            width: NARROWER,
            ..Line::new([], Hue::Standing, "frequencies of the flat blade")
        }),
        Item::area_sample(Hue::DivergenceShade, "the flat blade diverges"),
        Item::area_sample(Hue::FlutterShade, "the flat blade flutters"),
    ]
}
