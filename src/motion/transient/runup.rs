//! The saw during a run-up under a constant side force.

use faer::Col;
use faer::linalg::solvers::Solve;

use crate::model::evenly_spaced;
use crate::model::plate::Plate;
use crate::model::scene::{Point, RunUpFile, SideForce, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::Cancellation;
use crate::modes::branches::Progress;

use super::deflections::Largest;
use super::linear_limit::Gauge;
use super::reduced_blade::{ReducedBlade, Snapshot, at_point};
use super::{Force, Integrator, Newmark, State, TransientError};

/// Deflection over the run-up.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RunUpHistory {
    /// Speeds of the record, in rad/s.
    pub speed_rad_per_s: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest deflection of the rim.
    pub largest: Largest,
    /// Speed at which the deflection exceeds the linear model, and the record ends; `None` if it does not.
    pub linear_until_rad_per_s: Option<f64>,
    /// Time step.
    pub step_s: f64,
}

/// Number of speeds whose modes form the basis.
const SNAPSHOTS: usize = 7;
/// Number of modes at each of these speeds; under a slow force the probe responds to few modes.
const MODES: usize = 6;
/// Number of steps per period of the highest frequency in the record.
const STEPS_A_PERIOD: f64 = 24.0;
/// Number of consecutive steps for which one speed is used.
const HELD_STEPS: usize = 8;
/// Largest number of samples of the record.
pub(super) const MAX_SAMPLES: usize = 30_000;

/// The basis of a run-up: modes at a few speeds, and static responses to the force.
pub(super) fn reduced_blade(plate: &Plate, runup: &RunUpFile, force: &SideForce) -> ReducedBlade {
    let system = GyroscopicSystem::of_plate(plate);
    let snapshots: Vec<Snapshot<'_>> = evenly_spaced(runup.speeds().ends(), SNAPSHOTS)
        .into_iter()
        .map(|speed_rad_per_s| Snapshot {
            system: &system,
            speed_rad_per_s,
        })
        .collect();
    ReducedBlade::new(
        plate,
        &snapshots,
        MODES,
        &[at_point(plate, force.at.polar())],
    )
}

/// Integrates the run-up, with steps that resolve the frequency `highest_rad_per_s`.
///
/// # Errors
/// [`TransientError::BentByForce`] if the static deflection is beyond the linear model,
/// [`TransientError::Overflow`] if a growing motion overflows.
pub fn run_up(
    plate: &Plate,
    (runup, force): (&RunUpFile, &SideForce),
    probe: Point,
    highest_rad_per_s: f64,
    progress: Progress<'_>,
) -> Result<RunUpHistory, TransientError> {
    let blade = reduced_blade(plate, runup, force);
    let system = blade.system(&GyroscopicSystem::of_plate(plate));
    let load = faer::Scale(force.force_n) * blade.vector(&at_point(plate, force.at.polar()));
    let gauge = Gauge::new(plate, &blade, probe);
    // The force acts from the beginning, so that the blade starts in its static deflection, if it has one.
    let from = runup.speeds().from_rad_per_s;
    let begun = State::still(static_deflection(&system, from, &load));
    let steps = Steps::new(runup, highest_rad_per_s);
    let stride = steps.count.div_ceil(MAX_SAMPLES);
    let mut history = RunUpHistory {
        speed_rad_per_s: Vec::new(),
        deflection_m: Vec::new(),
        largest: Largest::from(from),
        linear_until_rad_per_s: None,
        step_s: steps.step_s,
    };
    let moving = Moving {
        system: &system,
        load,
        forces: &[],
    };
    steps.integrate(&moving, begun, (stride, progress), |step| {
        history.take(&gauge, step)
    })?;
    if history.deflection_m.is_empty() {
        return Err(TransientError::BentByForce {
            force_n: force.force_n,
        });
    }
    Ok(history)
}

/// A blade under a constant load, with forces that depend on its deflection.
pub(super) struct Moving<'a> {
    /// Matrices of the reduced blade.
    pub system: &'a GyroscopicSystem,
    /// Load in N/√kg.
    pub load: Col<f64>,
    /// Forces that depend on the deflection.
    pub forces: &'a [&'a dyn Force],
}

/// A step of a run-up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<'a> {
    /// The states at its beginning and at its end; the run-up begins with a step from a state to itself.
    pub states: [&'a State; 2],
    /// Its length.
    pub step_s: f64,
    /// Speed at its end.
    pub speed_rad_per_s: f64,
    /// Time of its end.
    pub time_s: f64,
    /// Whether its end is a sample of the record.
    pub is_sample: bool,
}

/// The steps of a run-up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steps {
    /// Number of steps.
    pub count: usize,
    /// Length of a step.
    pub step_s: f64,
    from_rad_per_s: f64,
    rate_rad_per_s2: f64,
}

