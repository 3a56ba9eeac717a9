//! Names of the colours of the figures, for other programs that draw the same data.

use serde::Serialize;

use super::style::{self, Colour};
use crate::report::{Direction, InstabilityKind};

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// Meaning of the colours.
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

/// Name of a colour of the palette.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Hue {
    Ink,
    Quiet,
    Forward,
    Backward,
    Standing,
    Divergence,
    Flutter,
    DivergenceShade,
    FlutterShade,
    DivergenceStreak,
    FlutterStreak,
    Alarm,
}

impl Hue {
    /// Colour of waves that run in a direction.
    pub(super) fn of_direction(direction: Direction) -> Self {
        match direction {
            Direction::Forward => Hue::Forward,
            Direction::Backward | Direction::Reflected => Hue::Backward,
            Direction::Standing => Hue::Standing,
        }
    }

    /// Colours of a kind of instability: for lines and text, for bands, and for bands so narrow that their shade
    /// would not be visible.
    pub(super) fn of_kind(kind: InstabilityKind) -> [Self; 3] {
        match kind {
            InstabilityKind::Divergence => {
                [Hue::Divergence, Hue::DivergenceShade, Hue::DivergenceStreak]
            }
            InstabilityKind::Flutter => [Hue::Flutter, Hue::FlutterShade, Hue::FlutterStreak],
        }
    }

    /// The colour of the hue.
    pub(super) fn colour(self) -> Colour {
        match self {
            Hue::Ink => style::INK,
            Hue::Quiet => style::QUIET,
            Hue::Forward => style::FORWARD,
            Hue::Backward => style::BACKWARD,
            Hue::Standing => style::STANDING,
            Hue::Divergence => style::DIVERGENCE,
            Hue::Flutter => style::FLUTTER,
            Hue::DivergenceShade => style::DIVERGENCE_SHADE,
            Hue::FlutterShade => style::FLUTTER_SHADE,
            Hue::DivergenceStreak => style::DIVERGENCE_STREAK,
            Hue::FlutterStreak => style::FLUTTER_STREAK,
            Hue::Alarm => style::ALARM,
        }
    }
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
