//! Areas of stable, diverging and fluttering saws over two numbers, with contours of speeds.

use super::{HEIGHT, KEYS, PANEL, WIDTH, facts};
use crate::analyses::map::{Contour, Contoured, MapAxis, MapReport, MappedSaw};
use crate::figure::along::Along;
use crate::figure::axis::{draw_named, draw_vertical};
use crate::figure::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use crate::figure::heading;
use crate::figure::heat::draw_grid;
use crate::figure::key::Key;
use crate::figure::style::{
    BLANK, CURVE, Colour, DASH, DIVERGENCE_STREAK, FLUTTER, FLUTTER_STREAK, FORWARD, INK,
    LABEL_SIZE, PAPER, tint,
};
use crate::stability::{CRITICAL_MARGIN, StabilityState};

/// Colour of stable saws within 5 % of a critical speed.
const AT_CRITICAL: Colour = plotters::style::RGBColor(196, 216, 232);
/// Colour of stable saws, lighter than those of instability in grey prints too.
const STABLE: Colour = plotters::style::RGBColor(228, 240, 228);

pub fn sheet(report: &MapReport, y: &MapAxis) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    heading::draw(&mut sheet, &report.scene.name, &facts(report));
    let across = Along::of_cells(&report.x.path, &report.x.values, PANEL.across());
    let up = Along::of_cells(&y.path, &y.values, PANEL.upwards());
    draw_vertical(&mut sheet, &up.axis, &PANEL, &up.name);
    let columns = report.x.values.len();
    draw_grid(
        &mut sheet,
        (&across.axis, &across.values),
        (&up.axis, &up.values),
        |column, row| {
            let saw = report.saws.get(row * columns + column);
            saw.map_or(BLANK, colour)
        },
    );
    draw_named(&mut sheet, &across.axis, PANEL.bottom, &across.name);
    draw_contours(&mut sheet, &report.contours, &across, &up);
    if across.shows(report.x.of_scene) && up.shows(y.of_scene) {
        let at = [across.at(report.x.of_scene), up.at(y.of_scene)];
        sheet.ring(at, 5.0, Stroke::solid(INK, 2.0));
    }
    draw_key(&mut sheet, report);
    sheet
}

fn colour(saw: &MappedSaw) -> Colour {
    match saw.state {
        _ if saw.not_analysed.is_some() => BLANK,
        None | Some(StabilityState::OutsideSweep) => PAPER,
        Some(StabilityState::Stable) if saw.at_critical_rpm.is_some() => AT_CRITICAL,
        Some(StabilityState::Stable) => STABLE,
        Some(StabilityState::Divergence) => tint(DIVERGENCE_STREAK, 0.6),
        Some(StabilityState::Flutter) => tint(FLUTTER_STREAK, 0.6),
    }
}

fn stroke(quantity: Contoured) -> Stroke {
    match quantity {
        Contoured::FlutterSpeed => Stroke::solid(FLUTTER, CURVE),
        Contoured::LowestCriticalSpeed => Stroke::dashed(FORWARD, CURVE, DASH),
    }
}

/// Draws contours, and writes on each its speed in rpm, as close to its middle as there is room.
fn draw_contours(sheet: &mut Sheet, contours: &[Contour], x: &Along, y: &Along) {
    let lines: Vec<(Vec<[f64; 2]>, &Contour)> = contours
        .iter()
        .map(|contour| {
            let places = contour.points.iter().map(|[a, b]| [x.at(*a), y.at(*b)]);
            (places.collect(), contour)
        })
        .collect();
    for (places, contour) in &lines {
        sheet.line(places.iter().copied(), stroke(contour.quantity));
    }
    let mut taken: Vec<Frame> = Vec::new();
    for (places, contour) in &lines {
        let letters =
            Lettering::regular(LABEL_SIZE, stroke(contour.quantity).colour, Anchor::Middle);
        let text = format!("{}", contour.rpm);
        let frame_at = |at: [f64; 2]| text_frame(at, &letters, &text).widened(3.0);
        let long = places.len() >= 3;
        // Points of the line are tried from its middle towards its ends.
        let middle = places.len() / 2;
        let tried = (0..middle).flat_map(|off| [middle + off, middle - off]);
        let free = tried
            .filter_map(|k| places.get(k))
            .map(|[x, y]| [*x, y + 0.36 * LABEL_SIZE])
            .find(|at| {
                let frame = frame_at(*at);
                let inside = frame.left > PANEL.left
                    && frame.right < PANEL.right
                    && frame.top > PANEL.top
                    && frame.bottom < PANEL.bottom;
                inside && !taken.iter().any(|other| other.overlaps(&frame))
            });
        if let Some(at) = free.filter(|_| long) {
            sheet.fill(frame_at(at), PAPER);
            sheet.text(at, letters, &text);
            taken.push(frame_at(at));
        }
    }
}

fn draw_key(sheet: &mut Sheet, report: &MapReport) {
    let blank = report.saws.iter().any(|saw| saw.not_analysed.is_some());
    let mut key = Key::new(sheet, PANEL.left, KEYS[0]);
    if report.rpm.is_some() {
        key.shade(STABLE)
            .word("stable")
            .shade(AT_CRITICAL)
            .word(&format!(
                "within {:.0} % of a critical speed",
                100.0 * CRITICAL_MARGIN
            ))
            .shade(tint(DIVERGENCE_STREAK, 0.6))
            .word("divergence")
            .shade(tint(FLUTTER_STREAK, 0.6))
            .word("flutter");
    }
    if blank {
        key.shade(BLANK).word("not analysed");
    }
    Key::new(sheet, PANEL.left, KEYS[1])
        .line(24.0, stroke(Contoured::FlutterSpeed))
        .word("flutter speed [rpm]")
        .line(24.0, stroke(Contoured::LowestCriticalSpeed))
        .word("lowest critical speed [rpm]")
        .ring(10.0, 5.0, Stroke::solid(INK, 2.0))
        .word("the scene");
}
