//! Lays out the panels of a chart in rows, with heading and key.

use super::canvas::{Frame, Sheet};
use super::chart_data::{ChartData, PanelData};
use super::heading;
use super::heat::draw_scale;
use super::items::{Heat, Item};
use super::key;
use super::labels::end_room;
use super::panel::{self, Named, lines_of_facts};
use super::style::BETWEEN_FACTS;
use super::tidiness::tidy;

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
/// Space beside a panel for the numbers of the vertical axis of the next one, and for its name too.
const NUMBERS: f64 = 64.0;
const NUMBERS_AND_NAME: f64 = 116.0;
/// Space at the right edge for the scale of colours.
const SCALE: f64 = 134.0;

/// Draws a chart.
pub fn sheet(data: &ChartData) -> Sheet {
    let grid = Grid::of(data);
    let height = grid.bottom() + key::height(&data.key, RIGHT - LEFT);
    let mut sheet = Sheet::new(WIDTH, height as u32);
    heading::draw(&mut sheet, &data.title, &data.facts.join(BETWEEN_FACTS));
    for (k, (panel, frame)) in data.panels.iter().zip(&grid.frames).enumerate() {
        let is_first = k % grid.columns == 0 || data.panels[k - 1].y != panel.y;
        let named = Named {
            x: !grid.is_shared(&data.panels, k),
            y: is_first,
        };
        panel::draw(&mut sheet, panel, frame, named);
    }
    grid.draw_scales(&mut sheet, &data.panels);
    key::draw(&mut sheet, &data.key, [LEFT, grid.bottom()], RIGHT - LEFT);
    tidy(sheet)
}

/// Frames of the panels, in rows from top to bottom.
struct Grid {
    frames: Vec<Frame>,
    columns: usize,
}

impl Grid {
    fn of(data: &ChartData) -> Self {
        let panels = &data.panels;
        let columns = data.columns.clamp(1, panels.len().max(1));
        let mut grid = Grid {
            frames: Vec::new(),
            columns,
        };
        let sides = sides(panels, columns);
        let mut top = TOP;
        for (row, beside) in panels.chunks(columns).enumerate() {
            let above = beside
                .iter()
                .zip(&sides)
                .map(|(panel, [left, right])| space_above(panel, right - left));
            top += above.fold(0.0, f64::max);
            let share = beside.iter().fold(0.0, |most, panel| panel.share.max(most));
            let bottom = top + HEIGHT * share;
            let frames = beside
                .iter()
                .zip(&sides)
                .map(|(panel, [left, right])| Frame {
                    left: *left,
                    top,
                    right: if panel.equal {
                        right.min(left + bottom - top)
                    } else {
                        *right
                    },
                    bottom,
                });
            grid.frames.extend(frames);
            let is_shared = grid.is_shared(panels, row * columns);
            top = bottom
                + if is_shared {
                    BETWEEN
                } else {
                    NAMED + 0.4 * ABOVE
                };
        }
        grid
    }

    /// Whether the panel below has the same horizontal axis.
    fn is_shared(&self, panels: &[PanelData], k: usize) -> bool {
        let below = panels.get(k + self.columns);
        below.is_some_and(|next| next.x == panels[k].x && self.columns == 1)
    }

    /// Upper edge of the key.
    fn bottom(&self) -> f64 {
        self.frames.last().map_or(TOP, |frame| frame.bottom) + NAMED
    }

    /// Draws the scale of colours of each row, unless it is that of the row above.
    fn draw_scales(&self, sheet: &mut Sheet, panels: &[PanelData]) {
        let mut above: Option<&Heat> = None;
        for (row, frames) in panels
            .chunks(self.columns)
            .zip(self.frames.chunks(self.columns))
        {
            let Some(heat) = row.iter().find_map(scaled) else {
                continue;
            };
            let is_known = above.is_some_and(|other| {
                (&other.colours, other.range, other.spread)
                    == (&heat.colours, heat.range, heat.spread)
            });
            if !is_known {
                draw_scale(sheet, heat, &frames[0], RIGHT - SCALE + 24.0);
            }
            above = Some(heat);
        }
    }
}

/// Left and right edges of the columns of panels.
fn sides(panels: &[PanelData], columns: usize) -> Vec<[f64; 2]> {
    let right = if panels.iter().any(|panel| scaled(panel).is_some()) {
        RIGHT - SCALE
    } else {
        RIGHT
    };
    let beside = panels
        .chunks(columns)
        .flat_map(|row| row.windows(2))
        .map(|pair| {
            if pair[0].y == pair[1].y {
                NUMBERS
            } else {
                NUMBERS_AND_NAME
            }
        })
        .fold(0.0, f64::max);
    let width = (right - LEFT - beside * (columns - 1) as f64) / columns as f64;
    let ends = |column: usize| {
        let of_column = panels.iter().skip(column).step_by(columns);
        of_column.map(end_room).fold(0.0, f64::max)
    };
    let sides = (0..columns).map(|column| {
        let left = LEFT + (width + beside) * column as f64;
        [left, left + width - ends(column)]
    });
    sides.collect()
}

/// The cells of a panel that have the colours of a scale.
fn scaled(panel: &PanelData) -> Option<&Heat> {
    panel.items.iter().find_map(|item| match item {
        Item::Heat(heat) if heat.has_scale() => Some(heat),
        _ => None,
    })
}

/// Space above a panel for its title, the facts below it, and the labels of vertical lines.
fn space_above(panel: &PanelData, width: f64) -> f64 {
    let has_labels = panel.uprights().any(|line| !line.label.is_empty());
    let parts = [!panel.title.is_empty(), has_labels]
        .into_iter()
        .filter(|part| *part)
        .count() as f64;
    ABOVE * parts + panel::FACT * lines_of_facts(panel, width).len() as f64
}
