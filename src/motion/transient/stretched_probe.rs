//! Readings of a moving blade that stretches.

use crate::model::scene::{Point, Polar};
use crate::motion::stretched_blade::{Equilibrium, LARGEST_SLOPE, Slopes, StretchedBlade};

use super::State;

/// The deflection at a probe, and the check that slopes are within the model.
pub(crate) struct StretchedProbe<'a> {
    blade: &'a StretchedBlade,
    probe: Point,
    slopes: Slopes,
    /// Largest slope of the blade so far.
    pub largest_slope: f64,
}

impl<'a> StretchedProbe<'a> {
    /// The probe before the first sample.
    pub fn new(blade: &'a StretchedBlade, probe: Point) -> Self {
        StretchedProbe {
            blade,
            probe,
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

    /// Deflection at the probe, in m.
    pub fn deflection_m(&self, state: &State, speed_rad_per_s: f64) -> f64 {
        let at = shape(state, speed_rad_per_s);
        let Polar {
            radius_m,
            angle_rad,
        } = self.probe.polar();
        self.blade.deflection_m(&at, radius_m, angle_rad)
    }
}

fn shape(state: &State, speed_rad_per_s: f64) -> Equilibrium {
    Equilibrium {
        speed_rad_per_s,
        coordinates: state.displacement.clone(),
        negative_eigenvalues: 0,
    }
}
