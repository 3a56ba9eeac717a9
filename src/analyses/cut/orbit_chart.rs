//! The orbit of the centre of the blade on its arbor, one panel for each speed.

use super::{CutAtSpeed, CutReport, SplineOrbit};
use crate::page::figure::axis::tick_label;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading::of_saw;
use crate::page::figure::items::{Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, HAIRLINE};

/// Height of a panel, relative to one of usual height.
const SHARE: f64 = 1.15;
/// Share of the colour of the orbit before it is settled.
const BEFORE: f64 = 0.35;
const END_SIZE: f64 = 7.0;

/// A panel for each speed, as numbers; `None` for a saw without spline.
pub fn chart(report: &CutReport) -> Option<ChartData> {
    let runs: Vec<(&CutAtSpeed, &SplineOrbit)> = report
        .runs
        .iter()
        .filter_map(|run| Some((run, run.spline.as_ref()?)))
        .collect();
    let clearance_m = runs.first()?.1.clearance_m;
    let scale = Scale::of(runs.iter().map(|(_, spline)| *spline));
    let panels = runs.iter().map(|(run, spline)| panel(run, spline, &scale));
    let title = "Orbit of the blade's centre on the splined arbor in the cut";
    let facts = vec![of_saw(&report.scene.name, &report.condition)];
    Some(ChartData {
        columns: 2,
        key: key(clearance_m, &scale),
        ..ChartData::new(title, facts, panels.collect())
    })
}

/// The axes of all panels, which include the centre of the arbor and every orbit.
struct Scale {
    unit: &'static str,
    /// Factor from metres to the unit.
    per_metre: f64,
    /// End of the axes on either side of zero, in the unit.
    reach: f64,
}

impl Scale {
    fn of<'a>(splines: impl Iterator<Item = &'a SplineOrbit>) -> Self {
        let all = splines.flat_map(|spline| spline.x_m.iter().chain(&spline.y_m));
        let largest_m = all.fold(1e-9_f64, |max, value| max.max(value.abs()));
        let (unit, per_metre) = if largest_m < 1e-4 {
            ("µm", 1e6)
        } else {
            ("mm", 1e3)
        };
        Scale {
            unit,
            per_metre,
            reach: 1.2 * per_metre * largest_m,
        }
    }
}

fn panel(run: &CutAtSpeed, spline: &SplineOrbit, scale: &Scale) -> PanelData {
    let reach = [-scale.reach, scale.reach];
    let points: Vec<[f64; 2]> = spline
        .x_m
        .iter()
        .zip(&spline.y_m)
        .map(|(x, y)| [x, y].map(|m| scale.per_metre * m))
        .collect();
    let (start, rest) = points.split_at(spline.settled_from.min(points.len()));
    let zero = |ends: [[f64; 2]; 2]| {
        Item::Line(Line {
            tint: 0.6,
            width: HAIRLINE,
            ..Line::new(ends, Hue::Standing, "")
        })
    };
    let before = Line {
        tint: BEFORE,
        width: HAIRLINE,
        ..Line::new(start.iter().copied(), Hue::Forward, "before it is settled")
    };
    let settled = Line::new(rest.iter().copied(), Hue::Forward, "orbit");
    let end = Points::new(points.last().copied(), Hue::Forward, END_SIZE, "end");
    let clearance = clearance(scale.per_metre * spline.clearance_m);
    let items = [
        zero(reach.map(|x| [x, 0.0])),
        zero(reach.map(|y| [0.0, y])),
        Item::Line(clearance),
        Item::Line(before),
        Item::Line(settled),
        Item::Points(end),
    ];
    let axis = |name| AxisData::new(name, scale.unit).within(reach);
    PanelData {
        title: format!(
            "{:.0} rpm: {:.1} spline teeth in contact, {:.0} N at most on one",
            run.rpm, spline.teeth_in_contact, spline.peak_tooth_n
        ),
        facts: vec![format!(
            "growth in the cut {:.2} 1/s assumed, {:.2} 1/s with this reaction",
            run.growth_per_s, spline.growth_per_s
        )],
        share: SHARE,
        equal: true,
        ..PanelData::new(
            axis("centre towards the cut"),
            axis("a quarter turn further"),
            items.into(),
        )
    }
}

/// The circle in which the centre of a blade without torque can move.
fn clearance(radius: f64) -> Line {
    let circle = (0..=120).map(|k| {
        let (sin, cos) = (f64::from(k) / 120.0 * std::f64::consts::TAU).sin_cos();
        [radius * cos, radius * sin]
    });
    Line {
        width: HAIRLINE,
        dashed: true,
        ..Line::new(circle, Hue::Quiet, "clearance")
    }
}

fn key(clearance_m: f64, scale: &Scale) -> Vec<Item> {
    let size = format!("clearance {} mm", tick_label(1e3 * clearance_m));
    let name = if scale.per_metre * clearance_m <= scale.reach {
        size
    } else {
        format!("{size}, outside the picture")
    };
    let before = Line {
        tint: BEFORE,
        width: HAIRLINE,
        ..Line::new([], Hue::Forward, "before it is settled")
    };
    vec![
        Item::Line(before),
        Item::line_sample(CURVE, false, Hue::Forward, "orbit"),
        Item::points_sample(END_SIZE, Shape::Disc, Hue::Forward, "its end"),
        Item::line_sample(HAIRLINE, true, Hue::Quiet, &name),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(x_m: Vec<f64>) -> SplineOrbit {
        SplineOrbit {
            verdict: crate::analyses::campbell::Verdict::Stable,
            growth_per_s: 0.0,
            frequency_hz: None,
            stiffness_change: 0.1,
            torque_n_m: 1500.0,
            clearance_m: 2.5e-4,
            teeth_in_contact: 20.0,
            peak_tooth_n: 1200.0,
            deepest_m: 3e-5,
            imbalance: 1e-10,
            unsteadiness: 1e-10,
            settled_from: 1,
            time_s: Vec::new(),
            force_n: [0.0; 2],
            y_m: x_m.clone(),
            x_m,
        }
    }

    /// One orbit of a few micrometres in a clearance of a quarter of a millimetre, and one that fills the
    /// clearance.
    #[test]
    fn an_orbit_far_smaller_than_the_clearance_fills_its_panel() {
        for (metres, unit, fits) in [(9e-6, "µm", false), (2.4e-4, "mm", true)] {
            let spline = spline(vec![0.5 * metres, -metres, metres]);
            let scale = Scale::of(std::iter::once(&spline));
            assert_eq!(scale.unit, unit);
            let share = scale.per_metre * metres / scale.reach;
            assert!((0.8..1.0).contains(&share), "{share}");
            assert_eq!(scale.per_metre * spline.clearance_m <= scale.reach, fits);
        }
    }
}
