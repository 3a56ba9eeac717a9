//! The contents of the Campbell diagram, as numbers.

use super::branch_line::{line_through, say};
use super::facts::facts;
use super::growth;
use super::view::Shown;
use super::waves::{Stretch, direction_at, look_of_segment};
use crate::analyses::campbell::Report;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Band, Item, Line, Points, Role, Shape, Upright, lines_by_look};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, HAIRLINE, MEASURED_SIZE, STRONG_CURVE};
use crate::page::text::shown_to;

/// Name of the line along the axis of speeds between the ends of the window around the operating speed.
pub const WINDOW: &str = "window without instability";
const WINDOW_TINT: f64 = 0.35;
/// Width of this line; half of it is visible where curves are clipped at the axis.
const WINDOW_WIDTH: f64 = 7.0;
const CRITICAL_SIZE: f64 = 7.0;
const CROSSING_SIZE: f64 = 5.0;
/// Diameter of the dot of a branch that exists at a single speed.
const DOT_SIZE: f64 = 4.0 * CURVE;

/// Frequencies over speed, and growth rates below. Descriptions of the points are included only if `said`.
pub fn describe(report: &Report, shown: &Shown, said: bool) -> ChartData {
    let speed = AxisData::speed().within(shown.rpm);
    let bands = report
        .instabilities
        .iter()
        .map(|band| Item::Band(Band::new(band, shown.rpm)));
    let marks: Vec<Item> = bands.chain(uprights(report)).collect();
    let mut upper_items = marks.clone();
    upper_items.extend(safe_window(report));
    upper_items.extend(branches(report, said));
    upper_items.extend(excitation(report, shown));
    upper_items.extend(measured(report, said));
    upper_items.push(critical(report, said));
    let mut lower = growth::describe(report, shown.rpm, speed.clone(), said);
    lower.items.splice(0..0, marks);
    let upper = PanelData {
        share: 2.0,
        harmonics: true,
        ..PanelData::new(
            speed,
            AxisData::new("Im λ / 2π", "Hz").within([0.0, shown.hz]),
            upper_items,
        )
    };
    ChartData {
        columns: 1,
        key: Vec::new(),
        title: report.scene.name.clone(),
        facts: facts(report)
            .into_iter()
            .chain(names_of_lines(report))
            .collect(),
        panels: vec![upper, lower],
    }
}

/// Names of the excitation lines as a statement below the title, because the live page has no room for labels.
fn names_of_lines(report: &Report) -> Option<String> {
    let lines = report.excitation.as_ref()?.lines.iter();
    let names: Vec<&str> = lines.map(|line| line.name.as_str()).collect();
    Some(format!("lines {}", names.join(", ")))
}

fn uprights(report: &Report) -> impl Iterator<Item = Item> {
    let critical = report
        .critical_speeds
        .iter()
        .map(|entry| Upright::critical(entry.rpm, &entry.name));
    let operating = report.scene.operating_rpm.map(|rpm| Upright {
        x: rpm,
        role: Role::Operating,
        colour: Hue::Ink,
        dashed: false,
        label: format!("operating {rpm:.0}"),
        name: format!("operating speed {rpm:.0} rpm"),
    });
    critical.chain(operating).map(Item::Upright)
}

/// The window without instability around the operating speed, as a line along the axis of speeds.
fn safe_window(report: &Report) -> Option<Item> {
    let ends = report.operating.as_ref()?.safe_window_rpm?;
    let name = format!("{WINDOW}: {:.0} to {:.0} rpm", ends[0], ends[1]);
    Some(Item::Line(Line {
        tint: WINDOW_TINT,
        width: WINDOW_WIDTH,
        said: vec![name.replace(": ", "\n"); 2],
        ..Line::new(ends.map(|rpm| [rpm, 0.0]), Hue::Ink, &name)
    }))
}

