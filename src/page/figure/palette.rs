//! Names of the colours of the figures, for other programs that draw the same data.

use serde::Serialize;

use super::style::{self, Colour};

/// Colours of a heat map from low to high; lightness rises evenly, so that grey prints are legible too.
pub const LOW_TO_HIGH: [[u8; 3]; 5] = [
    [52, 24, 66],
    [58, 82, 139],
    [33, 145, 140],
    [122, 209, 81],
    [240, 236, 120],
];

/// Defines the colours of the figures from their names in [`style`].
macro_rules! colours {
    ($($hue:ident, $name:ident, $colour:ident;)*) => {
        /// Name of a colour of the figures.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Hue {
            $(#[doc = concat!("Key `", stringify!($name), "` of the palette.")] $hue,)*
        }

        impl Hue {
            /// The colour with this name.
            pub(crate) fn colour(self) -> Colour {
                match self {
                    $(Hue::$hue => style::$colour,)*
                }
            }
        }

        /// The colours of the figures, each as red, green and blue from 0 to 255.
        #[derive(Debug, Clone, Copy, Serialize)]
        pub struct Palette {
            $(#[doc = concat!("Colour of [`Hue::", stringify!($hue), "`].")] pub $name: [u8; 3],)*
        }

        /// The colours of the figures.
        pub const PALETTE: Palette = Palette {
            $($name: [style::$colour.0, style::$colour.1, style::$colour.2],)*
        };
    };
}

colours! {
    Paper, paper, PAPER;
    Ink, ink, INK;
    Quiet, quiet, QUIET;
    Grid, grid, GRID;
    Blank, blank, BLANK;
    Forward, forward, FORWARD;
    Backward, backward, BACKWARD;
    Standing, standing, STANDING;
    Divergence, divergence, DIVERGENCE;
    Flutter, flutter, FLUTTER;
    Alarm, alarm, ALARM;
    DivergenceShade, divergence_shade, DIVERGENCE_SHADE;
    FlutterShade, flutter_shade, FLUTTER_SHADE;
    DivergenceStreak, divergence_streak, DIVERGENCE_STREAK;
    FlutterStreak, flutter_streak, FLUTTER_STREAK;
}
