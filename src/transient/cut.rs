//! The saw before, during and after a cut at one speed.

use faer::{Col, c64};

use crate::plate::{Plate, RimForce};
use crate::scene::{Cut, CutRun, Probe, rpm};
use crate::spectrum::fastest_growing_of;
use crate::system::GyroscopicSystem;

use super::reduced::{MODES, ReducedBlade, Snapshot, at_point};
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

/// The forces of the teeth in the plane of the blade.
pub(super) fn rim_forces(cut: &Cut, tangential_n: f64, radial_n: f64) -> Vec<RimForce> {
    cut.tooth_angles_rad()
        .map(|angle_rad| RimForce {
            angle_rad,
            radial_n: -radial_n,
            tangential_n: -tangential_n,
        })
        .collect()
}

/// The plate under the forces of a cut in its plane.
pub fn in_cut_plate(plate: &Plate, cut: &Cut, run: &CutRun) -> Plate {
    plate.with_edge_loads(&rim_forces(cut, run.tangential_n, run.radial_n))
}

/// Σ φ(b, θ_k) of the teeth: the load of one newton across the blade on each.
pub(super) fn lateral_load(plate: &Plate, cut: &Cut, turn_rad: f64) -> Col<f64> {
    let mut load = Col::zeros(plate.degrees_of_freedom());
    for angle in cut.tooth_angles_rad() {
        load += at_point(plate, plate.blade.outer_radius_m, angle + turn_rad);
    }
    load
}

/// Computes one speed of a cut.
///
/// # Errors
/// [`TransientError`].
pub fn cut_history(
    plate: &Plate,
    cut: &Cut,
    run: &CutRun,
    probe: &Probe,
) -> Result<CutHistory, TransientError> {
    let speed = run.speed_rad_per_s;
    let cutting = in_cut_plate(plate, cut, run);
    let by_power = run.tangential_of_power_n.map(|tangential_n| {
        let plate = plate.with_edge_loads(&rim_forces(cut, tangential_n, run.radial_n));
        Growth::of_plate(&plate, speed)
    });
    let load = lateral_load(plate, cut, 0.0);
    let systems = [plate, &cutting].map(GyroscopicSystem::of_plate);
    let snapshots = systems.each_ref().map(|system| Snapshot {
        system,
        speed_rad_per_s: speed,
    });
    let blade = ReducedBlade::new(plate, &snapshots, MODES, std::slice::from_ref(&load));
    let phases = [
        (&systems[0], cut.idle_s, 0.0),
        (&systems[1], run.duration_s, run.lateral_n),
        (&systems[0], cut.idle_s, 0.0),
    ];
    let total_s = 2.0 * cut.idle_s + run.duration_s;
    let sample_s = SAMPLE_S.max(total_s / MAX_SAMPLES);
    let read = blade.vector(&at_point(plate, probe.radius_m, probe.angle_rad));
    let reduced_load = [blade.vector(&load)];
    let mut state = State::rest(blade.order());
    let (mut time_s, mut deflection_m) = (vec![0.0], vec![0.0]);
    let mut in_cut_record = (Vec::new(), sample_s);
    for (index, (system, duration_s, force_n)) in phases.into_iter().enumerate() {
        if duration_s == 0.0 {
            continue;
        }
        let count = (duration_s / sample_s).ceil();
        let step_s = duration_s / count;
        let propagator = Propagator::new(&blade.system(system), speed, &reduced_load, step_s)?;
        let (start_s, first) = (time_s[time_s.len() - 1], deflection_m.len() - 1);
        for step in 1..=count as usize {
            state = propagator.step(&state, &[force_n], &[force_n]);
            time_s.push(start_s + step as f64 * step_s);
            deflection_m.push(finite(state.read(&read), speed, time_s[time_s.len() - 1])?);
        }
        if index == 1 {
            in_cut_record = (deflection_m[first..].to_vec(), step_s);
        }
    }
    let sinusoids = damped_sinusoids(&in_cut_record.0, in_cut_record.1);
    let fitted = fitted_growth(&sinusoids).map(Growth::from);
    Ok(CutHistory {
        run: *run,
        idle: Growth::of_plate(plate, speed)?,
        in_cut: Growth::of_plate(&cutting, speed)?,
        in_cut_by_power: by_power.transpose()?,
        fitted,
        dominant_rad_per_s: sinusoids.iter().map(|s| s.lambda.im).find(|im| *im > 0.0),
        forces_s: (cut.idle_s, cut.idle_s + run.duration_s),
        time_s,
        deflection_m,
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
