//! Growth of a motion and the record of the probe, for the histories with and without stretching.

use std::f64::consts::TAU;

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;
use crate::modes::{Growing, companion_eigenpairs};
use crate::motion::transient::{Deflections, Sinusoid, TransientError};
use crate::stability::GrowingModes;

/// Sampling interval of a record, which is short enough for a figure.
pub const SAMPLE_S: f64 = 1e-3;
/// Largest number of samples of a record; longer ones have a longer sampling interval.
pub const MAX_SAMPLES: f64 = 20_000.0;
/// Largest number of steps from one sample to the next.
const MOST_STEPS: f64 = 16.0;
/// Largest exponent by which a vibration grows between two samples.
const GROWTH_A_SAMPLE: f64 = 0.1;

/// Growth rate and frequency of the fastest growing motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Re λ; zero for a stable undamped saw, negative for a stable damped one.
    pub growth_per_s: f64,
    /// Im λ of this motion.
    pub frequency_rad_per_s: f64,
    /// Whether a vibration grows without oscillation, this one or another.
    pub diverges: bool,
}

impl Growth {
    /// Growth from the eigenvalues of the full model.
    ///
    /// # Errors
    /// [`TransientError::Spectrum`].
    pub fn of_plate(plate: &Plate, speed_rad_per_s: f64) -> Result<Self, TransientError> {
        Ok(GrowingModes::of_plate(plate, speed_rad_per_s)?
            .growing
            .into())
    }

    /// Frequency of the motion, in Hz; `None` if it does not grow.
    pub fn growing_hz(self) -> Option<f64> {
        (self.growth_per_s > 0.0).then(|| self.frequency_rad_per_s / TAU)
    }
}

impl From<Growing> for Growth {
    /// An undamped saw without growing mode has a growth rate of zero.
    fn from(found: Growing) -> Self {
        let lambda = found.fastest.unwrap_or_default();
        Growth {
            growth_per_s: lambda.re,
            frequency_rad_per_s: lambda.im,
            diverges: found.diverges,
        }
    }
}

impl From<Sinusoid> for Growth {
    /// A static response has a growth rate that is rounding, and does not diverge.
    fn from(fitted: Sinusoid) -> Self {
        Growth {
            growth_per_s: fitted.lambda.re,
            frequency_rad_per_s: fitted.lambda.im,
            diverges: fitted.moves && fitted.lambda.im == 0.0 && fitted.lambda.re > 0.0,
        }
    }
}

/// The record of the probe.
#[derive(Debug)]
pub struct Record {
    /// Times of the record.
    pub time_s: Vec<f64>,
    /// Deflection at the probe at these times.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection of the rim up to each of these times, since the one before.
    pub largest_m: Vec<f64>,
    /// Time at which the deflection exceeds the linear model, and the record ends; `None` if it does not.
    pub linear_until_s: Option<f64>,
}

impl Record {
    /// Adds a sample.
    pub fn push(&mut self, time_s: f64, read: Deflections) {
        self.time_s.push(time_s);
        self.deflection_m.push(read.at_probe_m);
        self.largest_m.push(read.largest_m);
    }
}

/// Number of steps of a sample in which a step is at most a radian of the highest frequency of a reduced system, so that the
/// deflection between two states follows from their displacements and velocities.
///
/// # Errors
/// [`TransientError::Spectrum`].
pub fn steps_a_sample(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    sample_s: f64,
) -> Result<usize, TransientError> {
    let highest = fastest_mode_rad_per_s(system, speed_rad_per_s, usize::MAX)?;
    Ok((highest * sample_s).ceil().clamp(1.0, MOST_STEPS) as usize)
}

/// Length of a step that resolves a growth rate.
pub fn longest_step_s(growth: Growth) -> f64 {
    GROWTH_A_SAMPLE / growth.growth_per_s.max(f64::MIN_POSITIVE)
}

/// The highest frequency among the `modes` lowest modes of a reduced system, which represent its motion. The
/// shapes that represent static deflections are not excited.
pub fn fastest_mode_rad_per_s(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    modes: usize,
) -> Result<f64, TransientError> {
    let pairs = companion_eigenpairs(system, speed_rad_per_s)?;
    let mut frequencies: Vec<f64> = pairs.iter().map(|(lambda, _)| lambda.im.abs()).collect();
    frequencies.sort_by(f64::total_cmp);
    let highest = frequencies.get(modes - 1).or(frequencies.last());
    Ok(highest.copied().unwrap_or_default())
}
