//! Draws a panel of a chart: axes, areas, curves, marks and labels.

use super::axis::Axis;
use super::axis_drawing::{
    draw_horizontal, draw_horizontal_at, draw_vertical_at, name_below, name_upright,
};
use super::bands;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::chart_data::{AxisData, PanelData};
use super::heat::draw_cells;
use super::items::{Area, Bars, Item};
use super::labels::Labels;
use super::painting::{Ground, upright_stroke};
use super::style::{
    GRID, HAIRLINE, LABEL_SIZE, QUIET, SUBTITLE_SIZE, Weight, broken, shorten, tint,
};

/// Height of a line of facts.
pub const FACT: f64 = 16.0;
/// Distance of the lowest letters above a panel from it.
const CLEAR: f64 = 10.0;
/// Smallest height of an area, so that it is visible.
const THINNEST: f64 = 1.5;

/// Which axes of a panel have numbers and a name: those that differ from the axes of the panels beside and below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Named {
    /// Whether the horizontal axis has numbers and a name.
    pub x: bool,
    /// Whether the vertical axis has a name.
    pub y: bool,
}

/// Draws a panel.
pub fn draw(sheet: &mut Sheet, panel: &PanelData, frame: &Frame, named: Named) {
    let x = panel.x.placed(frame.across());
    // Names are listed downwards.
    let y = if panel.y.names.is_empty() {
        panel.y.placed(frame.upwards())
    } else {
        panel.y.placed([frame.top, frame.bottom])
    };
    let ground = Ground {
        x: &x,
        y: &y,
        frame,
    };
    let shaded = panel.items.iter().filter_map(|item| match item {
        Item::Band(band) => Some(band),
        _ => None,
    });
    bands::draw(sheet, &x, shaded, std::slice::from_ref(frame));
    draw_areas(sheet, panel, &ground);
    if panel.y.names.is_empty() {
        draw_upwards(sheet, &panel.y, &y, frame, named.y);
    }
    let rows = panel.y.ticks.iter().take(panel.y.names.len());
    for value in rows {
        sheet.horizontal(y.at(*value), frame, Stroke::solid(GRID, HAIRLINE));
    }
    for item in &panel.items {
        match item {
            Item::Heat(heat) => draw_cells(sheet, heat, &x, &y),
            Item::Bars(bars) => draw_bars(sheet, bars, &ground),
            _ => {}
        }
    }
    draw_across(sheet, &panel.x, &x, frame, named.x);
    ground.draw_lines(sheet, &panel.items);
    for line in panel.uprights().filter(|line| x.shows(line.x)) {
        sheet.vertical(x.at(line.x), frame, upright_stroke(line));
    }
    ground.draw_points(sheet, &panel.items);
    name_rows(sheet, panel, &y, frame);
    let has_labels = Labels::new(sheet, &ground).draw(panel);
    draw_title(sheet, panel, frame, has_labels);
    if !panel.note.is_empty() {
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
        sheet.text_on_paper(frame.centre(), letters, &panel.note);
    }
}

/// Draws the vertical axis; one without a quantity has no ticks.
fn draw_upwards(sheet: &mut Sheet, data: &AxisData, axis: &Axis, frame: &Frame, is_named: bool) {
    if data.name.is_empty() {
        return;
    }
    let ticks = if data.ticks.is_empty() {
        axis.ticks(axis.apart())
    } else {
        data.ticks.clone()
    };
    draw_vertical_at(sheet, axis, frame, &ticks);
    if is_named {
        name_upright(sheet, frame.left - 76.0, frame, &data.title());
    }
}

/// Draws the horizontal axis, with numbers or names and the name of the quantity if `is_named`.
fn draw_across(sheet: &mut Sheet, data: &AxisData, axis: &Axis, frame: &Frame, is_named: bool) {
    if data.names.is_empty() {
        draw_horizontal(sheet, axis, frame.bottom, is_named)
    } else {
        let ticks = data.ticks.iter().copied().zip(&data.names);
        draw_horizontal_at(sheet, axis, frame.bottom, ticks, is_named);
    }
    if is_named {
        name_below(sheet, axis.places(), frame.bottom + 42.0, &data.title());
    }
}

