//! Renders a sheet as SVG. Equal sheets give equal text.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters_backend::BackendCoord;

use super::FigureError;
use super::canvas::{Anchor, Lettering, Mark, Sheet, Stroke};
use super::letters::Written;
use super::style::PAPER;

/// Pixels of plotters, whose coordinates are integers, in a figure unit: the view box is in them, so that lines of any
/// slope are smooth.
const FINE: u32 = 4;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Renders a sheet as SVG.
///
/// # Errors
/// [`FigureError`] if plotters refuses a mark.
pub fn svg(sheet: &Sheet) -> Result<String, FigureError> {
    let [width, height] = sheet.size();
    let mut text = String::new();
    {
        let area =
            SVGBackend::with_string(&mut text, (width * FINE, height * FINE)).into_drawing_area();
        area.fill(&PAPER).map_err(refused)?;
        draw(&area, sheet)?;
    }
    Ok(finish_svg(&text, [width, height]))
}

/// Sets properties for which plotters has no option: size on the page, round joins, baselines and weights as in the
/// PNG. Names of scenes cannot contain the replaced patterns, because their quotation marks are escaped.
fn finish_svg(text: &str, [width, height]: [u32; 2]) -> String {
    let drawn_size = format!(
        "<svg width=\"{}\" height=\"{}\"",
        width * FINE,
        height * FINE
    );
    let shown_size = format!(
        "<svg width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\" stroke-linecap=\"butt\""
    );
    text.replacen(&drawn_size, &shown_size, 1)
        // Without crisp edges, the paper would be visible between areas with a common edge.
        .replace("<polygon ", "<polygon shape-rendering=\"crispEdges\" ")
        .replace("dy=\"0.76em\"", "dy=\"0.62em\"")
        .replace("font-weight=\"bold\"", "font-weight=\"600\"")
        .replace("opacity=\"1\" ", "")
}

fn draw(area: &Area<'_>, sheet: &Sheet) -> Result<(), FigureError> {
    for mark in sheet.marks() {
        match mark {
            Mark::Line(points, stroke) => draw_stroke(area, points, *stroke)?,
            Mark::Fill(frame, colour) => {
                let corners = [[frame.left, frame.top], [frame.right, frame.bottom]];
                let shape = Rectangle::new(corners.map(fine_point), colour.filled());
                area.draw(&shape).map_err(refused)?;
            }
            Mark::Polygon(points, colour) => {
                let points: Vec<_> = points.iter().map(|&p| fine_point(p)).collect();
                let shape = Polygon::new(points, colour.filled());
                area.draw(&shape).map_err(refused)?;
            }
            Mark::Disc(centre, radius, colour) => {
                let shape = Circle::new(fine_point(*centre), fine_width(*radius), colour.filled());
                area.draw(&shape).map_err(refused)?;
            }
            Mark::Text(at, lettering, text) => draw_text(area, *at, lettering, text)?,
        }
    }
    area.present().map_err(refused)
}

fn draw_stroke(area: &Area<'_>, points: &[[f64; 2]], stroke: Stroke) -> Result<(), FigureError> {
    match stroke.dash {
        None => draw_line(area, points, stroke),
        Some(dash) => dashes(points, dash)
            .iter()
            .try_for_each(|dash| draw_line(area, dash, stroke)),
    }
}

fn draw_line(area: &Area<'_>, points: &[[f64; 2]], stroke: Stroke) -> Result<(), FigureError> {
    let style = stroke.colour.stroke_width(fine_width(stroke.width));
    let points: Vec<_> = points.iter().map(|&p| fine_point(p)).collect();
    area.draw(&PathElement::new(points, style)).map_err(refused)
}

fn draw_text(
    area: &Area<'_>,
    [x, y]: [f64; 2],
    lettering: &Lettering,
    text: &str,
) -> Result<(), FigureError> {
    // `finish_svg` sets the distance of the baseline below the upper anchor.
    let above = 0.62 * lettering.em;
    let horizontal = match lettering.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let (font, corner) = if lettering.upright {
        (FontTransform::Rotate270, [x - above, y])
    } else {
        (FontTransform::None, [x, y - above])
    };
    let written = Written {
        text,
        at: fine_point(corner),
        em: lettering.em * f64::from(FINE),
        weight: lettering.weight,
        colour: lettering.colour,
        anchor: Pos::new(horizontal, VPos::Top),
        transform: font,
    };
    area.draw(&written).map_err(refused)
}

/// Divides a line into dashes, with given lengths of dash and gap.
fn dashes(points: &[[f64; 2]], [drawn, left_out]: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut all = vec![points[..1].to_vec()];
    let (mut visible, mut remaining) = (true, drawn);
    for segment in points.windows(2) {
        let (a, b) = (segment[0], segment[1]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mut done = 0.0;
        while length - done > remaining {
            done += remaining;
            let t = done / length;
            let turn = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            match (visible, all.last_mut()) {
                (true, Some(dash)) => dash.push(turn),
                _ => all.push(vec![turn]),
            }
            visible = !visible;
            remaining = if visible { drawn } else { left_out };
        }
        remaining -= length - done;
        if let (true, Some(dash)) = (visible, all.last_mut()) {
            dash.push(b);
        }
    }
    all
}

/// A point in the pixels of plotters.
fn fine_point([x, y]: [f64; 2]) -> BackendCoord {
    let fine = |value: f64| (value * f64::from(FINE)).round() as i32;
    (fine(x), fine(y))
}

/// A width in the pixels of plotters, at least one.
fn fine_width(width: f64) -> u32 {
    (width * f64::from(FINE)).round().max(1.0) as u32
}

fn refused(error: impl std::error::Error + Send + Sync + 'static) -> FigureError {
    FigureError::Draw(Box::new(error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_follow_a_bent_line() {
        let bent = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]];
        let cut = dashes(&bent, [3.0, 3.0]);
        let expected = [vec![[0.0, 0.0], [3.0, 0.0]], vec![[5.0, 1.0], [5.0, 4.0]]];
        assert_eq!(cut, expected);
    }
}
