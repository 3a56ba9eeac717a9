//! The colours of the figures, for other programs that draw the same data.

use serde::Serialize;

use super::style::{self, Colour};

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// What is drawn in which colour.
#[derive(Debug, Clone, Copy, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Palette {
    pub paper: Rgb,
    pub ink: Rgb,
    pub quiet: Rgb,
    pub grid: Rgb,
    pub forward: Rgb,
    pub backward: Rgb,
    pub standing: Rgb,
    pub divergence: Rgb,
    pub flutter: Rgb,
    pub alarm: Rgb,
    pub divergence_shade: Rgb,
    pub flutter_shade: Rgb,
    pub divergence_streak: Rgb,
    pub flutter_streak: Rgb,
}

const fn rgb(colour: Colour) -> Rgb {
    [colour.0, colour.1, colour.2]
}

/// The colours of the figures.
pub const PALETTE: Palette = Palette {
    paper: rgb(style::PAPER),
    ink: rgb(style::INK),
    quiet: rgb(style::QUIET),
    grid: rgb(style::GRID),
    forward: rgb(style::FORWARD),
    backward: rgb(style::BACKWARD),
    standing: rgb(style::STANDING),
    divergence: rgb(style::DIVERGENCE),
    flutter: rgb(style::FLUTTER),
    alarm: rgb(style::ALARM),
    divergence_shade: rgb(style::DIVERGENCE_SHADE),
    flutter_shade: rgb(style::FLUTTER_SHADE),
    divergence_streak: rgb(style::DIVERGENCE_STREAK),
    flutter_streak: rgb(style::FLUTTER_STREAK),
};