/// Curves of the branches: solid for waves of Krein sign +1, dashed for reflected waves, thick where unstable.
fn branches(report: &Report, said: bool) -> Vec<Item> {
    let mut items = Vec::new();
    // The lowest branches are the most important, and are drawn last, on top of the others.
    for branch in report.campbell.branches.iter().rev() {
        if let ([rpm], [hz]) = (&branch.rpm[..], &branch.frequency_hz[..]) {
            let colour = Hue::of_direction(direction_at(branch, 0));
            items.push(Item::Points(Points {
                said: if said {
                    vec![say(branch, 0)]
                } else {
                    Vec::new()
                },
                ..Points::new([[*rpm, *hz]], colour, DOT_SIZE, &branch.name)
            }));
        }
        let samples = branch.rpm.len().min(branch.frequency_hz.len());
        // A segment has the direction of its end, because with guides all modes at rest, where segments may
        // begin, are standing waves.
        let look = |i| {
            (
                look_of_segment(report, branch, i),
                direction_at(branch, i + 1),
            )
        };
        let ends = branch.rpm.last() == Some(&report.campbell.to_rpm);
        let last = samples.checked_sub(2).filter(|_| ends).map(look);
        for (of, samples) in lines_by_look(samples, |i| Some(look(i))) {
            let (stretch, direction) = of;
            let colour = Hue::of_direction(direction);
            items.push(Item::Line(Line {
                width: match stretch {
                    Stretch::Unstable => STRONG_CURVE,
                    _ => CURVE,
                },
                dashed: stretch == Stretch::Reflected,
                end: if last == Some(of) && branch.oscillates() {
                    branch.label.clone()
                } else {
                    String::new()
                },
                ..line_through(branch, &branch.frequency_hz, &samples, colour, said)
            }));
        }
    }
    items
}

/// Lines at multiples of the rotation speed, and their crossings with the branches.
fn excitation(report: &Report, shown: &Shown) -> Vec<Item> {
    let Some(excitation) = &report.excitation else {
        return Vec::new();
    };
    let [first, last] = [report.campbell.from_rpm, report.campbell.to_rpm];
    let lines = excitation.lines.iter().filter_map(|line| {
        let per_rpm = f64::from(line.order) / 60.0;
        // A line that ends at the upper edge of the panel has no label at its end, because there is no room.
        let end = last.min(shown.hz / per_rpm);
        let ends = [first, end];
        (first < end).then(|| {
            Item::Line(Line {
                width: HAIRLINE,
                dashed: true,
                said: ends
                    .map(|rpm| format!("{}\n{rpm:.1} rpm", line.name))
                    .into(),
                end: if end == last {
                    line.name.clone()
                } else {
                    String::new()
                },
                ..Line::new(ends.map(|rpm| [rpm, per_rpm * rpm]), Hue::Quiet, &line.name)
            })
        })
    });
    let crossings = &excitation.crossings;
    let said = crossings.iter().map(|c| {
        format!(
            "{}× crosses {}\n{:.1} rpm\n{:.3} Hz",
            c.order, c.mode, c.rpm, c.frequency_hz
        )
    });
    let at = crossings.iter().map(|c| [c.rpm, c.frequency_hz]);
    let rings = Points {
        shape: Shape::Ring,
        said: said.collect(),
        ..Points::new(at, Hue::Quiet, CROSSING_SIZE, "crossing")
    };
    lines.chain([Item::Points(rings)]).collect()
}

fn measured(report: &Report, said: bool) -> Option<Item> {
    let measured = report.scene.measured.as_ref()?;
    let rows = measured.rows.iter();
    let points: Vec<[f64; 2]> = rows
        .flat_map(|row| row.seen_hz().map(|hz| [row.rpm, hz]))
        .collect();
    let words = |[rpm, hz]: &[f64; 2]| {
        format!("{}\n{rpm:.0} rpm\n{} Hz", measured.source, shown_to(6, *hz))
    };
    Some(Item::Points(Points {
        shape: Shape::Ring,
        said: points.iter().filter(|_| said).map(words).collect(),
        ..Points::new(points, Hue::Ink, MEASURED_SIZE, &measured.source)
    }))
}

fn critical(report: &Report, said: bool) -> Item {
    let entries = report.critical_speeds.iter();
    let words = |rpm: f64| format!("critical speed {rpm:.1} rpm");
    let speeds = entries.map(|entry| entry.rpm);
    Item::Points(Points {
        said: speeds.clone().filter(|_| said).map(words).collect(),
        ..Points::new(
            speeds.map(|rpm| [rpm, 0.0]),
            Hue::Ink,
            CRITICAL_SIZE,
            "critical speed",
        )
    })
}
