//! A deflected blade: areas between levels of the deflection, nodal lines, edges, slots and guides.

use std::f64::consts::TAU;

use crate::analyses::campbell::{EventShape, Report};
use crate::model::scene::GuideFile;
use crate::page::figure::canvas::{Sheet, Stroke};
use crate::page::figure::style::{BACKWARD, Colour, FORWARD, HAIRLINE, INK, QUIET, tint};

/// Outer radius of the blade on the sheet.
pub const RADIUS: f64 = 108.0;
pub const NODAL_WIDTH: f64 = 1.3;
pub const GUIDE_WIDTH: f64 = 2.2;
pub const SLOT_WIDTH: f64 = 3.4;
/// Number of tiles around the blade.
pub const ANGLES: usize = 72;
/// Tiles have corners at every fourth radius of a report.
const STRIDE: usize = 4;
/// Number of levels of the deflection on either side of zero.
const LEVELS: i32 = 6;
/// A guide with both sides shorter than this on the sheet is drawn as a ring.
const SMALL: f64 = 5.0;

/// A corner of a tile on the sheet, and the deflection there relative to its largest absolute value.
type Corner = ([f64; 2], f64);

pub fn draw(sheet: &mut Sheet, centre: [f64; 2], report: &Report, shape: &EventShape) {
    let outer = shape.radius_m.last().copied().unwrap_or(1.0);
    let on_sheet = |r: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let size = RADIUS * r / outer;
        [centre[0] + size * cos, centre[1] - size * sin]
    };
    let angles: Vec<f64> = (0..=ANGLES)
        .map(|k| TAU * k as f64 / ANGLES as f64)
        .collect();
    let values = shape.at(&angles);
    let mut rings: Vec<Vec<Corner>> = (shape.radius_m.iter().zip(values))
        .step_by(STRIDE)
        .map(|(r, row)| {
            let corners = angles.iter().zip(row);
            corners.map(|(a, [re, _])| (on_sheet(*r, *a), re)).collect()
        })
        .collect();
    continue_to_clamp(&mut rings);
    let tiles = || {
        let rings = rings.windows(2);
        rings.flat_map(|pair| {
            (0..ANGLES).map(|k| [pair[0][k], pair[0][k + 1], pair[1][k + 1], pair[1][k]])
        })
    };
    for tile in tiles() {
        draw_tile(sheet, &tile);
    }
    for tile in tiles() {
        let ends = crossings(&tile);
        if let [a, b] = ends[..] {
            sheet.line([a, b], Stroke::solid(INK, NODAL_WIDTH));
        }
    }
    for r in [shape.radius_m.first(), shape.radius_m.last()]
        .into_iter()
        .flatten()
    {
        let circle = angles.iter().map(|a| on_sheet(*r, *a));
        sheet.line(circle, Stroke::solid(QUIET, HAIRLINE));
    }
    if let Some(slots) = &report.scene.blade.slots {
        for angle in slots.angles_rad() {
            let ends = [outer - slots.depth_m, outer].map(|r| on_sheet(r, angle));
            sheet.line(ends, Stroke::solid(QUIET, SLOT_WIDTH));
        }
    }
    for guide in &report.scene.guides {
        draw_guide(sheet, guide, RADIUS / outer, centre);
    }
}

/// A smaller deflection of the innermost ring, relative to that of the next, is zero but for rounding errors.
const CLAMPED: f64 = 1e-3;

/// Continues nodal lines to the bore. A clamped bore does not deflect, and the signs of rounding errors would
/// give false nodal lines there; it gets the signs of the next ring.
fn continue_to_clamp(rings: &mut [Vec<Corner>]) {
    let [bore, next, ..] = rings else { return };
    for (corner, beside) in bore.iter_mut().zip(next) {
        if corner.1.abs() < CLAMPED * beside.1.abs() {
            corner.1 = CLAMPED * beside.1;
        }
    }
}

/// Colour of a deflection between −1, away from the viewer, and 1.
pub fn colour(deflection: f64) -> Colour {
    let hue = if deflection < 0.0 { FORWARD } else { BACKWARD };
    tint(hue, 0.06 + 0.84 * deflection.abs().min(1.0))
}

/// Draws the parts of a tile between neighbouring levels, each in the colour of the middle between them.
fn draw_tile(sheet: &mut Sheet, tile: &[Corner; 4]) {
    let values = tile.map(|(_, value)| value);
    let (low, high) = values.iter().fold((1.0_f64, -1.0_f64), |(low, high), v| {
        (low.min(*v), high.max(*v))
    });
    for level in -LEVELS..LEVELS {
        let ends = [level, level + 1].map(|level| f64::from(level) / f64::from(LEVELS));
        // The lowest and the highest interval of levels are unbounded, so that rounding errors leave no hole.
        let from = if level == -LEVELS {
            f64::NEG_INFINITY
        } else {
            ends[0]
        };
        let to = if level + 1 == LEVELS {
            f64::INFINITY
        } else {
            ends[1]
        };
        if high < from || low > to {
            continue;
        }
        let above = clipped(tile, from, 1.0);
        let between = clipped(&above, to, -1.0);
        let points: Vec<[f64; 2]> = between.iter().map(|(point, _)| *point).collect();
        sheet.polygon(points, colour(0.5 * (ends[0] + ends[1])));
    }
}

/// The part of a polygon above a level, or below it if `side` is −1; the deflection is linear along its sides.
fn clipped(polygon: &[Corner], level: f64, side: f64) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    let next = polygon.iter().cycle().skip(1);
    for (a, b) in polygon.iter().zip(next) {
        let [from_a, from_b] = [a, b].map(|(_, value)| side * (value - level));
        if from_a >= 0.0 {
            kept.push(*a);
        }
        if (from_a > 0.0 && from_b < 0.0) || (from_a < 0.0 && from_b > 0.0) {
            kept.push((between(a.0, b.0, from_a / (from_a - from_b)), level));
        }
    }
    kept
}

/// The point at a share of the way from `a` to `b`.
fn between(a: [f64; 2], b: [f64; 2], share: f64) -> [f64; 2] {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

/// Points at which the deflection changes its sign along the sides of a tile.
fn crossings(tile: &[Corner; 4]) -> Vec<[f64; 2]> {
    let next = tile.iter().cycle().skip(1);
    let sides = tile.iter().zip(next);
    let crossed = sides.filter(|(a, b)| (a.1 < 0.0) != (b.1 < 0.0));
    crossed
        .map(|(a, b)| between(a.0, b.0, a.1 / (a.1 - b.1)))
        .collect()
}

/// Draws the outline of a pad, or a ring for a small one.
fn draw_guide(sheet: &mut Sheet, guide: &GuideFile, scale: f64, centre: [f64; 2]) {
    let at = |[x, y]: [f64; 2]| [centre[0] + scale * x, centre[1] - scale * y];
    let stroke = Stroke::solid(INK, GUIDE_WIDTH);
    if scale * guide.radial_length_m.max(guide.tangential_length_m) < SMALL {
        let (sin, cos) = guide.angle_deg.to_radians().sin_cos();
        let middle = [guide.radius_m * cos, guide.radius_m * sin];
        sheet.ring(at(middle), 3.5, stroke);
        return;
    }
    let outline: Vec<_> = guide.outline_m().into_iter().map(at).collect();
    // The first side is drawn twice, because only corners inside a line are joined.
    sheet.line(outline.iter().chain(&outline[..2]).copied(), stroke);
}
