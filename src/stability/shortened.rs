//! The sweep that the program chooses, if the chart of the usual one is refused.

use super::error::AnalysisError;
use crate::model::scene::Scene;
use crate::modes::branches::CampbellError;

/// Limit at which a sweep that the program chooses ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shortened {
    /// Memory for the modes of the chart.
    Memory,
    /// Processor time of the search for bands.
    Time,
}

impl Shortened {
    /// The limit for which a chart was refused, and the end of the longest sweep within it, in rpm. `None` for a scene that gives the end
    /// of its sweep itself, and for other errors.
    pub(super) fn after(refused: &AnalysisError, scene: &Scene) -> Option<(Self, f64)> {
        if scene.sweep().is_some() {
            return None;
        }
        match *refused {
            AnalysisError::Campbell(CampbellError::TooLarge {
                largest_end_rpm, ..
            }) => Some((Shortened::Memory, largest_end_rpm?)),
            AnalysisError::TooLong { limit_rpm, .. } => Some((Shortened::Time, limit_rpm)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::SpectrumError;

    /// Only a sweep that the program chooses is made shorter, and only where a shorter one can be charted.
    #[test]
    fn a_chosen_sweep_ends_where_its_chart_is_allowed() {
        let too_long = AnalysisError::TooLong {
            key: "sweep.to_rpm",
            to_rpm: 36_500.0,
            limit_rpm: 36_180.0,
            critical_speeds: 42,
            needed_s: 400.0,
            allowed_s: 300.0,
        };
        let given = Scene::paper();
        assert!(given.sweep().is_some());
        let chosen = given.edited(|file| file.sweep = None).unwrap();
        let after = |refused: &AnalysisError| Shortened::after(refused, &chosen);
        assert_eq!(after(&too_long), Some((Shortened::Time, 36_180.0)));
        assert_eq!(Shortened::after(&too_long, &given), None);
        let cancelled = AnalysisError::Spectrum(SpectrumError::Cancelled);
        assert_eq!(after(&cancelled), None);
    }
}
