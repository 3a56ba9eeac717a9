//! Axes, cells and colour bar of the goal over two numbers of a guide.

use super::along::Along;
use super::axis::{Spread, draw_named, draw_vertical, extremes, tick_label};
use super::canvas::{Frame, Sheet};
use super::heat::{draw_grid, draw_scale, ramp};
use super::style::{BLANK, Colour};
use crate::analyses::place::{Goal, GoalMap};

pub const WIDTH: u32 = 1100;
pub const HEIGHT: u32 = 760;
pub const PANEL: Frame = Frame {
    left: 104.0,
    top: 96.0,
    right: 950.0,
    bottom: 650.0,
};
const SCALE: [f64; 2] = [984.0, 1004.0];
/// Colours from low to high; lightness rises evenly, so that grey prints are legible too.
const LOW_TO_HIGH: [Colour; 5] = [
    plotters::style::RGBColor(52, 24, 66),
    plotters::style::RGBColor(58, 82, 139),
    plotters::style::RGBColor(33, 145, 140),
    plotters::style::RGBColor(122, 209, 81),
    plotters::style::RGBColor(240, 236, 120),
];

/// Title of the figure.
pub fn title(goal: Goal) -> &'static str {
    match goal {
        Goal::FlutterSpeed => "Flutter speed over the position of the guide",
        Goal::StableWindow => "Stable window around the operating speed",
    }
}

/// Goals in rpm of the cells that keep the limit of the critical speed.
pub fn goals(map: &GoalMap) -> impl Iterator<Item = f64> {
    let cells = (0..map.x.len() * map.y.len()).map(|k| (k % map.x.len(), k / map.x.len()));
    cells
        .filter(|&(column, row)| map.kept[row][column])
        .filter_map(|(column, row)| map.goal_rpm[row][column])
}

/// Colour scale for the values of the goal, from the smallest to the largest value in rpm.
pub struct Shades {
    low: f64,
    high: f64,
}

impl Shades {
    /// Colours for goals in rpm; if all are equal, for a range around them.
    pub fn of(goals_rpm: impl Iterator<Item = f64>) -> Self {
        let [low, high] = match extremes(goals_rpm) {
            [low, high] if low < high => [low, high],
            [low, _] if low.is_finite() => [0.99 * low, 1.01 * low + 1.0],
            _ => [0.0, 1.0],
        };
        Shades { low, high }
    }

    fn colour(&self, rpm: f64) -> Colour {
        ramp(&LOW_TO_HIGH, (rpm - self.low) / (self.high - self.low))
    }

    fn cell(&self, map: &GoalMap, column: usize, row: usize) -> Colour {
        match map.goal_rpm[row][column] {
            Some(rpm) if map.kept[row][column] => self.colour(rpm),
            _ => BLANK,
        }
    }
}

/// Draws axes, cells and colour bar; returns the axes.
pub fn draw_panel(sheet: &mut Sheet, map: &GoalMap, shades: &Shades) -> (Along, Along) {
    let x = Along::of_cells(&map.x_path, &map.x, PANEL.across());
    let y_path = map.y_path.as_deref();
    let y = Along::of_cells(y_path.unwrap_or_default(), &map.y, PANEL.upwards());
    if y_path.is_some() {
        draw_vertical(sheet, &y.axis, &PANEL, &y.name);
    }
    draw_grid(
        sheet,
        (&x.axis, &x.values),
        (&y.axis, &y.values),
        |column, row| shades.cell(map, column, row),
    );
    draw_named(sheet, &x.axis, PANEL.bottom, &x.name);
    let label = |rpm: f64| Some(tick_label(rpm));
    let shade = |rpm: f64| shades.colour(rpm);
    let (place, ends) = ((&PANEL, 20.0, SCALE), [shades.low, shades.high]);
    let ends = (ends, Spread::Linear);
    draw_scale(sheet, place, ends, "rpm", (shade, label));
    (x, y)
}
