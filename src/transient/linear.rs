//! Validity of the linear model.
//!
//! A plate whose deflection exceeds its thickness also stretches, which makes it stiffer; the linear model
//! neglects this. The growth rate of small motions remains right, but large amplitudes do not.

use crate::plate::Plate;
use crate::scene::{Blade, Probe};

use super::reduced::{ReducedBlade, at_point};

/// Deflections beyond this many thicknesses of the blade are not reported.
pub const LINEAR_THICKNESSES: f64 = 5.0;

/// Largest deflection that is reported, from the smallest thickness of the blade.
pub fn linear_limit_m(blade: &Blade) -> f64 {
    LINEAR_THICKNESSES * blade.thickness_range_m().0
}

/// Evaluates the deflection at the probe.
#[derive(Debug)]
pub(super) struct Gauge {
    probe: Vec<f64>,
    limit_m: f64,
}

impl Gauge {
    pub(super) fn new(plate: &Plate, blade: &ReducedBlade, probe: &Probe) -> Self {
        let reading = blade.vector(&at_point(plate, probe.radius_m, probe.angle_rad));
        Gauge {
            probe: reading.iter().copied().collect(),
            limit_m: linear_limit_m(&plate.blade),
        }
    }

    /// Deflection of a motion given by its coordinates.
    pub(super) fn at_probe(&self, motion: impl Fn(usize) -> f64) -> f64 {
        let coordinates = self.probe.iter().enumerate();
        coordinates.map(|(i, c)| c * motion(i)).sum()
    }

    /// Whether a deflection is outside the linear model.
    pub(super) fn beyond(&self, deflection_m: f64) -> bool {
        deflection_m.abs() > self.limit_m
    }
}
