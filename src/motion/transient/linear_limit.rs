//! Validity of the linear model.
//!
//! A plate whose deflection exceeds its thickness also stretches, which makes it stiffer; the linear model
//! neglects this. Its growth rates are those of small motions; its large amplitudes are not valid.

use faer::Col;

use crate::model::plate::Plate;
use crate::model::scene::{Blade, Point};

use super::deflections::{Deflections, Reader};
use super::reduced_blade::{ReducedBlade, at_point};
use super::{State, TransientError};

/// Deflections beyond this many thicknesses of the blade are not reported.
pub const LINEAR_THICKNESSES: f64 = 5.0;

/// Largest deflection that is reported: [`LINEAR_THICKNESSES`] times the smallest thickness of the blade.
pub fn linear_limit_m(blade: &Blade) -> f64 {
    LINEAR_THICKNESSES * blade.thickness_range_m()[0]
}

/// Deflections of a motion on a reduced basis, and the limit of the linear model.
#[derive(Debug)]
pub(crate) struct Gauge {
    reader: Reader,
    limit_m: f64,
}

impl Gauge {
    pub fn new(plate: &Plate, blade: &ReducedBlade, probe: Point) -> Self {
        let shapes_at = |place| blade.vector(&at_point(plate, place));
        Gauge {
            reader: Reader::new(&plate.blade, probe, shapes_at),
            limit_m: linear_limit_m(&plate.blade),
        }
    }

    /// Deflection at the probe in m, from the coordinates on the basis.
    pub fn at_probe_m(&self, displacement: &Col<f64>) -> f64 {
        self.reader.at_probe_m(displacement)
    }

    /// Deflections in a step from one state on the basis to another, which ends at a time; refuses those that have overflowed.
    pub fn read(
        &self,
        states: [&State; 2],
        step_s: f64,
        (rpm, time_s): (f64, f64),
    ) -> Result<Deflections, TransientError> {
        let read = self.reader.read(states, step_s);
        if read.largest_m.is_finite() {
            Ok(read)
        } else {
            Err(TransientError::Overflow { rpm, time_s })
        }
    }

    /// Whether a deflection is outside the linear model.
    pub fn beyond(&self, deflection_m: f64) -> bool {
        deflection_m.abs() > self.limit_m
    }
}
