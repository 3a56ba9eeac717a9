//! Readings of a moving blade that stretches.

use crate::model::scene::{Blade, Point};
use crate::motion::stretched_blade::{LARGEST_SLOPE, Slopes, StretchedBlade};

use super::State;
use super::deflections::{Deflections, Reader};

/// The deflections at a probe and around the rim, and the check that slopes are within the model.
pub(crate) struct StretchedProbe {
    reader: Reader,
    slopes: Slopes,
    /// Largest slope of the blade so far.
    pub largest_slope: f64,
}

impl StretchedProbe {
    /// The probe before the first sample.
    pub fn new(blade: &StretchedBlade, outline: &Blade, probe: Point) -> Self {
        StretchedProbe {
            reader: Reader::new(outline, probe, |place| blade.shapes_at(place)),
            slopes: blade.slopes(),
            largest_slope: 0.0,
        }
    }

    /// Whether the slopes of the blade are within the model, in which case the model holds.
    pub fn holds(&mut self, state: &State) -> bool {
        let slope = self.slopes.largest(&state.displacement);
        self.largest_slope = self.largest_slope.max(slope);
        slope <= LARGEST_SLOPE
    }

    /// Deflection at the probe.
    pub fn at_probe_m(&self, state: &State) -> f64 {
        self.reader.at_probe_m(&state.displacement)
    }

    /// Deflections at the probe and around the rim in a step from one state to another.
    pub fn read(&self, states: [&State; 2], step_s: f64) -> Deflections {
        self.reader.read(states, step_s)
    }
}
