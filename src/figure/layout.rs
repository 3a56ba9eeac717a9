//! Lays out the panels of a chart one above the other, with heading, axes and key.

use super::axis::{Axis, draw_horizontal, draw_named, draw_vertical, draw_vertical_at};
use super::bands;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::chart_data::{Area, ChartData, Item, PanelData, Upright};
use super::declutter::{Extent, push_apart};
use super::heading;
use super::key;
use super::paint::Ground;
use super::style::{
    BETWEEN_FACTS, FINE_DASH, GRID, HAIRLINE, LABEL_SIZE, QUIET, Weight, shorten, tint,
};

const WIDTH: u32 = 1200;
const LEFT: f64 = 104.0;
const RIGHT: f64 = 1160.0;
const TOP: f64 = 92.0;
/// Height of a panel whose share is one.
const HEIGHT: f64 = 380.0;
/// Space between panels with the same horizontal axis, of which only the last has its name.
const BETWEEN: f64 = 46.0;
/// Space below a panel for numbers and name of its horizontal axis.
const NAMED: f64 = 58.0;
/// Space above a panel for its title, and for the labels of its vertical lines.
const ABOVE: f64 = 30.0;
/// Space between the labels of vertical lines.
const APART: f64 = 8.0;

/// Draws a chart.
pub fn sheet(data: &ChartData) -> Sheet {
    let frames = frames(&data.panels);
    let bottom = frames.last().map_or(TOP, |frame| frame.bottom) + NAMED;
    let height = bottom + key::height(&data.key, RIGHT - LEFT);
    let mut sheet = Sheet::new(WIDTH, height as u32);
    heading::draw(&mut sheet, &data.title, &data.facts.join(BETWEEN_FACTS));
    for (k, (panel, frame)) in data.panels.iter().zip(&frames).enumerate() {
        let below = data.panels.get(k + 1);
        draw_panel(
            &mut sheet,
            panel,
            frame,
            below.is_none_or(|next| next.x != panel.x),
        );
    }
    key::draw(&mut sheet, &data.key, [LEFT, bottom], RIGHT - LEFT);
    sheet
}

/// Frames of the panels from top to bottom.
fn frames(panels: &[PanelData]) -> Vec<Frame> {
    let mut top = TOP;
    let mut frames = Vec::new();
    for (k, panel) in panels.iter().enumerate() {
        let is_labelled = uprights(panel).any(|line| !line.label.is_empty());
        if is_labelled || !panel.title.is_empty() {
            top += ABOVE;
        }
        let frame = Frame {
            left: LEFT,
            top,
            right: RIGHT,
            bottom: top + HEIGHT * panel.share,
        };
        frames.push(frame);
        let is_shared = panels.get(k + 1).is_some_and(|next| next.x == panel.x);
        top = frame.bottom + if is_shared { BETWEEN } else { NAMED + ABOVE };
    }
    frames
}

fn draw_panel(sheet: &mut Sheet, panel: &PanelData, frame: &Frame, is_named: bool) {
    let x = panel.x.placed(frame.across());
    // Names are listed downwards.
    let y = match panel.y.names.is_empty() {
        true => panel.y.placed(frame.upwards()),
        false => panel.y.placed([frame.top, frame.bottom]),
    };
    let shaded = panel.items.iter().filter_map(|item| match item {
        Item::Band(band) => Some(band),
        _ => None,
    });
    bands::draw(sheet, &x, shaded, std::slice::from_ref(frame));
    for item in &panel.items {
        if let Item::Area(area) = item {
            draw_area(sheet, area, (&x, &y));
        }
    }
    if !panel.y.names.is_empty() {
        name_rows(sheet, panel, &y, frame);
    } else if panel.y.ticks.is_empty() {
        draw_vertical(sheet, &y, frame, &panel.y.title());
    } else {
        draw_vertical_at(sheet, &y, frame, &panel.y.title(), &panel.y.ticks);
    }
    let ground = Ground {
        x: &x,
        y: &y,
        frame,
    };
    ground.draw_lines(sheet, &panel.items);
    draw_uprights(sheet, panel, &x, frame);
    ground.draw_points(sheet, &panel.items);
    match is_named {
        true => draw_named(sheet, &x, frame.bottom, &panel.x.title()),
        false => draw_horizontal(sheet, &x, frame.bottom, false),
    }
    if !panel.note.is_empty() {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
        sheet.text_on_paper(frame.centre(), letters, &panel.note);
    }
    if !panel.title.is_empty() {
        let letters = Lettering::title(LABEL_SIZE, QUIET);
        sheet.text([frame.left, frame.top - 10.0], letters, &panel.title);
    }
}

