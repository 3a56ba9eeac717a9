//! The saw before, during and after a cut at one speed.

use faer::Col;

use crate::model::plate::Plate;
use crate::model::scene::{CutRun, Point};
use crate::model::system::GyroscopicSystem;
use crate::modes::{Assembled, SpectrumError};
use crate::motion::transient::{
    Deflections, Gauge, Integrator, Propagator, ReducedBlade, SAMPLES, Sinusoid, State,
    TransientError, damped_sinusoids, fitted_growth, lateral_load,
};
use crate::stability::{CRITICAL_MARGIN, GrowingModes};

use super::record::{
    Growth, MAX_SAMPLES, Record, SAMPLE_S, fastest_mode_rad_per_s, longest_step_s, steps_a_sample,
};
use super::saw::{MODES, SawInCut};
use super::stretching::{CutStretching, StretchedCut, stretched_cut};

/// One speed of a cut: eigenvalues and time history.
#[derive(Debug)]
pub(super) struct CutHistory {
    /// Growing modes compared with counts on the full model, without the forces and in the cut.
    pub growing: [GrowingModes; 2],
    /// Critical speeds of the saw in the cut and without the forces, ascending, up to slightly above the speed, or so far that the limit of
    /// its ratio to the first one is decided.
    pub critical_rad_per_s: Vec<f64>,
    /// Eigenvalues in a cut with the tangential force that follows from the power.
    pub in_cut_by_power: Option<Growth>,
    /// Growth fitted to the deflection in the cut; `None` without a lateral force.
    pub fitted: Option<Growth>,
    /// Frequency of the largest oscillation in the cut.
    pub dominant_rad_per_s: Option<f64>,
    /// Deflection at the probe.
    pub record: Record,
    /// Results with stretching; `None` unless the scene has `cut.stretching`.
    pub stretched: Option<CutStretching>,
}

impl CutHistory {
    /// Growth without the forces.
    pub fn idle(&self) -> Growth {
        self.growing[0].growing.into()
    }

    /// Growth in the cut.
    pub fn in_cut(&self) -> Growth {
        self.growing[1].growing.into()
    }

    /// Time at which the deflection exceeds the range of the model, linear or with stretching; the record
    /// ends there. `None` if it does not.
    pub fn valid_until_s(&self) -> Option<f64> {
        let stretched = self.stretched.as_ref();
        self.record
            .linear_until_s
            .or_else(|| stretched.and_then(|found| found.valid_until_s))
    }

    /// Largest deflections of the rim until the forces end and afterwards, while the model is valid.
    pub fn largest_deflections_m(&self, end_s: f64) -> [Option<f64>; 2] {
        let valid_until_s = self.valid_until_s().unwrap_or(f64::INFINITY);
        let largest = |after: bool| {
            let record = self.record.time_s.iter().zip(&self.record.largest_m);
            record
                .filter(|(time, _)| (**time > end_s) == after)
                .fold(0.0_f64, |max, (_, w)| max.max(*w))
        };
        let in_cut = (valid_until_s > end_s).then(|| largest(false));
        let after = self.valid_until_s().is_none().then(|| largest(true));
        [in_cut, after]
    }
}

/// Computes eigenvalues and time history at one speed of a cut; `margin` is the largest allowed ratio of the speed to the first critical
/// one.
///
/// # Errors
/// [`TransientError`].
pub(super) fn cut_history(
    saw: &SawInCut<'_>,
    probe: Point,
    margin: f64,
) -> Result<CutHistory, TransientError> {
    let SawInCut {
        plate, cut, run, ..
    } = saw;
    let speed = run.speed_rad_per_s;
    let by_power = run.tangential_of_power_n.map(|tangential_n| {
        let by_power = CutRun {
            tangential_n,
            ..**run
        };
        let plate = plate.in_cut(cut, &by_power);
        Growth::of_plate(&plate, speed)
    });
    let growing = [
        GrowingModes::of_plate(plate, speed)?,
        GrowingModes::of_plate(&saw.cutting, speed)?,
    ];
    let [idle, in_cut] = growing.each_ref().map(|found| Growth::from(found.growing));
    let (record, stretched) = if cut.stretching {
        let StretchedCut { record, found } = stretched_cut(saw, probe, [idle, in_cut])?;
        (record, Some(found))
    } else {
        let gauge = Gauge::new(plate, &saw.recorded, probe);
        (record(saw, &gauge, [idle, in_cut])?, None)
    };
    let gauge = Gauge::new(plate, &saw.blade, probe);
    let sinusoids = sinusoids_in_cut(saw, &gauge, in_cut)?;
    let mut critical = [
        critical_near(plate, speed, margin)?,
        critical_near(&saw.cutting, speed, margin)?,
    ]
    .concat();
    critical.sort_by(f64::total_cmp);
    Ok(CutHistory {
        critical_rad_per_s: critical,
        growing,
        in_cut_by_power: by_power.transpose()?,
        fitted: fitted_growth(&sinusoids).map(Growth::from),
        dominant_rad_per_s: sinusoids.iter().map(|s| s.lambda.im).find(|im| *im > 0.0),
        record,
        stretched,
    })
}

