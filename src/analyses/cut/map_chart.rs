//! The verdict over guide angle and load level, one panel for each speed.

use super::{CutAtSpeed, CutReport};
use crate::analyses::campbell::Verdict;
use crate::page::figure::axis::{Spread, ends, proper_range};
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading::of_saw;
use crate::page::figure::items::{Area, Heat, Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;

/// Share of the colour of stability.
const STABLE_TINT: f64 = 0.13;
/// Colours from slow to fast growth: pale to dark, so that grey prints are legible too.
const GROWING: [[u8; 3]; 4] = [[255, 236, 190], [240, 178, 62], [190, 84, 30], [92, 18, 32]];
/// Diameters of the rings at the load of the scene and at that which the power allows.
const OWN_SIZE: f64 = 10.0;
const POWER_SIZE: f64 = 8.0;
/// Share of the load of the scene up to which the load that the power allows is marked.
const LESS: f64 = 0.9;

/// The growth over angle and load, or over the load alone for a saw without guides, as numbers.
pub fn chart(report: &CutReport) -> ChartData {
    let has_guides = !report.scene.guides.is_empty();
    let title = if has_guides {
        "Growth in the cut over the angle of the guides and the load"
    } else {
        "Growth in the cut over the load"
    };
    let panel = |run| {
        let drawn = if has_guides {
            map(report, run)
        } else {
            over_load(report, run)
        };
        PanelData {
            title: format!("{} rpm", run.rpm),
            facts: forces(run),
            share: 0.84,
            ..drawn
        }
    };
    let stable = has_guides.then(|| Item::tinted_sample(Hue::Forward, STABLE_TINT, "stable"));
    let facts = vec![of_saw(&report.scene.name, &report.condition)];
    ChartData {
        columns: 2,
        key: stable.into_iter().collect(),
        ..ChartData::new(title, facts, report.runs.iter().map(panel).collect())
    }
}

/// The axis of the load.
fn load(run: &CutAtSpeed) -> AxisData {
    let axis = AxisData::new("load, relative to the scene's", "");
    axis.within(proper_range(ends(&run.map.load_level)))
}

fn forces(run: &CutAtSpeed) -> Vec<String> {
    vec![format!(
        "per tooth at load 1: {:.0} N tangential, {:.0} N radial",
        run.tangential_n_per_tooth, run.radial_n_per_tooth
    )]
}

/// Upper end of the scale of growth in 1/s, at least four times the threshold.
fn fastest_growth(report: &CutReport) -> f64 {
    let maps = report.runs.iter().map(|run| &run.map.growth_per_s);
    let fastest = maps.flatten().flatten().copied().fold(0.0_f64, f64::max);
    fastest.max(4.0 * report.flutter_threshold_per_s)
}

/// Lower end of the axis of growth in 1/s: negative if every motion decays at some load, otherwise zero.
fn slowest_growth(report: &CutReport) -> f64 {
    let maps = report.runs.iter().map(|run| &run.map.growth_per_s);
    let own = report.runs.iter().map(|run| run.growth_per_s);
    let all = maps.flatten().flatten().copied().chain(own);
    // The factor leaves room for the ring at the load of the scene.
    1.2 * all.fold(0.0, f64::min)
}

/// The verdict over guide angle and load: the growth where a vibration grows.
fn map(report: &CutReport, run: &CutAtSpeed) -> PanelData {
    let found = &run.map;
    let angle = AxisData::new("angle of the first guide, the cut at its own", "°")
        .within(proper_range(ends(&found.guide_angle_deg)));
    let load = load(run);
    let [low, high] = load.range.unwrap_or([0.0, 1.0]);
    let region = angle.range.unwrap_or([0.0, 1.0]).map(|x| [x, low, high]);
    let stable = Area {
        tint: STABLE_TINT,
        ..Area::new(region, Hue::Forward, "stable")
    };
    let rows = found
        .growth_per_s
        .iter()
        .zip(&found.verdict)
        .map(|(growth, verdict)| {
            let cells = growth
                .iter()
                .zip(verdict)
                .map(|(growth, verdict)| match verdict {
                    Verdict::Stable => f64::NAN,
                    _ => *growth,
                });
            cells.collect()
        });
    let heat = Heat {
        x: found.guide_angle_deg.clone(),
        y: found.load_level.clone(),
        z: rows.collect(),
        range: [0.0, fastest_growth(report)],
        spread: Spread::Linear,
        colours: GROWING.to_vec(),
        name: "growth".to_owned(),
        unit: "1/s".to_owned(),
    };
    let items = [Item::Area(stable), Item::Heat(heat)];
    let own = own_points(report, run);
    PanelData::new(angle, load, items.into_iter().chain(own).collect())
}

/// Rings at the angle and the load of the scene, and at the load that the power of the saw allows.
fn own_points(report: &CutReport, run: &CutAtSpeed) -> Vec<Item> {
    let guide = report.scene.guides.first();
    let own_deg = guide.map_or(0.0, |guide| guide.angle_deg);
    let by_power = run
        .by_power
        .as_ref()
        .map(|by_power| {
            let share = by_power.tangential_n_per_tooth / run.tangential_n_per_tooth;
            (share, Hue::Quiet, POWER_SIZE, "force that the power allows")
        })
        .filter(|(share, ..)| *share < LESS);
    let own = (1.0, Hue::Ink, OWN_SIZE, "this saw");
    let marks = [own].into_iter().chain(by_power);
    let items = marks.flat_map(|(load, hue, size, name)| ring([own_deg, load], hue, size, name));
    items.collect()
}

fn ring(at: [f64; 2], hue: Hue, size: f64, name: &str) -> [Item; 2] {
    [
        Item::Points(Points {
            shape: Shape::Ring,
            ..Points::new([at], hue, size, name)
        }),
        Item::label(at, hue, name.to_owned()),
    ]
}

/// Growth over the load, for a saw without guides.
fn over_load(report: &CutReport, run: &CutAtSpeed) -> PanelData {
    let load = load(run);
    let growth = [slowest_growth(report), fastest_growth(report)];
    let threshold_per_s = report.flutter_threshold_per_s;
    let ends = load.range.unwrap_or([0.0, 1.0]);
    let threshold = Line {
        label: "unstable above".to_owned(),
        ..Line::guide(
            ends.map(|x| [x, threshold_per_s]),
            Hue::Quiet,
            "unstable above",
        )
    };
    let points = run
        .map
        .load_level
        .iter()
        .zip(&run.map.growth_per_s)
        .map(|(load, row)| [*load, row.first().copied().unwrap_or(f64::NAN)]);
    let items = [
        Item::Line(threshold),
        Item::Line(Line::new(points, Hue::Forward, "growth")),
    ];
    let own = ring([1.0, run.growth_per_s], Hue::Ink, OWN_SIZE, "this saw");
    PanelData::new(
        load,
        AxisData::new("growth", "1/s").within(growth),
        items.into_iter().chain(own).collect(),
    )
}