/// Fills an area. The outline has a step half way between abscissae, and each connected part is one polygon.
fn draw_area(sheet: &mut Sheet, area: &Area, (x, y): (&Axis, &Axis)) {
    let colour = tint(area.colour.colour(), area.tint);
    let places: Vec<f64> = area.x.iter().map(|value| x.at(*value)).collect();
    let [least, most] = y.values();
    let edge = |values: &[f64], k: usize| y.at(values[k].clamp(least, most));
    let is_filled = |k: &usize| edge(&area.high, *k) < edge(&area.low, *k);
    let columns: Vec<usize> = (0..places.len()).collect();
    for part in columns.chunk_by(|a, b| is_filled(a) == is_filled(b)) {
        let steps = |values: &[f64]| {
            let ends = part.iter().flat_map(|k| {
                let before = places[k.saturating_sub(1)];
                let after = places[(k + 1).min(places.len() - 1)];
                let height = edge(values, *k);
                [before, after].map(|beside| [0.5 * (places[*k] + beside), height])
            });
            ends.collect::<Vec<_>>()
        };
        if part.first().is_some_and(is_filled) {
            let back = steps(&area.low).into_iter().rev();
            sheet.polygon(steps(&area.high).into_iter().chain(back), colour);
        }
    }
}

/// Writes the name of each row above a line, in the colour of the first points of the row.
fn name_rows(sheet: &mut Sheet, panel: &PanelData, y: &Axis, frame: &Frame) {
    for (row, name) in panel.y.names.iter().enumerate() {
        let value = 1.0 + row as f64;
        let of_row = panel.items.iter().find_map(|item| match item {
            Item::Points(points) if points.y.first() == Some(&value) => {
                Some(points.colour.colour())
            }
            _ => None,
        });
        sheet.horizontal(y.at(value), frame, Stroke::solid(GRID, HAIRLINE));
        let label = shorten(name, LABEL_SIZE, Weight::SemiBold, frame.right - frame.left);
        let letters = Lettering::title(LABEL_SIZE, of_row.unwrap_or(QUIET));
        sheet.text([frame.left, y.at(value) - 10.0], letters, &label);
    }
}

fn uprights(panel: &PanelData) -> impl Iterator<Item = &Upright> {
    panel.items.iter().filter_map(|item| match item {
        Item::Upright(upright) => Some(upright),
        _ => None,
    })
}

/// Draws the vertical lines, with their labels above the panel.
fn draw_uprights(sheet: &mut Sheet, panel: &PanelData, x: &Axis, frame: &Frame) {
    for line in uprights(panel).filter(|line| x.shows(line.x)) {
        sheet.vertical(x.at(line.x), frame, upright_stroke(line));
    }
    let labelled = uprights(panel).filter(|line| !line.label.is_empty() && x.shows(line.x));
    let labelled: Vec<&Upright> = labelled.collect();
    let extents = labelled
        .iter()
        .map(|line| Extent::of_label(x.at(line.x), &line.label, APART));
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    for (line, place) in labelled.iter().zip(push_apart(extents, frame.across())) {
        if let Some(place) = place {
            let leader = [[x.at(line.x), frame.top], [place, frame.top - 12.0]];
            sheet.line(leader, Stroke::solid(QUIET, HAIRLINE));
            sheet.text([place, frame.top - 17.0], letters, &line.label);
        }
    }
}

/// Style of a vertical line.
pub fn upright_stroke(line: &Upright) -> Stroke {
    match line.dashed {
        true => Stroke::dashed(line.colour.colour(), HAIRLINE, FINE_DASH),
        false => Stroke::solid(line.colour.colour(), 1.5 * HAIRLINE),
    }
}
