//! The saw before, during and after a cut at one speed.

use std::ops::RangeInclusive;

use faer::c64;

use crate::plate::Plate;
use crate::scene::{CutRun, Probe, rpm};
use crate::spectrum::fastest_growing_of;
use crate::system::GyroscopicSystem;

use super::reduced::at_point;
use super::saw_in_cut::{SawInCut, lateral_load, rim_forces};
use super::sinusoids::{damped_sinusoids, fitted_growth};
use super::{Propagator, State, TransientError};

/// How fast a saw's motion grows at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Re λ; zero for an undamped saw that is stable, negative for a damped one.
    pub growth_per_s: f64,
    /// Im λ of the same motion.
    pub frequency_rad_per_s: f64,
}

impl Growth {
    /// From the eigenvalues of the whole basis.
    ///
    /// # Errors
    /// [`TransientError::Spectrum`].
    pub fn of_plate(plate: &Plate, speed_rad_per_s: f64) -> Result<Self, TransientError> {
        let fastest = fastest_growing_of(plate, speed_rad_per_s)?;
        Ok(fastest.unwrap_or_default().into())
    }
}

impl From<c64> for Growth {
    fn from(lambda: c64) -> Self {
        Growth {
            growth_per_s: lambda.re,
            frequency_rad_per_s: lambda.im,
        }
    }
}

/// One speed of a cut: eigenvalues and time history.
#[derive(Debug, Clone)]
pub struct CutHistory {
    /// Speed and forces.
    pub run: CutRun,
    /// Eigenvalues without the forces.
    pub idle: Growth,
    /// Eigenvalues in the cut.
    pub in_cut: Growth,
    /// Eigenvalues in a cut with the tangential force that the power allows.
    pub in_cut_by_power: Option<Growth>,
    /// Growth fitted on the deflection in the cut, `None` without a lateral force.
    pub fitted: Option<Growth>,
    /// Frequency of the largest oscillation in the cut.
    pub dominant_rad_per_s: Option<f64>,
    /// When the forces set in and when they end.
    pub forces_s: (f64, f64),
    /// Times of the record.
    pub time_s: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
}

/// Samples of a record: enough for a figure and for frequencies up to a few hundred hertz
/// in a second, and bounded.
const SAMPLE_S: f64 = 1e-3;
const MAX_SAMPLES: f64 = 20_000.0;

/// Computes one speed of a cut.
///
/// # Errors
/// [`TransientError`].
pub fn cut_history(saw: &SawInCut<'_>, probe: &Probe) -> Result<CutHistory, TransientError> {
    let SawInCut {
        plate, cut, run, ..
    } = saw;
    let speed = run.speed_rad_per_s;
    let by_power = run.tangential_of_power_n.map(|tangential_n| {
        let plate = plate.with_edge_loads(&rim_forces(cut, tangential_n, run.radial_n));
        Growth::of_plate(&plate, speed)
    });
    let record = record(saw, probe)?;
    let sinusoids = damped_sinusoids(&record.deflection_m[record.in_cut], record.cutting_step_s);
    Ok(CutHistory {
        run: **run,
        idle: Growth::of_plate(plate, speed)?,
        in_cut: Growth::of_plate(&saw.cutting, speed)?,
        in_cut_by_power: by_power.transpose()?,
        fitted: fitted_growth(&sinusoids).map(Growth::from),
        dominant_rad_per_s: sinusoids.iter().map(|s| s.lambda.im).find(|im| *im > 0.0),
        forces_s: (cut.idle_s, cut.idle_s + run.duration_s),
        time_s: record.time_s,
        deflection_m: record.deflection_m,
    })
}

/// What the probe sees.
struct Record {
    time_s: Vec<f64>,
    deflection_m: Vec<f64>,
    /// The samples from the first force to the last, and their step.
    in_cut: RangeInclusive<usize>,
    cutting_step_s: f64,
}

/// Steps through the idle saw, the cut, and the idle saw again.
fn record(saw: &SawInCut<'_>, probe: &Probe) -> Result<Record, TransientError> {
    let (cut, run, blade) = (saw.cut, saw.run, &saw.blade);
    let total_s = 2.0 * cut.idle_s + run.duration_s;
    let sample_s = SAMPLE_S.max(total_s / MAX_SAMPLES);
    let read = blade.vector(&at_point(saw.plate, probe.radius_m, probe.angle_rad));
    let load = [blade.vector(&lateral_load(saw.plate, cut, 0.0))];
    let mut state = State::rest(blade.order());
    let (mut time_s, mut deflection_m) = (vec![0.0], vec![0.0]);
    let mut phase = |system: &GyroscopicSystem, duration_s: f64, force_n: f64| {
        let first = time_s.len() - 1;
        if duration_s == 0.0 {
            return Ok((first..=first, sample_s));
        }
        let count = (duration_s / sample_s).ceil();
        let step_s = duration_s / count;
        let speed = run.speed_rad_per_s;
        let propagator = Propagator::new(&blade.system(system), speed, &load, step_s)?;
        for step in 1..=count as usize {
            state = propagator.step(&state, &[force_n], &[force_n]);
            time_s.push(time_s[first] + step as f64 * step_s);
            deflection_m.push(finite(state.read(&read), speed, time_s[first + step])?);
        }
        Ok::<_, TransientError>((first..=time_s.len() - 1, step_s))
    };
    phase(&saw.idle_system, cut.idle_s, 0.0)?;
    let (in_cut, cutting_step_s) = phase(&saw.cutting_system, run.duration_s, run.lateral_n)?;
    phase(&saw.idle_system, cut.idle_s, 0.0)?;
    Ok(Record {
        time_s,
        deflection_m,
        in_cut,
        cutting_step_s,
    })
}

/// The value, or the error that says when it ceased to be one.
pub(super) fn finite(value: f64, speed_rad_per_s: f64, time_s: f64) -> Result<f64, TransientError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(TransientError::Overflow {
        rpm: rpm(speed_rad_per_s),
        time_s,
    })
}
