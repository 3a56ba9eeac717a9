//! Bands as areas over a number and the speed.

use super::{HEIGHT, KEYS, PANEL, WIDTH, facts};
use crate::analyses::map::{MapReport, MappedSaw};
use crate::figure::along::Along;
use crate::figure::axis::{Axis, SPEED, draw_named, draw_vertical};
use crate::figure::canvas::{Anchor, Lettering, Sheet, Stroke};
use crate::figure::heading;
use crate::figure::key::Key;
use crate::figure::style::{
    ALARM, BLANK, CURVE, Colour, DIVERGENCE_STREAK, FINE_DASH, FLUTTER_STREAK, FORWARD, HAIRLINE,
    INK, LABEL_SIZE, QUIET, tint,
};
use crate::stability::InstabilityKind;

/// Areas of two neighbouring saws are not joined if they are further apart than this share of the sweep, after their speeds
/// have been scaled by the critical speeds of the saws.
const JOINED: f64 = 0.02;
/// Speeds of two neighbouring saws that are further apart than this share of the sweep are not joined.
const JUMP: f64 = 0.08;
/// A band below the threshold that is wider than this share of the sweep is caused by damping and is not drawn.
const WIDEST_WEAK: f64 = 0.03;
const THINNEST: f64 = 1.5;

/// A function that returns a speed of a saw in rpm; `None` if the saw has no such speed in the sweep.
type Speed = fn(&MappedSaw) -> Option<f64>;

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

    fn colour(self) -> Colour {
        match self {
            Look::Divergence => tint(DIVERGENCE_STREAK, 0.8),
            Look::Flutter => tint(FLUTTER_STREAK, 0.9),
            Look::Weak => tint(FLUTTER_STREAK, 0.4),
        }
    }
}

pub fn sheet(report: &MapReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let x = Along::between(&report.x.path, &report.x.values, PANEL.across());
    let speed = Axis::linear([0.0, report.to_rpm], PANEL.upwards());
    draw_blank(&mut sheet, report, &x);
    draw_vertical(&mut sheet, &speed, &PANEL, SPEED);
    draw_areas(&mut sheet, report, &x, &speed);
    let speeds: [(Colour, Speed); 2] = [
        (FORWARD, |saw| saw.lowest_critical_rpm),
        (ALARM, |saw| saw.flutter_speed_rpm),
    ];
    for (colour, of) in speeds {
        draw_curve(&mut sheet, report, (&x, &speed), colour, of);
    }
    draw_marks(&mut sheet, report, &x, &speed);
    draw_named(&mut sheet, &x.axis, PANEL.bottom, &x.name);
    draw_key(&mut sheet, report);
    sheet
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
fn pairs(left: &[Area], right: &[Area], scale: f64, farthest: f64) -> Vec<(usize, usize)> {
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
            pairs.push((i, j));
        } else if cost[i][j] == cost[i - 1][j] + alone {
            i -= 1;
        } else {
            j -= 1;
        }
    }
    pairs
}

fn draw_areas(sheet: &mut Sheet, report: &MapReport, x: &Along, speed: &Axis) {
    let columns: Vec<Vec<Area>> = report
        .saws
        .iter()
        .map(|saw| areas(saw, report.to_rpm))
        .collect();
    let at = |k: usize| x.at(report.saws[k].x);
    for look in Look::ALL {
        let of = |k: usize| -> Vec<Area> {
            let all = columns[k].iter().copied();
            all.filter(|area| area.look == look).collect()
        };
        for k in 1..columns.len() {
            let (left, right) = (of(k - 1), of(k));
            let critical = [k - 1, k].map(|k| report.saws[k].lowest_critical_rpm);
            let scale = match critical {
                [Some(left), Some(right)] => right / left,
                _ => 1.0,
            };
            let pairs = pairs(&left, &right, scale, JOINED * report.to_rpm);
            let ends = [at(k - 1), at(k)];
            let middle = 0.5 * (ends[0] + ends[1]);
            for (i, j) in &pairs {
                draw_area(sheet, speed, (ends, [left[*i], right[*j]]));
            }
            for (i, area) in left.iter().enumerate() {
                if pairs.iter().all(|(own, _)| *own != i) {
                    draw_area(sheet, speed, ([ends[0], middle], [*area; 2]));
                }
            }
            for (j, area) in right.iter().enumerate() {
                if pairs.iter().all(|(_, own)| *own != j) {
                    draw_area(sheet, speed, ([middle, ends[1]], [*area; 2]));
                }
            }
        }
    }
}