impl Steps {
    /// Steps that resolve a frequency, at least 100 and at most 10⁷.
    pub(super) fn new(runup: &RunUpFile, highest_rad_per_s: f64) -> Self {
        let longest_s = std::f64::consts::TAU / (STEPS_A_PERIOD * highest_rad_per_s);
        let count = (runup.duration_s / longest_s).ceil().clamp(100.0, 1e7) as usize;
        Steps {
            count,
            step_s: runup.duration_s / count as f64,
            from_rad_per_s: runup.speeds().from_rad_per_s,
            rate_rad_per_s2: runup.acceleration_rad_per_s2(),
        }
    }

    fn speed_at(&self, step: usize) -> f64 {
        self.from_rad_per_s + self.rate_rad_per_s2 * step as f64 * self.step_s
    }

    /// Integrates from a state and calls `show` with every step, until it returns false. Every `stride`-th state is a sample, and
    /// so are the first and the last one.
    pub(super) fn integrate(
        &self,
        moving: &Moving<'_>,
        begun: State,
        (stride, progress): (usize, Progress<'_>),
        mut show: impl FnMut(Step<'_>) -> Result<bool, TransientError>,
    ) -> Result<(), TransientError> {
        let (rate, step_s) = (self.rate_rad_per_s2, self.step_s);
        let loads = [moving.load.clone()];
        // `HELD_STEPS` consecutive steps use the speed in the middle of them, so that they share one
        // factorization. The error remains of second order.
        let held = |step: usize| {
            let middle = self.speed_at(step) + 0.5 * rate * step_s * HELD_STEPS as f64;
            let newmark = Newmark::new(moving.system, (middle, rate), &loads, step_s);
            newmark.with_forces(moving.forces)
        };
        let mut newmark = held(0);
        let stop = Cancellation::current();
        let (mut before, mut state) = (begun.clone(), begun);
        for step in 0..=self.count {
            let is_sample = step % stride == 0 || step == self.count;
            let seen = Step {
                states: [&before, &state],
                step_s,
                speed_rad_per_s: self.speed_at(step),
                time_s: step as f64 * step_s,
                is_sample,
            };
            if !show(seen)? {
                break;
            }
            if is_sample {
                progress(step, self.count);
            }
            before = state;
            state = newmark.step(&before, [&[1.0], &[1.0]])?;
            if (step + 1) % HELD_STEPS == 0 {
                stop.check()?;
                newmark = held(step + 1);
            }
        }
        Ok(())
    }
}

impl RunUpHistory {
    /// Adds a step; returns false if it exceeds the linear model.
    fn take(&mut self, gauge: &Gauge, step: Step<'_>) -> Result<bool, TransientError> {
        let speed = step.speed_rad_per_s;
        let read = gauge.read(step.states, step.step_s, (rpm(speed), step.time_s))?;
        if gauge.beyond(read.largest_m) {
            self.linear_until_rad_per_s = Some(speed);
            return Ok(false);
        }
        if step.is_sample {
            self.speed_rad_per_s.push(speed);
            self.deflection_m.push(read.at_probe_m);
        }
        self.largest.include(read, speed);
        Ok(true)
    }
}

/// K⁻¹f if K is positive definite; otherwise zero, because the blade has no stable static deflection.
fn static_deflection(system: &GyroscopicSystem, speed_rad_per_s: f64, load: &Col<f64>) -> Col<f64> {
    let stiffness = system.stiffness_at(speed_rad_per_s);
    match stiffness.llt(faer::Side::Lower) {
        Ok(factors) => factors.solve(load),
        Err(_) => Col::zeros(system.order()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::Scene;

    /// A run-up begins with the deflection K⁻¹f of all functions at the probe, also of a saw with a strong damper.
    #[test]
    fn a_run_up_begins_in_the_static_deflection_of_the_full_model() {
        let scene = Scene::paper()
            .edited(|file| {
                file.guides[0].damping_n_s_per_m = 1e4;
                let runup = file.runup.as_mut().unwrap();
                (runup.from_rpm, runup.to_rpm, runup.duration_s) = (300.0, 400.0, 0.1);
            })
            .unwrap();
        let resolution = Resolution {
            max_diameters: 12,
            radial_functions: 6,
        };
        let plate = Plate::new(&scene, resolution);
        let (runup, force, probe) = (scene.runup().unwrap(), scene.side_force(), scene.probe());
        let stiffness =
            GyroscopicSystem::of_plate(&plate).stiffness_at(runup.speeds().from_rad_per_s);
        let load = at_point(&plate, force.at.polar());
        let exact = force.force_n
            * (at_point(&plate, probe.polar()).transpose()
                * stiffness.partial_piv_lu().solve(&load));
        let history = run_up(&plate, (runup, &force), probe, 300.0, &|_, _| ()).unwrap();
        let begun = history.deflection_m[0];
        assert!((begun / exact - 1.0).abs() < 1e-7, "{begun:e} {exact:e}");
    }
}
