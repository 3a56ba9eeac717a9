//! Modes at the speeds of a chart, before and after they are followed.

use crate::modes::{Mode, NamedMode, SpectralModel};

/// Modes at one speed, to be followed.
#[derive(Debug, Clone)]
pub struct ModesAt {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Modes up to the model's `complete_to`, ordered by frequency; interpolated ones have no coordinates.
    pub modes: Vec<Mode>,
}

impl ModesAt {
    /// Whether the eigenproblem of the speed was solved.
    pub(crate) fn is_solved(&self) -> bool {
        self.modes.iter().all(Mode::is_solved)
    }

    pub(super) fn named(&self, model: &SpectralModel) -> SpeedSample {
        SpeedSample {
            speed_rad_per_s: self.speed_rad_per_s,
            modes: model.name(self.speed_rad_per_s, self.modes.clone()),
        }
    }
}

/// Modes at one speed of a chart.
#[derive(Debug, Clone)]
pub struct SpeedSample {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Modes with names, ordered by frequency; interpolated ones have no coordinates.
    pub modes: Vec<NamedMode>,
}

impl SpeedSample {
    /// Whether the eigenproblem of the speed was solved.
    pub fn is_solved(&self) -> bool {
        self.modes.iter().all(|named| named.mode.is_solved())
    }
}

/// One mode followed over speed.
#[derive(Debug, Clone, Default)]
pub struct Branch {
    /// Index of the sample, and of the mode in it, for consecutive samples.
    pub points: Vec<(usize, usize)>,
}
