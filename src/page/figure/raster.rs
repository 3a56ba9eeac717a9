//! Renders a sheet as PNG, with one pixel for each figure unit. Equal sheets give equal bytes.

use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke as Pen, StrokeDash,
    Transform,
};

use super::FigureError;
use super::canvas::{Anchor, Frame, Lettering, Mark, Sheet, Stroke};
use super::letters::{outlines, text_width};
use super::style::Colour;

/// Width of a line in the colour of a polygon along its edge, without which the paper would be visible between polygons
/// with a common edge.
const SEAM: f32 = 1.0;

/// Renders a sheet as PNG.
///
/// # Errors
/// [`FigureError`] if the picture cannot be encoded.
pub fn png(sheet: &Sheet) -> Result<Vec<u8>, FigureError> {
    let [width, height] = sheet.size();
    let mut pixels = Vec::new();
    if let Some(mut picture) = Pixmap::new(width, height) {
        picture.fill(Color::WHITE);
        for mark in sheet.marks() {
            draw(&mut picture, mark);
        }
        let opaque = picture.pixels().iter();
        pixels.extend(opaque.flat_map(|p| [p.red(), p.green(), p.blue()]));
    }
    pack(&pixels, width, height)
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

fn draw(picture: &mut Pixmap, mark: &Mark) {
    match mark {
        Mark::Line(points, stroke) => draw_line(picture, points, *stroke),
        Mark::Fill(frame, colour) => fill(picture, frame, *colour),
        Mark::Polygon(corners, colour) => {
            if let Some(path) = path(corners, true) {
                fill_path(picture, &path, *colour);
                let pen = Pen {
                    width: SEAM,
                    line_join: LineJoin::Round,
                    ..Pen::default()
                };
                picture.stroke_path(&path, &paint(*colour), &pen, Transform::identity(), None);
            }
        }
        Mark::Disc([x, y], radius, colour) => {
            if let Some(circle) = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32) {
                fill_path(picture, &circle, *colour);
            }
        }
        Mark::Text(at, lettering, text) => write(picture, *at, lettering, text),
    }
}

fn draw_line(picture: &mut Pixmap, points: &[[f64; 2]], stroke: Stroke) {
    let dash = stroke
        .dash
        .map(|lengths| lengths.map(|l| l as f32).to_vec());
    let pen = Pen {
        width: stroke.width as f32,
        line_join: LineJoin::Round,
        dash: dash.and_then(|lengths| StrokeDash::new(lengths, 0.0)),
        ..Pen::default()
    };
    if let Some(path) = path(points, false) {
        picture.stroke_path(
            &path,
            &paint(stroke.colour),
            &pen,
            Transform::identity(),
            None,
        );
    }
}

/// Fills a rectangle. Sides that are not narrow begin and end at whole pixels, so that rectangles with a common edge leave
/// no paper between them.
fn fill(picture: &mut Pixmap, frame: &Frame, colour: Colour) {
    let [left, right] = whole_pixels([frame.left, frame.right]);
    let [top, bottom] = whole_pixels([frame.top, frame.bottom]);
    if let Some(rect) = Rect::from_ltrb(left, top, right, bottom) {
        picture.fill_rect(rect, &paint(colour), Transform::identity(), None);
    }
}

fn whole_pixels(ends: [f64; 2]) -> [f32; 2] {
    /// Width in pixels below which rounding would be visible.
    const NARROW: f64 = 2.0;
    let is_narrow = ends[1] - ends[0] < NARROW;
    ends.map(|end| if is_narrow { end } else { end.round() } as f32)
}

/// Writes a text; its point lies on the baseline.
fn write(picture: &mut Pixmap, [x, y]: [f64; 2], lettering: &Lettering, text: &str) {
    let width = text_width(text, lettering.em, lettering.weight);
    let offset = match lettering.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * width,
        Anchor::End => width,
    };
    let (x, y, before) = (x as f32, y as f32, offset as f32);
    let place = if lettering.upright {
        Transform::from_row(0.0, -1.0, 1.0, 0.0, x, y + before)
    } else {
        Transform::from_translate(x - before, y)
    };
    if let Some(letters) = outlines(text, lettering.em, lettering.weight) {
        picture.fill_path(
            &letters,
            &paint(lettering.colour),
            FillRule::Winding,
            place,
            None,
        );
    }
}

fn fill_path(picture: &mut Pixmap, path: &Path, colour: Colour) {
    let paint = paint(colour);
    picture.fill_path(path, &paint, FillRule::Winding, Transform::identity(), None);
}

/// The path through points; `None` for a single point.
fn path(points: &[[f64; 2]], is_closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (i, [x, y]) in points.iter().enumerate() {
        match i {
            0 => builder.move_to(*x as f32, *y as f32),
            _ => builder.line_to(*x as f32, *y as f32),
        }
    }
    if is_closed {
        builder.close();
    }
    builder.finish()
}

fn paint(colour: Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(colour.0, colour.1, colour.2, u8::MAX);
    paint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::figure::canvas::Mark;
    use crate::page::figure::style::{INK, PAPER};

    fn drawn(marks: &[Mark]) -> Pixmap {
        let mut picture = Pixmap::new(100, 100).unwrap();
        picture.fill(Color::WHITE);
        marks.iter().for_each(|mark| draw(&mut picture, mark));
        picture
    }

    /// Whether any pixel within a frame is dark.
    fn is_marked(picture: &Pixmap, frame: Frame) -> bool {
        let within = |x: u32, y: u32| {
            let (x, y) = (f64::from(x), f64::from(y));
            frame.left <= x && x < frame.right && frame.top <= y && y < frame.bottom
        };
        let places = (0..100).flat_map(|x| (0..100).map(move |y| (x, y)));
        places
            .filter(|(x, y)| within(*x, *y))
            .any(|(x, y)| picture.pixel(x, y).unwrap().red() < 128)
    }

    #[test]
    fn letters_stand_in_the_frame_of_their_text() {
        for (upright, anchor) in [(false, Anchor::Start), (true, Anchor::End)] {
            let lettering = Lettering {
                upright,
                ..Lettering::regular(20.0, INK, anchor)
            };
            let text = Mark::Text([40.0, 50.0], lettering, "a b".to_owned());
            let frame = crate::page::figure::canvas::text_frame([40.0, 50.0], &lettering, "a b");
            let picture = drawn(&[text]);
            let [x, y] = frame.centre();
            let (first, second) = if upright {
                (Frame { top: y, ..frame }, Frame { bottom: y, ..frame })
            } else {
                (Frame { right: x, ..frame }, Frame { left: x, ..frame })
            };
            assert!(is_marked(&picture, first) && is_marked(&picture, second));
            let beside = Frame {
                left: 80.0,
                top: 80.0,
                right: 100.0,
                bottom: 100.0,
            };
            assert!(!is_marked(&picture, beside));
        }
    }

    #[test]
    fn neighbouring_tiles_leave_no_paper_between_them() {
        let corner = |x: f64, y: f64| [10.0 + 30.3 * x, 10.0 + 30.3 * y];
        let tile = |x: f64| {
            let corners = [corner(x, 0.0), corner(x + 1.0, 0.2), corner(x + 1.0, 1.2)];
            let last = corner(x, 1.0);
            Mark::Polygon([&corners[..], &[last]].concat(), INK)
        };
        let picture = drawn(&[tile(0.0), tile(1.0)]);
        for x in 36..46 {
            let red = picture.pixel(x, 28).unwrap().red();
            assert!(red < INK.0 + (PAPER.0 - INK.0) / 16, "{x}: {red}");
        }
    }
}
