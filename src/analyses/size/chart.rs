//! Margin of every limit over the number.

use super::SizeReport;
use super::outline::{headline, of};
use crate::analyses::scene_axis::Along;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Role, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{CURVE, STRONG_CURVE};

/// Largest margin that is drawn, in percent. A limit that is never nearer has no curve.
const MOST: f64 = 50.0;
/// Room above and below the curves, as a share of their height.
const ROOM: f64 = 0.05;
const HUES: [Hue; 5] = [
    Hue::Forward,
    Hue::Backward,
    Hue::Standing,
    Hue::Divergence,
    Hue::Quiet,
];

/// Margins of the limits, as numbers.
pub fn chart(report: &SizeReport) -> ChartData {
    let along = Along::between(report.path(), &report.values);
    let ends = [report.from, report.to].map(|end| along.at(end));
    let zero = Line {
        width: STRONG_CURVE,
        ..Line::new([[ends[0], 0.0], [ends[1], 0.0]], Hue::Ink, "limit")
    };
    let curves = report.limits.iter().zip(HUES.iter().cycle());
    let curves = curves.map(|(limit, hue)| {
        let margins = along.values.iter().zip(&limit.margins);
        let points = margins.map(|(x, margin)| {
            let percent = margin.map_or(f64::NAN, |margin| (100.0 * margin).clamp(-MOST, MOST));
            [*x, percent]
        });
        Line {
            width: CURVE,
            ..Line::new(points, *hue, &limit.name)
        }
    });
    let drawn = curves.filter(|line| line.y.iter().any(|y| *y < MOST));
    let lines: Vec<Line> = std::iter::once(zero).chain(drawn).collect();
    let kept = report.windows.iter().map(|window| {
        let points = [window.from, window.to].map(|end| [along.at(end), 0.0]);
        Line {
            width: 3.0 * STRONG_CURVE,
            ..Line::new(points, Hue::Forward, "all limits are kept")
        }
    });
    let own = Upright {
        x: along.at(report.of_scene),
        role: Role::Operating,
        colour: Hue::Ink,
        dashed: true,
        label: format!("scene {}", of(report, report.of_scene)),
        name: format!("the scene has {}", of(report, report.of_scene)),
    };
    let is_within = (report.from..=report.to).contains(&report.of_scene);
    let key: Vec<Item> = lines
        .iter()
        .map(|line| {
            Item::Line(Line {
                x: Vec::new(),
                y: Vec::new(),
                ..line.clone()
            })
        })
        .collect();
    let drawn = lines.iter().flat_map(|line| &line.y);
    let [low, high] = drawn
        .filter(|y| y.is_finite())
        .fold([0.0_f64; 2], |[low, high], y| [low.min(*y), high.max(*y)]);
    let room = ROOM * (high - low).max(1.0);
    let margin = AxisData::new("margin of the limit", "%").within([low - room, high + room]);
    let items = is_within
        .then_some(Item::Upright(own))
        .into_iter()
        .chain(lines.into_iter().chain(kept).map(Item::Line))
        .collect();
    let panel = PanelData::new(along.axis, margin, items);
    let facts = vec![report.condition.clone(), headline(report)];
    ChartData {
        key,
        ..ChartData::new(&report.scene.name, facts, vec![panel])
    }
}
