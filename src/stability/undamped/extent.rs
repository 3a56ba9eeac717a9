//! What a search of an undamped blade follows between its speeds.

use crate::modes::SpectralModel;

/// What a search follows between its speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The bands: modes that may coalesce with reflected ones, as far as their events are located.
    Bands,
    /// A diagram: all its modes, as accurately as its lines are drawn.
    Diagram,
}

impl Extent {
    /// Frequency up to which modes are followed.
    pub fn top_rad_per_s(self, model: &SpectralModel) -> f64 {
        match self {
            Extent::Bands => model.reflected_to_rad_per_s,
            Extent::Diagram => model.complete_to_rad_per_s,
        }
    }

    /// Relative error allowed for the squares of waves of one Krein sign, which cannot coalesce. With 0.003 the drawn modes of the
    /// gallery are within 3e-4 of the height of their diagram, with 0.01 within 7e-4, and with 0.02 one was off by a tenth.
    pub fn definite_tolerance(self) -> f64 {
        match self {
            Extent::Bands => 0.05,
            Extent::Diagram => 0.003,
        }
    }
}