/// Critical speeds up to slightly above a speed, or so far that the ratio to them is at least a margin; none of a saw that has no stiffness at rest under the forces.
fn critical_near(
    plate: &Plate,
    speed_rad_per_s: f64,
    margin: f64,
) -> Result<Vec<f64>, SpectrumError> {
    let end = speed_rad_per_s / margin.min(1.0 - CRITICAL_MARGIN);
    match Assembled::from(plate.clone()).critical_speeds(Some(&|_| end)) {
        Ok(found) => Ok(found.iter().map(|c| c.speed_rad_per_s).collect()),
        Err(SpectrumError::UnstableAtRest { .. } | SpectrumError::Buckled { .. }) => Ok(Vec::new()),
        Err(other) => Err(other),
    }
}

/// Integrates the idle saw, the cut, and the idle saw again, while the linear model is valid.
fn record(
    saw: &SawInCut<'_>,
    gauge: &Gauge,
    [idle, in_cut]: [Growth; 2],
) -> Result<Record, TransientError> {
    let (cut, run) = (saw.cut, saw.run);
    let total_s = 2.0 * cut.idle_s + run.duration_s;
    let sample_s = SAMPLE_S.max(total_s / MAX_SAMPLES);
    let mut record = Record {
        time_s: vec![0.0],
        deflection_m: vec![0.0],
        largest_m: vec![0.0],
        linear_until_s: None,
    };
    let blade = &saw.recorded;
    let mut state = State::rest(blade.order());
    let phases = [
        (&saw.idle_system, idle, cut.idle_s, 0.0),
        (&saw.cutting_system, in_cut, run.duration_s, run.lateral_n),
        (&saw.idle_system, idle, cut.idle_s, 0.0),
    ];
    for (system, growth, duration_s, force_n) in phases {
        if duration_s == 0.0 {
            continue;
        }
        // A flat saw without a force remains flat, even if it is unstable.
        let moves = force_n != 0.0 || state != State::rest(blade.order());
        let longest_s = if moves {
            sample_s.min(longest_step_s(growth))
        } else {
            sample_s
        };
        let count = (duration_s / longest_s).ceil();
        let sample_s = duration_s / count;
        let start_s = record.time_s.last().copied().unwrap_or(0.0);
        let system = blade.system(system);
        let steps = steps_a_sample(&system, run.speed_rad_per_s, sample_s)?;
        let step_s = sample_s / steps as f64;
        let propagator = moves
            .then(|| propagator(saw, (blade, &system), step_s))
            .transpose()?;
        for sample in 1..=count as u64 {
            let time_s = start_s + sample as f64 * sample_s;
            let mut seen = Deflections {
                at_probe_m: 0.0,
                largest_m: 0.0,
            };
            for propagator in std::iter::repeat_n(&propagator, steps).flatten() {
                let next = propagator.step(&state, [&[force_n], &[force_n]])?;
                let read = gauge.read([&state, &next], step_s, (run.rpm, time_s))?;
                seen = Deflections {
                    largest_m: seen.largest_m.max(read.largest_m),
                    ..read
                };
                state = next;
            }
            if gauge.beyond(seen.largest_m) {
                record.linear_until_s = Some(time_s);
                return Ok(record);
            }
            record.push(time_s, seen);
        }
    }
    Ok(record)
}

/// The propagator of a reduced system under the lateral force of the teeth.
fn propagator(
    saw: &SawInCut<'_>,
    (blade, system): (&ReducedBlade, &GyroscopicSystem),
    step_s: f64,
) -> Result<Propagator, TransientError> {
    let lateral = lateral_load(saw.plate, &saw.cut.teeth.standing());
    let load: Col<f64> = blade.vector(&lateral);
    Propagator::new(system, saw.run.speed_rad_per_s, &[load], step_s)
}

/// Number of samples per period of the fastest mode that the fit resolves.
const SAMPLES_A_PERIOD: f64 = 5.0;
/// Deflection in metres at which the record for the fit ends. It may be this large because growth in a linear
/// model does not depend on the size of the force.
const FITTED_UP_TO_M: f64 = 1e30;

/// Sinusoids of the deflection in the cut, sampled finely enough to prevent aliasing; none without a lateral
/// force.
fn sinusoids_in_cut(
    saw: &SawInCut<'_>,
    gauge: &Gauge,
    in_cut: Growth,
) -> Result<Vec<Sinusoid>, TransientError> {
    let run = saw.run;
    if run.lateral_n == 0.0 {
        return Ok(Vec::new());
    }
    let system = saw.blade.system(&saw.cutting_system);
    let fastest = fastest_mode_rad_per_s(&system, run.speed_rad_per_s, MODES)?
        .max(in_cut.frequency_rad_per_s);
    let longest_s = (std::f64::consts::TAU / (SAMPLES_A_PERIOD * fastest))
        .min(longest_step_s(in_cut))
        .min(run.duration_s / (SAMPLES - 1) as f64);
    let count = (run.duration_s / longest_s).ceil();
    let step_s = run.duration_s / count;
    let propagator = propagator(saw, (&saw.blade, &system), step_s)?;
    let mut state = State::rest(saw.blade.order());
    let force = [run.lateral_n];
    let mut record = vec![0.0];
    for _ in 0..count as u64 {
        state = propagator.step(&state, [&force, &force])?;
        let deflection = gauge.at_probe_m(&state.displacement);
        record.push(deflection);
        // The fit uses only the first and the last samples, so that a long record need not be kept as a whole.
        if record.len() == 3 * SAMPLES {
            record.drain(SAMPLES..2 * SAMPLES);
        }
        if !deflection.is_finite() || deflection.abs() > FITTED_UP_TO_M {
            break;
        }
    }
    Ok(damped_sinusoids(&record, step_s)?)
}
