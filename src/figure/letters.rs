//! Width and drawing of text in the built-in fonts.
//!
//! In a browser plotters measures text by the fonts of the page and cannot draw text into a PNG. With the built-in
//! fonts a figure has the same bytes wherever it is drawn.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, PxScaleFont, ScaleFont};
use plotters::element::{Drawable, PointCollection};
use plotters::style::Color;
use plotters_backend::text_anchor::Pos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontFamily, FontStyle, FontTransform,
};

use super::style::{Colour, Weight};

/// Names of the font in an SVG, with replacements for systems without Inter.
const FAMILY: &str = "Inter, Helvetica, Arial, sans-serif";

/// Ratio of the size of a font in plotters to the em.
const SIZE_PER_EM: f64 = 1.24;

/// The built-in font of a weight; `None` if it cannot be read.
fn font(weight: Weight) -> Option<&'static FontRef<'static>> {
    static FONTS: OnceLock<[Option<FontRef<'static>>; 2]> = OnceLock::new();
    let [regular, semi_bold] = FONTS.get_or_init(|| {
        let files: [&[u8]; 2] = [
            include_bytes!("../../assets/fonts/Inter-Regular.otf"),
            include_bytes!("../../assets/fonts/Inter-SemiBold.otf"),
        ];
        files.map(|file| FontRef::try_from_slice(file).ok())
    });
    match weight {
        Weight::Regular => regular.as_ref(),
        Weight::SemiBold => semi_bold.as_ref(),
    }
}

/// Error of reading a built-in font.
#[derive(Debug, thiserror::Error)]
#[error("a built-in font cannot be read")]
pub struct UnreadableFont;

/// The built-in font of a weight in a size.
fn scaled(em: f64, weight: Weight) -> Option<PxScaleFont<&'static FontRef<'static>>> {
    Some(font(weight)?.as_scaled((em * SIZE_PER_EM) as f32))
}

/// Sum of the advances of the letters of a text with kerning, in the unit of `em`.
fn advance(text: &str, em: f64, weight: Weight) -> Option<f32> {
    let font = scaled(em, weight)?;
    let mut width = 0.0;
    let mut before = None;
    for letter in text.chars() {
        let glyph = font.glyph_id(letter);
        width += font.h_advance(glyph);
        width += before.map_or(0.0, |before| font.kern(before, glyph));
        before = Some(glyph);
    }
    Some(width)
}

/// Width of a line of text in the unit of `em`.
pub fn text_width(text: &str, em: f64, weight: Weight) -> f64 {
    // Widths are truncated to sixteenths of the unit, so that rounding errors of the sum rarely change them.
    const FINE: f64 = 16.0;
    match advance(text, em * FINE, weight) {
        Some(width) => f64::from(width).trunc() / FINE,
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
    pub colour: Colour,
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
    type FontError = UnreadableFont;

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

    fn layout_box(&self, text: &str) -> Result<((i32, i32), (i32, i32)), UnreadableFont> {
        let width = advance(text, self.em, self.weight).ok_or(UnreadableFont)?;
        Ok(((0, 0), (width as i32, self.em as i32)))
    }

    fn draw<E, Pixel: FnMut(i32, i32, BackendColor) -> Result<(), E>>(
        &self,
        text: &str,
        (left, top): BackendCoord,
        mut pixel: Pixel,
    ) -> Result<Result<(), E>, UnreadableFont> {
        let font = scaled(self.em, self.weight).ok_or(UnreadableFont)?;
        let colour = BackendTextStyle::color(self);
        let mut right = 0.0_f32;
        let mut before = None;
        for letter in text.chars() {
            let glyph = font.glyph_id(letter);
            right += before.map_or(0.0, |before| font.kern(before, glyph));
            before = Some(glyph);
            if let Some(outline) = font.outline_glyph(font.scaled_glyph(letter)) {
                let upper = (self.size() as f32 / 2.0 + outline.px_bounds().min.y) as i32;
                let mut drawn = Ok(());
                outline.draw(|x, y, share| {
                    if drawn.is_ok() {
                        let at = (left + x as i32 + right as i32, top + y as i32 + upper);
                        drawn = pixel(at.0, at.1, colour.mix(f64::from(share)));
                    }
                });
                if drawn.is_err() {
                    return Ok(drawn);
                }
            }
            right += font.h_advance(glyph);
        }
        Ok(Ok(()))
    }
}
