//! Bands as areas over a number and the speed.

use crate::analyses::map::{MapReport, MappedSaw};
use crate::analyses::scene_axis::Along;
use crate::page::figure::chart_data::{AxisData, PanelData};
use crate::page::figure::items::{self, Item, Line, Points, Role, Upright};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::CURVE;
use crate::stability::InstabilityKind;

/// Areas of two neighbouring saws are not joined if they are further apart than this share of the sweep, after their speeds
/// have been scaled by the critical speeds of the saws.
const JOINED: f64 = 0.02;
/// Speeds of two neighbouring saws that are further apart than this share of the sweep are not joined.
const JUMP: f64 = 0.08;
/// A band below the threshold that is wider than this share of the sweep is caused by damping and is not drawn.
const WIDEST_WEAK: f64 = 0.03;
const DOT_SIZE: f64 = 4.0;
const NOT_ANALYSED: &str = "not analysed";

/// A speed that is drawn as a curve.
struct Speed {
    hue: Hue,
    name: &'static str,
    /// The speed of a saw; `None` if the saw has no such speed in the sweep.
    rpm_of: fn(&MappedSaw) -> Option<f64>,
}

const SPEEDS: [Speed; 3] = [
    Speed {
        hue: Hue::Forward,
        name: "first critical speed",
        rpm_of: |saw| saw.first_critical_rpm,
    },
    Speed {
        hue: Hue::Alarm,
        name: "flutter speed",
        rpm_of: |saw| saw.flutter_rpm,
    },
    Speed {
        hue: Hue::Ink,
        name: "allowed up to",
        rpm_of: |saw| saw.verdict.as_ref()?.allowed_to_rpm,
    },
];

/// Columns of an area, each with an abscissa, a lower and an upper end.
type Columns = Vec<[f64; 3]>;

/// A band of a saw, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Area {
    look: Look,
    rpm: [f64; 2],
}

/// Kind of an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Look {
    Divergence,
    /// Flutter whose growth reaches the threshold.
    Flutter,
    /// Instability below the threshold.
    Weak,
}

impl Look {
    /// Kinds in drawing order.
    const ALL: [Look; 3] = [Look::Weak, Look::Flutter, Look::Divergence];

    /// An area of columns with an abscissa, a lower and an upper end.
    fn area(self, columns: Columns) -> Item {
        let (hue, tint, name) = match self {
            Look::Divergence => (Hue::DivergenceStreak, 0.8, "divergence"),
            Look::Flutter => (Hue::FlutterStreak, 0.9, "flutter"),
            Look::Weak => (
                Hue::FlutterStreak,
                0.4,
                "flutter below the threshold, unless the band is wide",
            ),
        };
        Item::Area(items::Area {
            tint,
            stepped: false,
            ..items::Area::new(columns, hue, name)
        })
    }
}

/// Areas of the bands, and curves of the critical and flutter speeds.
pub fn panel(report: &MapReport) -> PanelData {
    let along = Along::between(&report.x.path, &report.x.values);
    let mut all = vec![Item::Area(not_analysed(report, &along))];
    for look in Look::ALL {
        let chains = chains(report, &along, look).into_iter();
        all.extend(chains.map(|columns| look.area(columns)));
    }
    for speed in SPEEDS {
        all.extend(curve(report, &along, &speed));
    }
    all.extend(marks(report, &along));
    PanelData::new(
        along.axis,
        AxisData::speed().within([0.0, report.to_rpm]),
        all,
    )
}

/// The areas of a saw in a sweep up to `to_rpm`.
fn areas(saw: &MappedSaw, to_rpm: f64) -> Vec<Area> {
    let mut areas = Vec::new();
    for band in &saw.instabilities {
        let look = match band.kind {
            InstabilityKind::Divergence => Look::Divergence,
            InstabilityKind::Flutter => Look::Flutter,
        };
        let counted = band.counted_rpm.iter().map(|rpm| Area { look, rpm: *rpm });
        areas.extend(counted);
        let whole = [band.from_rpm, band.to_rpm];
        if band.counted_rpm.is_empty() && whole[1] - whole[0] <= WIDEST_WEAK * to_rpm {
            let look = Look::Weak;
            areas.push(Area { look, rpm: whole });
        }
    }
    areas
}

/// Pairs of areas of two neighbouring saws that are joined. Their order is kept, and the sum of the distances of their
/// middle speeds is as small as possible. `scale` is the ratio of the speeds of the right saw to those of the left one,
/// and `farthest` the largest distance of a pair in rpm.
fn pairs(left: &[Area], right: &[Area], scale: f64, farthest: f64) -> Vec<[usize; 2]> {
    let middle = |area: &Area| 0.5 * (area.rpm[0] + area.rpm[1]);
    let (rows, columns) = (left.len() + 1, right.len() + 1);
    // `cost[i][j]` is the smallest sum of distances for the first `i` areas on the left and the first `j` on
    // the right, where an area without a partner adds half of the largest distance.
    let mut cost = vec![vec![0.0; columns]; rows];
    let distance = |i: usize, j: usize| (scale * middle(&left[i]) - middle(&right[j])).abs();
    let alone = 0.5 * farthest;
    for i in 0..rows {
        for j in 0..columns {
            cost[i][j] = match (i, j) {
                (0, _) => j as f64 * alone,
                (_, 0) => i as f64 * alone,
                _ => (cost[i - 1][j] + alone)
                    .min(cost[i][j - 1] + alone)
                    .min(cost[i - 1][j - 1] + distance(i - 1, j - 1)),
            };
        }
    }
    let (mut i, mut j, mut pairs) = (left.len(), right.len(), Vec::new());
    while i > 0 && j > 0 {
        if cost[i][j] == cost[i - 1][j - 1] + distance(i - 1, j - 1) {
            (i, j) = (i - 1, j - 1);
            pairs.push([i, j]);
        } else if cost[i][j] == cost[i - 1][j] + alone {
            i -= 1;
        } else {
            j -= 1;
        }
    }
    pairs
}

