//! Cells of a grid in the colours of a scale, and the scale.

use super::axis::Axis;
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::chart_data::with_unit;
use super::items::Heat;
use super::style::{AXIS_SIZE, Colour, HAIRLINE, QUIET};

/// Number of steps of a ramp. It is so small that many neighbouring cells have the same colour and are joined, and so
/// large that steps are not visible.
const STEPS: f64 = 40.0;

/// The colour at `share`, from 0 to 1, of a ramp between evenly spaced colours.
fn ramp(colours: &[Colour], share: f64) -> Colour {
    let share = (share.clamp(0.0, 1.0) * STEPS).round() / STEPS;
    let place = share * (colours.len() - 1) as f64;
    let below = (place.floor() as usize).min(colours.len() - 2);
    let mix = |low: u8, high: u8| {
        let (low, high) = (f64::from(low), f64::from(high));
        (low + (place - below as f64) * (high - low)).round() as u8
    };
    let (low, high) = (colours[below], colours[below + 1]);
    plotters::style::RGBColor(mix(low.0, high.0), mix(low.1, high.1), mix(low.2, high.2))
}

/// Fills the cells between edges. `colour` returns the colour of a column and a row, or `None` for a cell that is left out;
/// neighbours along x of the same colour are joined to one rectangle.
fn draw_grid(
    sheet: &mut Sheet,
    x_edges: &[f64],
    y_edges: &[f64],
    colour: impl Fn(usize, usize) -> Option<Colour>,
) {
    let columns = x_edges.len() - 1;
    for (row, ends) in y_edges.windows(2).enumerate() {
        let mut from = 0;
        while from < columns {
            let shade = colour(from, row);
            let run = (from..columns).take_while(|&column| colour(column, row) == shade);
            let to = from + run.count();
            let frame = Frame {
                left: x_edges[from],
                right: x_edges[to],
                top: ends[0].min(ends[1]),
                bottom: ends[0].max(ends[1]),
            };
            if let Some(shade) = shade {
                sheet.fill(frame, shade);
            }
            from = to;
        }
    }
}

/// Positions on the sheet of the edges of cells around values: the ends of the axis, and half way between the values.
fn edges(axis: &Axis, values: &[f64]) -> Vec<f64> {
    let [first, last] = axis.places();
    let between = values
        .windows(2)
        .map(|pair| 0.5 * (axis.at(pair[0]) + axis.at(pair[1])));
    std::iter::once(first)
        .chain(between)
        .chain(std::iter::once(last))
        .collect()
}

/// Fills the cells of a panel.
pub fn draw_cells(sheet: &mut Sheet, heat: &Heat, x: &Axis, y: &Axis) {
    let colours: Vec<Colour> = heat.colours.iter().map(|colour| rgb(*colour)).collect();
    let scale = Axis::new(heat.range, [0.0, 1.0], heat.spread);
    draw_grid(
        sheet,
        &edges(x, &heat.x),
        &edges(y, &heat.y),
        |column, row| {
            let value = heat
                .z
                .get(row)
                .and_then(|row| row.get(column))
                .copied()
                .filter(|value| !value.is_nan())?;
            Some(match colours[..] {
                [only] => only,
                _ => ramp(&colours, scale.at(value)),
            })
        },
    );
}

/// A colour from its red, green and blue.
pub fn rgb([red, green, blue]: [u8; 3]) -> Colour {
    plotters::style::RGBColor(red, green, blue)
}

/// Draws the vertical colour bar of a panel from an abscissa on, with numbers to its right.
pub fn draw_scale(sheet: &mut Sheet, heat: &Heat, panel: &Frame, left: f64) {
    const BARS: usize = 80;
    const WIDTH: f64 = 20.0;
    let frame = Frame {
        top: panel.top + 20.0,
        ..panel.between([left, left + WIDTH])
    };
    let colours: Vec<Colour> = heat.colours.iter().map(|colour| rgb(*colour)).collect();
    let height = (frame.bottom - frame.top) / BARS as f64;
    for bar in 0..BARS {
        let bottom = frame.bottom - bar as f64 * height;
        let cell = Frame {
            top: bottom - height,
            bottom,
            ..frame
        };
        sheet.fill(cell, ramp(&colours, (bar as f64 + 0.5) / BARS as f64));
    }
    let axis = Axis::new(heat.range, frame.upwards(), heat.spread);
    let letters = Lettering::regular(AXIS_SIZE, QUIET, Anchor::Start);
    for tick in axis.ticks(36.0) {
        let y = axis.at(tick);
        let short = [[frame.right, y], [frame.right + 5.0, y]];
        sheet.line(short, Stroke::solid(QUIET, HAIRLINE));
        let at = [frame.right + 9.0, y + 0.36 * AXIS_SIZE];
        sheet.text(at, letters, &axis.label(tick));
    }
    let name = with_unit(&heat.name, &heat.unit);
    sheet.text([frame.left, frame.top - 12.0], letters, &name);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::figure::canvas::Mark;
    use plotters::style::RGBColor;

    #[test]
    fn a_ramp_runs_from_its_first_to_its_last_colour() {
        let colours = [
            RGBColor(0, 0, 0),
            RGBColor(100, 0, 0),
            RGBColor(100, 200, 0),
        ];
        assert_eq!(ramp(&colours, -1.0), colours[0]);
        assert_eq!(ramp(&colours, 0.5), colours[1]);
        assert_eq!(ramp(&colours, 2.0), colours[2]);
        assert_eq!(ramp(&colours, 0.75), RGBColor(100, 100, 0));
    }

    #[test]
    fn equal_neighbours_join() {
        let mut sheet = Sheet::new(100, 100);
        let x = Axis::linear([0.0, 3.0], [0.0, 90.0]);
        let y = Axis::linear([0.0, 1.0], [90.0, 0.0]);
        let colours = [RGBColor(0, 0, 0), RGBColor(9, 9, 9)];
        draw_grid(
            &mut sheet,
            &edges(&x, &[0.0, 1.0, 2.0, 3.0]),
            &edges(&y, &[0.0, 1.0]),
            |column, row| Some(colours[usize::from(column + row > 1)]),
        );
        let frames: Vec<[f64; 4]> = sheet
            .marks()
            .iter()
            .filter_map(|mark| match mark {
                Mark::Fill(f, _) => Some([f.left, f.top, f.right, f.bottom]),
                _ => None,
            })
            .collect();
        let expected = [
            [0.0, 45.0, 45.0, 90.0],
            [45.0, 45.0, 90.0, 90.0],
            [0.0, 0.0, 15.0, 45.0],
            [15.0, 0.0, 90.0, 45.0],
        ];
        assert_eq!(frames, expected);
    }
}