/// Writes the title of a panel and the facts below it, above the labels of vertical lines.
fn draw_title(sheet: &mut Sheet, panel: &PanelData, frame: &Frame, has_labels: bool) {
    let width = frame.right - frame.left;
    let mut baseline = frame.top - CLEAR - if has_labels { 26.0 } else { 0.0 };
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    for line in lines_of_facts(panel, width).iter().rev() {
        sheet.text([frame.left, baseline], letters, line);
        baseline -= FACT;
    }
    let title = shorten(&panel.title, SUBTITLE_SIZE, Weight::SemiBold, width);
    if !panel.facts.is_empty() {
        baseline -= 2.0;
    }
    sheet.text(
        [frame.left, baseline],
        Lettering::title(SUBTITLE_SIZE, panel.colour.colour()),
        &title,
    );
}

/// Fills the areas, each connected part of one as a polygon.
fn draw_areas(sheet: &mut Sheet, panel: &PanelData, ground: &Ground) {
    for item in &panel.items {
        if let Item::Area(area) = item {
            draw_area(sheet, area, ground);
        }
    }
}

fn draw_area(sheet: &mut Sheet, area: &Area, ground: &Ground) {
    let colour = tint(area.colour.colour(), area.tint);
    let places: Vec<f64> = area.x.iter().map(|value| ground.x.at(*value)).collect();
    let [least, most] = ground.y.values();
    let edge = |values: &[f64], k: usize| ground.y.at(values[k].clamp(least, most));
    let is_filled = |k: &usize| {
        let [low, high] = [&area.low, &area.high].map(|values| values[*k]);
        low < high && high >= least && low <= most
    };
    let columns: Vec<usize> = (0..places.len()).collect();
    for part in columns.chunk_by(|a, b| is_filled(a) == is_filled(b)) {
        if !part.first().is_some_and(is_filled) {
            continue;
        }
        let side = |values: &[f64]| -> Vec<[f64; 2]> {
            let ends = part.iter().flat_map(|k| {
                if area.stepped {
                    half_way(&places, *k)
                        .map(|x| [x, edge(values, *k)])
                        .to_vec()
                } else {
                    vec![[places[*k], edge(values, *k)]]
                }
            });
            ends.collect()
        };
        let (low, high) = (side(&area.low), side(&area.high));
        let thickest = low.iter().zip(&high).map(|(low, high)| low[1] - high[1]);
        if !area.stepped && thickest.fold(0.0, f64::max) < THINNEST {
            let middle = low
                .iter()
                .zip(&high)
                .map(|(low, high)| [low[0], 0.5 * (low[1] + high[1])]);
            sheet.line(middle, Stroke::solid(colour, THINNEST));
        } else {
            sheet.polygon(high.into_iter().chain(low.into_iter().rev()), colour);
        }
    }
}

/// Places half way from a place to its neighbours.
fn half_way(places: &[f64], k: usize) -> [f64; 2] {
    let before = places[k.saturating_sub(1)];
    let after = places[(k + 1).min(places.len() - 1)];
    [before, after].map(|beside| 0.5 * (places[k] + beside))
}

/// Draws columns, with a gap between them if they are wide; very narrow ones are thin lines.
fn draw_bars(sheet: &mut Sheet, bars: &Bars, ground: &Ground) {
    let colour = tint(bars.colour.colour(), bars.tint);
    for (ends, height) in bars.edges.windows(2).zip(&bars.heights) {
        let (left, right) = (ground.x.at(ends[0]), ground.x.at(ends[1]));
        let bar = Frame {
            left,
            right: (right - 1.0).max(left + 1.0),
            top: ground.y.at(*height),
            bottom: ground.frame.bottom,
        };
        sheet.fill(bar, colour);
    }
}

/// Writes the name of each row above a line, in the colour of the first points of the row.
fn name_rows(sheet: &mut Sheet, panel: &PanelData, y: &Axis, frame: &Frame) {
    for (value, name) in panel.y.ticks.iter().zip(&panel.y.names) {
        let of_row = panel.items.iter().find_map(|item| match item {
            Item::Points(points) if points.y.first() == Some(value) => Some(points.colour.colour()),
            _ => None,
        });
        let label = shorten(name, LABEL_SIZE, Weight::SemiBold, frame.right - frame.left);
        let letters = Lettering::title(LABEL_SIZE, of_row.unwrap_or(QUIET));
        sheet.text_on_paper([frame.left, y.at(*value) - 10.0], letters, &label);
    }
}

/// The facts of a panel in lines of its width.
pub fn lines_of_facts(panel: &PanelData, width: f64) -> Vec<String> {
    if panel.facts.is_empty() {
        Vec::new()
    } else {
        broken(&panel.facts.join("; "), width)
    }
}
