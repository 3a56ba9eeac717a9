//! What is seen of a blade that stretches and moves.

use crate::scene::Probe;
use crate::stretched::{Equilibrium, LARGEST_SLOPE, StretchedBlade};

use super::State;

/// The deflection at a probe, and the slopes up to which the model holds.
pub(super) struct StretchedProbe<'a> {
    blade: &'a StretchedBlade,
    probe: &'a Probe,
    /// Largest slope of the blade that was seen.
    pub largest_slope: f64,
}

impl<'a> StretchedProbe<'a> {
    /// For a blade, of which nothing was seen yet.
    pub fn new(blade: &'a StretchedBlade, probe: &'a Probe) -> Self {
        StretchedProbe {
            blade,
            probe,
            largest_slope: 0.0,
        }
    }

    /// Whether slopes are small enough for the model.
    pub fn holds(&mut self, state: &State, speed_rad_per_s: f64) -> bool {
        let slope = self.blade.largest_slope(&shape(state, speed_rad_per_s));
        self.largest_slope = self.largest_slope.max(slope);
        slope <= LARGEST_SLOPE
    }

    /// Deflection at the probe.
    pub fn deflection_m(&self, state: &State, speed_rad_per_s: f64) -> f64 {
        let at = shape(state, speed_rad_per_s);
        let Probe {
            radius_m,
            angle_rad,
        } = *self.probe;
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