/// Draws an area between two abscissae, from its range of speeds at the left one to that at the right one.
fn draw_area(sheet: &mut Sheet, speed: &Axis, ([left, right], areas): ([f64; 2], [Area; 2])) {
    let colour = areas[0].look.colour();
    let [a, b] = areas.map(|area| area.rpm.map(|rpm| speed.at(rpm)));
    let corners = [[left, a[0]], [left, a[1]], [right, b[1]], [right, b[0]]];
    sheet.polygon(corners, colour);
    let height = 0.5 * ((a[0] - a[1]) + (b[0] - b[1]));
    if height < THINNEST {
        let middle = [[left, 0.5 * (a[0] + a[1])], [right, 0.5 * (b[0] + b[1])]];
        sheet.line(middle, Stroke::solid(colour, THINNEST));
    }
}

fn draw_curve(
    sheet: &mut Sheet,
    report: &MapReport,
    (x, speed): (&Along, &Axis),
    colour: Colour,
    of: Speed,
) {
    let stroke = Stroke::solid(colour, CURVE);
    let shown = |saw: &MappedSaw| of(saw).filter(|rpm| speed.shows(*rpm));
    for pair in report.saws.windows(2) {
        if let [Some(a), Some(b)] = [&pair[0], &pair[1]].map(shown)
            && (a - b).abs() <= JUMP * report.to_rpm
        {
            let ends = [
                [x.at(pair[0].x), speed.at(a)],
                [x.at(pair[1].x), speed.at(b)],
            ];
            sheet.line(ends, stroke);
        }
    }
    for saw in &report.saws {
        if let Some(rpm) = shown(saw) {
            sheet.disc([x.at(saw.x), speed.at(rpm)], 2.0, colour);
        }
    }
}

/// Shades the columns of saws that were not analysed.
fn draw_blank(sheet: &mut Sheet, report: &MapReport, x: &Along) {
    let places: Vec<f64> = report.saws.iter().map(|saw| x.at(saw.x)).collect();
    for (k, saw) in report.saws.iter().enumerate() {
        if saw.not_analysed.is_some() {
            let beside = |other: Option<&f64>| other.map_or(places[k], |at| 0.5 * (at + places[k]));
            let left = beside(k.checked_sub(1).and_then(|k| places.get(k)));
            let right = beside(places.get(k + 1));
            sheet.fill(PANEL.between([left, right.max(left + 1.0)]), BLANK);
        }
    }
}

/// Draws lines at the number of the scene and at the speed at which the saws are judged.
fn draw_marks(sheet: &mut Sheet, report: &MapReport, x: &Along, speed: &Axis) {
    let dashed = Stroke::dashed(INK, HAIRLINE, FINE_DASH);
    if x.shows(report.x.of_scene) {
        sheet.vertical(x.at(report.x.of_scene), &PANEL, dashed);
    }
    if let Some(rpm) = report.rpm.filter(|rpm| speed.shows(*rpm)) {
        let y = speed.at(rpm);
        sheet.horizontal(y, &PANEL, dashed);
        let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::End);
        let at = [PANEL.right - 6.0, y - 6.0];
        sheet.text_on_paper(at, letters, &format!("{rpm:.0} rpm"));
    }
}

fn draw_key(sheet: &mut Sheet, report: &MapReport) {
    let dashed = Stroke::dashed(INK, HAIRLINE, FINE_DASH);
    Key::new(sheet, PANEL.left, KEYS[0])
        .shade(Look::Divergence.colour())
        .word("divergence")
        .shade(Look::Flutter.colour())
        .word("flutter")
        .shade(Look::Weak.colour())
        .word("flutter below the threshold, unless the band is wide");
    let mut key = Key::new(sheet, PANEL.left, KEYS[1]);
    key.line(24.0, Stroke::solid(FORWARD, CURVE))
        .word("lowest critical speed")
        .line(24.0, Stroke::solid(ALARM, CURVE))
        .word("flutter speed")
        .line(24.0, dashed)
        .word("the scene");
    if report.saws.iter().any(|saw| saw.not_analysed.is_some()) {
        key.shade(BLANK).word("not analysed");
    }
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::End);
    let note = "areas are joined between saws that are next to each other";
    sheet.text([PANEL.right, KEYS[1]], letters, note);
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
        assert_eq!(found, [(0, 0), (1, 1), (2, 3)]);
        assert!(pairs(&left[..1], &right[2..3], 1.0, 240.0).is_empty());
        // A gap of a column: the areas of the right saw are expected 30 % higher.
        let higher = [1300.0, 1950.0].map(area);
        let mut found = pairs(&left, &higher, 1.3, 60.0);
        found.sort_unstable();
        assert_eq!(found, [(0, 0), (1, 1)]);
    }
}