/// The areas of a kind, each as columns with an abscissa, a lower and an upper end. Areas of neighbouring saws that belong
/// together are one; an area without a partner ends half way to the neighbour.
fn chains(report: &MapReport, along: &Along, look: Look) -> Vec<Columns> {
    let column = |x: f64, area: &Area| [x, area.rpm[0], area.rpm[1]];
    let mut done: Vec<Columns> = Vec::new();
    let mut open: Vec<Columns> = Vec::new();
    let mut before: Option<(&MappedSaw, Vec<Area>)> = None;
    for saw in &report.saws {
        let x = along.at(saw.x);
        let mut own = areas(saw, report.to_rpm);
        own.retain(|area| area.look == look);
        let mut next: Vec<Columns> = Vec::new();
        if let Some((left, others)) = &before {
            let scale = match [left, saw].map(|saw| saw.first_critical_rpm) {
                [Some(left), Some(right)] => right / left,
                _ => 1.0,
            };
            let middle = along.half_way(left.x, saw.x);
            let pairs = pairs(others, &own, scale, JOINED * report.to_rpm);
            for (j, area) in own.iter().enumerate() {
                let partner = pairs.iter().find(|[_, right]| *right == j);
                let mut chain = match partner {
                    Some([left, _]) => std::mem::take(&mut open[*left]),
                    None => vec![column(middle, area)],
                };
                chain.push(column(x, area));
                next.push(chain);
            }
            let ended = open.into_iter().zip(others);
            for (mut chain, area) in ended.filter(|(chain, _)| !chain.is_empty()) {
                chain.push(column(middle, area));
                done.push(chain);
            }
        } else {
            next = own.iter().map(|area| vec![column(x, area)]).collect();
        }
        (open, before) = (next, Some((saw, own)));
    }
    done.extend(open);
    done
}

/// Dots at a speed of each saw, joined where neighbours differ little.
fn curve(report: &MapReport, along: &Along, speed: &Speed) -> [Item; 2] {
    let points = report.saws.iter().map(|saw| {
        let rpm = (speed.rpm_of)(saw).filter(|rpm| *rpm <= report.to_rpm);
        [along.at(saw.x), rpm.unwrap_or(f64::NAN)]
    });
    let mut line: Vec<[f64; 2]> = Vec::new();
    for point in points.clone() {
        let last = line.last().map(|last| (last[1] - point[1]).abs());
        if last.is_some_and(|step| step > JUMP * report.to_rpm) {
            line.push([f64::NAN; 2]);
        }
        line.push(point);
    }
    [
        Item::Line(Line::new(line, speed.hue, speed.name)),
        Item::Points(Points::new(points, speed.hue, DOT_SIZE, speed.name)),
    ]
}

/// The columns of saws that were not analysed.
fn not_analysed(report: &MapReport, along: &Along) -> items::Area {
    let columns = report.saws.iter().map(|saw| match saw.not_analysed {
        Some(_) => [along.at(saw.x), 0.0, report.to_rpm],
        None => [along.at(saw.x), f64::NAN, f64::NAN],
    });
    items::Area::new(columns, Hue::Blank, NOT_ANALYSED)
}

/// A line at the number of the scene, for the key too.
fn of_scene(x: f64) -> Item {
    Item::Upright(Upright {
        x,
        role: Role::Guide,
        colour: Hue::Ink,
        dashed: true,
        label: String::new(),
        name: "the scene".to_owned(),
    })
}

/// Lines at the number of the scene and at the speed at which the saws are judged.
fn marks(report: &MapReport, along: &Along) -> Vec<Item> {
    let ends = along.axis.range.unwrap_or([0.0, 1.0]);
    let judged = report.rpm.map(|rpm| {
        let label = format!("{rpm:.0} rpm");
        Item::Line(Line {
            label: label.clone(),
            ..Line::guide(ends.map(|x| [x, rpm]), Hue::Ink, &label)
        })
    });
    let scene = of_scene(along.at(report.x.of_scene));
    [scene].into_iter().chain(judged).collect()
}

/// Samples of the areas, the curves and the number of the scene.
pub fn key(report: &MapReport) -> Vec<Item> {
    let looks = Look::ALL.iter().rev().map(|look| look.area(Vec::new()));
    let curves = SPEEDS.map(|speed| Item::line_sample(CURVE, false, speed.hue, speed.name));
    let is_blank = report.saws.iter().any(|saw| saw.not_analysed.is_some());
    let blank = is_blank.then(|| Item::area_sample(Hue::Blank, NOT_ANALYSED));
    looks
        .chain(curves)
        .chain([of_scene(0.0)])
        .chain(blank)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_joined_in_order_and_those_that_appear_stay_alone() {
        let area = |from: f64| Area {
            look: Look::Flutter,
            rpm: [from, from + 2.0],
        };
        let left = [1000.0, 1500.0, 2000.0].map(area);
        let right = [1030.0, 1530.0, 1800.0, 2030.0].map(area);
        let mut found = pairs(&left, &right, 1.0, 240.0);
        found.sort_unstable();
        assert_eq!(found, [[0, 0], [1, 1], [2, 3]]);
        assert!(pairs(&left[..1], &right[2..3], 1.0, 240.0).is_empty());
        // A gap of a column: the areas of the right saw are expected 30 % higher.
        let higher = [1300.0, 1950.0].map(area);
        let mut found_above = pairs(&left, &higher, 1.3, 60.0);
        found_above.sort_unstable();
        assert_eq!(found_above, [[0, 0], [1, 1]]);
    }
}
