//! The goal over two numbers of a guide: axes, cells and the scale of their colours.

use super::axis::{Axis, Spread, draw_named, draw_vertical, tick_label};
use super::canvas::{Frame, Sheet};
use super::heat::{draw_grid, draw_scale, ramp};
use super::style::Colour;
use crate::report::{GoalEntry, MapEntry};

const WIDTH: u32 = 1100;
pub const HEIGHT: u32 = 760;
pub const PANEL: Frame = Frame {
    left: 104.0,
    top: 96.0,
    right: 950.0,
    bottom: 650.0,
};
const SCALE: [f64; 2] = [984.0, 1004.0];
/// From low to high: lightness rises evenly, so that grey prints read too.
const LOW_TO_HIGH: [Colour; 5] = [
    plotters::style::RGBColor(52, 24, 66),
    plotters::style::RGBColor(58, 82, 139),
    plotters::style::RGBColor(33, 145, 140),
    plotters::style::RGBColor(122, 209, 81),
    plotters::style::RGBColor(240, 236, 120),
];
/// Saws that break the limit, and places without a saw.
pub const BROKEN: Colour = plotters::style::RGBColor(214, 216, 220);

/// An axis of a number that may be spread by decades.
pub struct Along {
    axis: Axis,
    values: Vec<f64>,
    logarithmic: bool,
}

impl Along {
    fn new(values: &[f64], places: [f64; 2]) -> Self {
        let ends = [
            values.first().copied().unwrap_or(0.0),
            values.last().copied().unwrap_or(1.0),
        ];
        let logarithmic = ends[0] > 0.0 && ends[1] >= 10.0 * ends[0];
        let of = |value: f64| if logarithmic { value.log10() } else { value };
        Along {
            axis: Axis::new(ends.map(of), places, Spread::Linear),
            values: values.iter().map(|v| of(*v)).collect(),
            logarithmic,
        }
    }

    pub fn at(&self, value: f64) -> f64 {
        let value = if self.logarithmic {
            value.log10()
        } else {
            value
        };
        self.axis.at(value)
    }

    fn name(&self, path: &str) -> String {
        let (before, unit) = UNITS
            .iter()
            .find_map(|(suffix, unit)| Some((path.strip_suffix(suffix)?, *unit)))
            .unwrap_or((path, ""));
        let name = before.replace('_', " ");
        match (self.logarithmic, unit) {
            (true, unit) => format!("log₁₀ {name}\u{2003}[{unit}]"),
            (false, "") => name,
            (false, unit) => format!("{name}\u{2003}[{unit}]"),
        }
    }
}

const UNITS: [(&str, &str); 8] = [
    ("_n_s_per_m", "N·s/m"),
    ("_n_per_m", "N/m"),
    ("_kg_per_m3", "kg/m³"),
    ("_deg", "°"),
    ("_pa", "Pa"),
    ("_rpm", "rpm"),
    ("_s", "s"),
    ("_m", "m"),
];

/// Nothing yet.
pub fn empty() -> Sheet {
    Sheet::new(WIDTH, HEIGHT)
}

pub fn title(goal: GoalEntry) -> &'static str {
    match goal {
        GoalEntry::FlutterSpeed => "Flutter speed over the place of the guide",
        GoalEntry::StableWindow => "Stable window around the operating speed",
    }
}

/// Goals of the cells that are known and keep the limit.
pub fn goals(map: &MapEntry, is_known: impl Fn(usize, usize) -> bool) -> impl Iterator<Item = f64> {
    let cells = (0..map.x.len() * map.y.len()).map(|k| (k % map.x.len(), k / map.x.len()));
    cells
        .filter(move |&(column, row)| is_known(column, row) && map.kept[row][column])
        .filter_map(|(column, row)| map.goal_rpm[row][column])
}

/// Colours of goals between the least and the largest that are shown.
pub struct Shades {
    low: f64,
    high: f64,
}

impl Shades {
    pub fn of(goals_rpm: impl Iterator<Item = f64>) -> Self {
        let (low, high) = goals_rpm.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), rpm| {
            (low.min(rpm), high.max(rpm))
        });
        let (low, high) = match low < high {
            true => (low, high),
            false if low.is_finite() => (0.99 * low, 1.01 * low + 1.0),
            false => (0.0, 1.0),
        };
        Shades { low, high }
    }

    pub fn colour(&self, rpm: f64) -> Colour {
        ramp(&LOW_TO_HIGH, (rpm - self.low) / (self.high - self.low))
    }

    pub fn cell(&self, map: &MapEntry, column: usize, row: usize) -> Colour {
        match map.goal_rpm[row][column] {
            Some(rpm) if map.kept[row][column] => self.colour(rpm),
            _ => BROKEN,
        }
    }
}

/// Draws axes, cells and the scale; where numbers lie across and up.
pub fn draw_panel(
    sheet: &mut Sheet,
    map: &MapEntry,
    shades: &Shades,
    colour: impl Fn(usize, usize) -> Colour,
) -> (Along, Along) {
    let x = Along::new(&map.x, [PANEL.left, PANEL.right]);
    let y = Along::new(&map.y, [PANEL.bottom, PANEL.top]);
    if let Some(path) = &map.y_path {
        draw_vertical(sheet, &y.axis, &PANEL, &y.name(path));
    }
    draw_grid(sheet, (&x.axis, &x.values), (&y.axis, &y.values), colour);
    draw_named(sheet, &x.axis, PANEL.bottom, &x.name(&map.x_path));
    let label = |rpm: f64| Some(tick_label(rpm));
    let shade = |rpm: f64| shades.colour(rpm);
    let (place, ends) = ((&PANEL, 20.0, SCALE), [shades.low, shades.high]);
    draw_scale(sheet, place, ends, "rpm", (shade, label));
    (x, y)
}
