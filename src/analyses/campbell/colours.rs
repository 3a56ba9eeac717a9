//! Colours of the kinds of waves and of instability.

use super::{Direction, InstabilityKind};
use crate::page::figure::palette::Hue;

impl Hue {
    /// Colour of waves that run in a direction.
    pub(crate) fn of_direction(direction: Direction) -> Self {
        match direction {
            Direction::Forward => Hue::Forward,
            Direction::Backward | Direction::Reflected => Hue::Backward,
            Direction::Standing => Hue::Standing,
        }
    }

    /// Colours of a kind of instability: for lines and text, for bands, and for bands so narrow that their shade
    /// would not be visible.
    pub(crate) fn of_kind(kind: InstabilityKind) -> [Self; 3] {
        match kind {
            InstabilityKind::Divergence => {
                [Hue::Divergence, Hue::DivergenceShade, Hue::DivergenceStreak]
            }
            InstabilityKind::Flutter => [Hue::Flutter, Hue::FlutterShade, Hue::FlutterStreak],
        }
    }
}
