//! Readings of a moving blade that stretches.

use crate::model::scene::{Blade, Point};
use crate::motion::stretched_blade::{Equilibrium, LARGEST_SLOPE, StretchedBlade};

use super::State;
use super::deflections::{Deflections, Reader};

/// The deflections at a probe and around the rim, and the check that slopes are within the model.
pub(crate) struct StretchedProbe<'a> {
    blade: &'a StretchedBlade,
    reader: Reader,
    /// Largest slope of the blade so far.
    pub largest_slope: f64,
}

impl<'a> StretchedProbe<'a> {
    /// The probe before the first sample.
    pub fn new(blade: &'a StretchedBlade, outline: &Blade, probe: Point) -> Self {
        StretchedProbe {
            blade,
            reader: Reader::new(outline, probe, |place| blade.shapes_at(place)),
            largest_slope: 0.0,
        }
    }

    /// Whether the slopes of the blade are within the model, in which case the model holds.
    pub fn holds(&mut self, state: &State, speed_rad_per_s: f64) -> bool {
        let slope = self.blade.largest_slope(&shape(state, speed_rad_per_s));
        self.largest_slope = self.largest_slope.max(slope);
        slope <= LARGEST_SLOPE
    }

    /// Deflections at the probe and around the rim.
    pub fn read(&self, state: &State) -> Deflections {
        self.reader.read(&state.displacement)
    }
}

fn shape(state: &State, speed_rad_per_s: f64) -> Equilibrium {
    Equilibrium {
        speed_rad_per_s,
        coordinates: state.displacement.clone(),
        negative_eigenvalues: 0,
    }
}
