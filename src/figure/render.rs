//! Renders a sheet as PNG or SVG. Equal sheets give equal bytes.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::FigureError;
use super::canvas::{Anchor, Lettering, Mark, Sheet, Stroke};
use super::letters::Written;
use super::style::PAPER;

/// Pixels of plotters, whose coordinates are integers, in a figure unit. A PNG is the mean of so many pixels in both
/// directions, and an SVG has a view box in them, so that lines of any slope are smooth.
const FINE: u32 = 4;

type Area<DB> = DrawingArea<DB, Shift>;

/// Renders a sheet as PNG, with one pixel for each figure unit.
///
/// # Errors
/// [`FigureError`] if plotters refuses a mark, or the picture cannot be encoded.
pub fn png(sheet: &Sheet) -> Result<Vec<u8>, FigureError> {
    let (width, height) = sheet.size();
    let fine_size = (width * FINE, height * FINE);
    // The buffer is white from the start, because filling it by plotters would take a tenth of the rendering
    // time.
    let mut fine = vec![255; fine_size.0 as usize * fine_size.1 as usize * 3];
    {
        let area = BitMapBackend::with_buffer(&mut fine, fine_size).into_drawing_area();
        draw(&area, sheet, draw_by_segments)?;
    }
    pack(
        &average(&fine, width as usize, height as usize),
        width,
        height,
    )
}

/// Renders a sheet as SVG.
///
/// # Errors
/// [`FigureError`] if plotters refuses a mark.
pub fn svg(sheet: &Sheet) -> Result<String, FigureError> {
    let (width, height) = sheet.size();
    let fine_size = (width * FINE, height * FINE);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, fine_size).into_drawing_area();
        area.fill(&PAPER).map_err(refused)?;
        draw(&area, sheet, draw_in_one)?;
    }
    Ok(finish_svg(&text, (width, height), fine_size))
}

/// Sets properties for which plotters has no option: size on the page, round joins, baselines and weights as in the
/// PNG. Names of scenes cannot contain the replaced patterns, because their quotation marks are escaped.
fn finish_svg(text: &str, (width, height): (u32, u32), fine_size: (u32, u32)) -> String {
    let drawn_size = format!("<svg width=\"{}\" height=\"{}\"", fine_size.0, fine_size.1);
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

fn pack(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, FigureError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    // Files are 1.5 times as large as with the best compression, but each figure is written some hundredths
    // of a second faster.
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// Mean colours of blocks of `FINE`² pixels. Columns are summed first, because that vectorizes well.
fn average(fine: &[u8], width: usize, height: usize) -> Vec<u8> {
    let block = FINE as usize;
    let count = (FINE * FINE) as u16;
    let mut columns = vec![0u16; width * block * 3];
    let mut pixels = Vec::with_capacity(width * height * 3);
    for rows in fine.chunks_exact(columns.len() * block) {
        columns.fill(0);
        for row in rows.chunks_exact(columns.len()) {
            for (sum, cell) in columns.iter_mut().zip(row) {
                *sum += u16::from(*cell);
            }
        }
        for cells in columns.chunks_exact(3 * block) {
            for colour in 0..3 {
                let sum: u16 = cells[colour..].iter().step_by(3).sum();
                pixels.push(((sum + count / 2) / count) as u8);
            }
        }
    }
    pixels
}

/// A function that draws a solid line.
type DrawLine<DB> = fn(&Area<DB>, &[[f64; 2]], Stroke) -> Result<(), FigureError>;

fn draw<DB>(area: &Area<DB>, sheet: &Sheet, draw_line: DrawLine<DB>) -> Result<(), FigureError>
where
    DB: DrawingBackend,
    DB::ErrorType: 'static,
{
    for mark in sheet.marks() {
        match mark {
            Mark::Line(points, stroke) => draw_stroke(area, points, *stroke, draw_line)?,
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

fn draw_stroke<DB>(
    area: &Area<DB>,
    points: &[[f64; 2]],
    stroke: Stroke,
    draw_line: DrawLine<DB>,
) -> Result<(), FigureError>
where
    DB: DrawingBackend,
{
    match stroke.dash {
        None => draw_line(area, points, stroke),
        Some(dash) => dashes(points, dash)
            .iter()
            .try_for_each(|dash| draw_line(area, dash, stroke)),
    }
}

/// Draws a line as one path, for SVG.
fn draw_in_one<DB>(area: &Area<DB>, points: &[[f64; 2]], stroke: Stroke) -> Result<(), FigureError>
where
    DB: DrawingBackend,
    DB::ErrorType: 'static,
{
    let style = stroke.colour.stroke_width(fine_width(stroke.width));
    let points: Vec<_> = points.iter().map(|&p| fine_point(p)).collect();
    area.draw(&PathElement::new(points, style)).map_err(refused)
}

/// Draws a line for PNG: each segment as a polygon, with discs at the joints, because the outline with mitred corners
/// that plotters fills for a whole curve has spikes at sharp turns.
fn draw_by_segments<DB>(
    area: &Area<DB>,
    points: &[[f64; 2]],
    stroke: Stroke,
) -> Result<(), FigureError>
where
    DB: DrawingBackend,
    DB::ErrorType: 'static,
{
    let fill = stroke.colour.filled();
    for (i, segment) in points.windows(2).enumerate() {
        if let Some(corners) = outline(segment[0], segment[1], stroke.width) {
            area.draw(&Polygon::new(corners.map(fine_point), fill))
                .map_err(refused)?;
        }
        let radius = fine_width(stroke.width) / 2;
        if i > 0 && radius > 1 {
            let joint = Circle::new(fine_point(segment[0]), radius, fill);
            area.draw(&joint).map_err(refused)?;
        }
    }
    Ok(())
}

/// Corners of a line segment of a given width; `None` for a segment of zero length.
fn outline(a: [f64; 2], b: [f64; 2], width: f64) -> Option<[[f64; 2]; 4]> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    let (nx, ny) = (-dy / length * width / 2.0, dx / length * width / 2.0);
    (length > 0.0).then_some([
        [a[0] + nx, a[1] + ny],
        [b[0] + nx, b[1] + ny],
        [b[0] - nx, b[1] - ny],
        [a[0] - nx, a[1] - ny],
    ])
}

fn draw_text<DB>(
    area: &Area<DB>,
    [x, y]: [f64; 2],
    lettering: &Lettering,
    text: &str,
) -> Result<(), FigureError>
where
    DB: DrawingBackend,
    DB::ErrorType: 'static,
{
    // In a bitmap, `Written` draws the baseline 0.62 em below the upper anchor; `finish_svg` sets the same
    // distance in the SVG.
    let above = 0.62 * lettering.em;
    let horizontal = match lettering.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let (font, corner) = match lettering.upright {
        false => (FontTransform::None, [x, y - above]),
        true => (FontTransform::Rotate270, [x - above, y]),
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
fn fine_point([x, y]: [f64; 2]) -> (i32, i32) {
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

    #[test]
    fn averaging_takes_the_mean_of_each_block() {
        let block = FINE as usize;
        let mut fine = vec![0; 2 * block * block * 3];
        fine[..3].fill(160);
        assert_eq!(average(&fine, 2, 1), [10, 10, 10, 0, 0, 0]);
    }
}
