//! Width and drawing of text in the built-in fonts.
//!
//! With the built-in fonts a figure has the same bytes wherever it is drawn, in a browser too.

use std::convert::Infallible;
use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, Point, PxScaleFont, ScaleFont};
use plotters::element::{Drawable, PointCollection};
use plotters::style::{Color, RGBColor};
use plotters_backend::text_anchor::Pos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontFamily, FontStyle, FontTransform,
};

use tiny_skia::{Path, PathBuilder};

/// Names of the font in an SVG, with replacements for systems without Inter.
const FAMILY: &str = "Inter, Helvetica, Arial, sans-serif";

/// Ratio of the size of a font in plotters to the em.
const SIZE_PER_EM: f64 = 1.24;

/// Weight of a font.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// Weight of most text.
    Regular,
    /// Weight of titles.
    SemiBold,
}

/// The built-in font of a weight; `None` if it cannot be read.
fn font(weight: Weight) -> Option<&'static FontRef<'static>> {
    static FONTS: OnceLock<[Option<FontRef<'static>>; 2]> = OnceLock::new();
    let [regular, semi_bold] = FONTS.get_or_init(|| {
        let files: [&[u8]; 2] = [
            include_bytes!("../../../assets/fonts/Inter-Regular.otf"),
            include_bytes!("../../../assets/fonts/Inter-SemiBold.otf"),
        ];
        files.map(|file| FontRef::try_from_slice(file).ok())
    });
    match weight {
        Weight::Regular => regular.as_ref(),
        Weight::SemiBold => semi_bold.as_ref(),
    }
}

/// The built-in font of a weight in a size.
fn scaled(em: f64, weight: Weight) -> Option<PxScaleFont<&'static FontRef<'static>>> {
    Some(font(weight)?.as_scaled((em * SIZE_PER_EM) as f32))
}

/// A line of text with kerning, in the unit of `em`.
struct SetLine {
    /// Letters with their abscissae.
    letters: Vec<(GlyphId, f32)>,
    /// Abscissa of the end.
    end: f32,
}

fn laid_out(text: &str, em: f64, weight: Weight) -> Option<SetLine> {
    let font = scaled(em, weight)?;
    let mut end = 0.0;
    let mut letters: Vec<(GlyphId, f32)> = Vec::new();
    for letter in text.chars() {
        let glyph = font.glyph_id(letter);
        end += letters
            .last()
            .map_or(0.0, |(before, _)| font.kern(*before, glyph));
        letters.push((glyph, end));
        end += font.h_advance(glyph);
    }
    Some(SetLine { letters, end })
}

/// Outlines of the letters of a text that begins at the origin, on the baseline; ordinates are downwards. `None` if
/// there is nothing to draw.
pub fn outlines(text: &str, em: f64, weight: Weight) -> Option<Path> {
    let font = scaled(em, weight)?;
    let scale = font.scale_factor();
    let mut path = PathBuilder::new();
    for (glyph, left) in laid_out(text, em, weight)?.letters {
        let at = |p: Point| (left + scale.horizontal * p.x, -scale.vertical * p.y);
        let mut end = None;
        // A space has no outline.
        let curves = font.font().outline(glyph).map(|outline| outline.curves);
        for curve in curves.unwrap_or_default() {
            let (from, to) = match curve {
                OutlineCurve::Line(from, to)
                | OutlineCurve::Quad(from, _, to)
                | OutlineCurve::Cubic(from, _, _, to) => (from, to),
            };
            if end != Some(from) {
                path.close();
                path.move_to(at(from).0, at(from).1);
            }
            let (x, y) = at(to);
            match curve {
                OutlineCurve::Line(..) => path.line_to(x, y),
                OutlineCurve::Quad(_, by, _) => path.quad_to(at(by).0, at(by).1, x, y),
                OutlineCurve::Cubic(_, by, and, _) => {
                    path.cubic_to(at(by).0, at(by).1, at(and).0, at(and).1, x, y);
                }
            }
            end = Some(to);
        }
        path.close();
    }
    path.finish()
}

/// Width of a line of text in the unit of `em`.
pub fn text_width(text: &str, em: f64, weight: Weight) -> f64 {
    // Widths are truncated to sixteenths of the unit, so that rounding errors of the sum rarely change them.
    const FINE: f64 = 16.0;
    match laid_out(text, em * FINE, weight) {
        Some(line) => f64::from(line.end).trunc() / FINE,
        None => 0.6 * em * text.chars().count() as f64,
    }
}

/// A text at a point, for plotters to draw.
pub struct Written<'a> {
    pub text: &'a str,
    /// Point in the pixels of the backend.
    pub at: BackendCoord,
    /// Height of an em in the pixels of the backend.
    pub em: f64,
    pub weight: Weight,
    pub colour: RGBColor,
    pub anchor: Pos,
    pub transform: FontTransform,
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Written<'_> {
    type Point = &'a BackendCoord;
    type IntoIter = std::iter::Once<&'a BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::once(&self.at)
    }
}

impl<DB: DrawingBackend> Drawable<DB> for Written<'_> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        mut points: I,
        backend: &mut DB,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<DB::ErrorType>> {
        points
            .next()
            .map_or(Ok(()), |at| backend.draw_text(self.text, self, at))
    }
}

impl BackendTextStyle for Written<'_> {
    type FontError = Infallible;

    fn color(&self) -> BackendColor {
        BackendStyle::color(&self.colour.to_rgba())
    }

    fn size(&self) -> f64 {
        self.em * SIZE_PER_EM
    }

    fn transform(&self) -> FontTransform {
        self.transform.clone()
    }

    fn style(&self) -> FontStyle {
        match self.weight {
            Weight::Regular => FontStyle::Normal,
            Weight::SemiBold => FontStyle::Bold,
        }
    }

    fn anchor(&self) -> Pos {
        self.anchor
    }

    fn family(&self) -> FontFamily<'_> {
        FontFamily::Name(FAMILY)
    }

    // Only renderers of pixels measure and draw; an SVG contains the text itself.
    fn layout_box(&self, _: &str) -> Result<((i32, i32), (i32, i32)), Self::FontError> {
        Ok(((0, 0), (0, 0)))
    }

    fn draw<E, Pixel: FnMut(i32, i32, BackendColor) -> Result<(), E>>(
        &self,
        _: &str,
        _: BackendCoord,
        _: Pixel,
    ) -> Result<Result<(), E>, Self::FontError> {
        Ok(Ok(()))
    }
}
