//! The cut of a blade that stretches.

use std::f64::consts::TAU;

use faer::{Col, Scale};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::scene::{Blade, Point};
use crate::model::system::GyroscopicSystem;
use crate::modes::Cancellation;
use crate::motion::stretched_blade::StretchedBlade;
use crate::motion::transient::{
    Deflections, Integrator, Newmark, ReducedBlade, Snapshot, State, StretchedProbe,
    TransientError, forces, lateral_load, reduced_system,
};

use super::record::{
    Growth, MAX_SAMPLES, Record, SAMPLE_S, fastest_mode_rad_per_s, longest_step_s,
};
use super::saw::SawInCut;

/// Numbers of a time history in the cut with stretching.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutStretching {
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Longest step of the integration.
    pub step_s: f64,
    /// Largest slope of the blade in the time history.
    pub largest_slope: f64,
    /// Time at which slopes exceed 0.1 and the record ends; null if they do not.
    pub valid_until_s: Option<f64>,
}

/// Number of modes of the idle and of the cutting saw in the basis.
const MODES: usize = 8;
/// Number of steps per period of the highest of the modes in the basis.
const STEPS_A_PERIOD: f64 = 24.0;
/// Time between evaluations of the slopes.
const LOOK_S: f64 = 0.01;

/// A cut with stretching.
pub(super) struct StretchedCut {
    pub record: Record,
    pub found: CutStretching,
}

/// Integrates the idle saw, the cut, and the idle saw again with the potential of stretching, while the model
/// is valid. The steps conserve the energy of an undamped blade.
///
/// # Errors
/// [`TransientError::Stretched`] if nothing holds the blade, [`TransientError::NotBalanced`] if a step has no
/// solution.
pub(super) fn stretched_cut(
    saw: &SawInCut<'_>,
    probe: Point,
    growths: [Growth; 2],
) -> Result<StretchedCut, TransientError> {
    with_modes(saw, probe, growths, MODES)
}

fn with_modes(
    saw: &SawInCut<'_>,
    probe: Point,
    growths: [Growth; 2],
    modes: usize,
) -> Result<StretchedCut, TransientError> {
    let (cut, run) = (saw.cut, saw.run);
    let reduced = basis(saw, modes);
    let blade = StretchedBlade::of_shapes(saw.plate, reduced.basis().to_owned())?;
    let shapes = blade.shapes();
    let load = Scale(run.lateral_n)
        * (shapes.transpose() * lateral_load(saw.plate, &cut.teeth.standing()));
    let none = Col::zeros(load.nrows());
    let [idle, cutting] = [saw.plate, &saw.cutting].map(|plate| reduced_system(plate, &blade));
    let mut samples = Samples::new(&blade, &saw.plate.blade, probe, run.speed_rad_per_s);
    let sample_s = SAMPLE_S.max((2.0 * cut.idle_s + run.duration_s) / MAX_SAMPLES);
    let mut state = State::rest(load.nrows());
    let mut start_s = 0.0;
    for (system, growth, duration_s, load) in [
        (&idle, growths[0], cut.idle_s, &none),
        (&cutting, growths[1], run.duration_s, &load),
        (&idle, growths[0], cut.idle_s, &none),
    ] {
        let phase = Phase {
            system,
            load,
            longest_s: longest_s(system, run.speed_rad_per_s, growth)?.min(sample_s),
            span_s: (start_s, duration_s),
        };
        if !samples.through(&phase, &mut state, sample_s)? {
            break;
        }
        start_s += duration_s;
    }
    Ok(StretchedCut {
        record: samples.record,
        found: samples.found,
    })
}

/// Modes of the saw with and without the forces at its speed, and the deflections under the load.
fn basis(saw: &SawInCut<'_>, modes: usize) -> ReducedBlade {
    let systems = [&saw.idle_system, &saw.cutting_system];
    let snapshots = systems.map(|system| Snapshot {
        system,
        speed_rad_per_s: saw.run.speed_rad_per_s,
    });
    let load = lateral_load(saw.plate, &saw.cut.teeth.standing());
    ReducedBlade::new(saw.plate, &snapshots, modes, &[load])
}

/// Length of a step that resolves the modes in the basis, which are fewer than its shapes, and their growth.
fn longest_s(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    growth: Growth,
) -> Result<f64, TransientError> {
    let highest = fastest_mode_rad_per_s(system, speed_rad_per_s, MODES)?.max(f64::MIN_POSITIVE);
    Ok((TAU / (STEPS_A_PERIOD * highest)).min(longest_step_s(growth)))
}

/// A time interval with constant system and load.
struct Phase<'a> {
    system: &'a GyroscopicSystem,
    load: &'a Col<f64>,
    longest_s: f64,
    /// Start and duration of the interval.
    span_s: (f64, f64),
}

/// The record of the probe.
struct Samples<'a> {
    blade: &'a StretchedBlade,
    probe: StretchedProbe,
    speed_rad_per_s: f64,
    record: Record,
    /// Largest deflection of the rim since the last sample.
    largest_m: f64,
    looked_s: f64,
    found: CutStretching,
}

impl<'a> Samples<'a> {
    fn new(blade: &'a StretchedBlade, outline: &Blade, probe: Point, speed_rad_per_s: f64) -> Self {
        Samples {
            blade,
            probe: StretchedProbe::new(blade, outline, probe),
            speed_rad_per_s,
            record: Record {
                time_s: vec![0.0],
                deflection_m: vec![0.0],
                largest_m: vec![0.0],
                linear_until_s: None,
            },
            largest_m: 0.0,
            looked_s: 0.0,
            found: CutStretching {
                shapes: blade.shapes().ncols(),
                step_s: 0.0,
                largest_slope: 0.0,
                valid_until_s: None,
            },
        }
    }

    /// Integrates a phase; returns false if slopes become too large.
    fn through(
        &mut self,
        phase: &Phase<'_>,
        state: &mut State,
        sample_s: f64,
    ) -> Result<bool, TransientError> {
        let (start_s, duration_s) = phase.span_s;
        let count = (duration_s / phase.longest_s).ceil() as usize;
        if count == 0 {
            return Ok(true);
        }
        let step_s = duration_s / count as f64;
        self.found.step_s = self.found.step_s.max(step_s);
        let stride = ((sample_s / step_s) as usize).max(1);
        let forces = forces(self.blade);
        let loads = [phase.load.clone()];
        let newmark = Newmark::new(phase.system, (self.speed_rad_per_s, 0.0), &loads, step_s)
            .with_forces(&forces);
        let stop = Cancellation::current();
        for step in 1..=count {
            // A flat saw without a force remains flat, even if it is unstable.
            if phase.load.norm_max() > 0.0 || state.displacement.norm_max() > 0.0 {
                let next = newmark.step(state, [&[1.0], &[1.0]])?;
                let read = self.probe.read([state, &next], step_s);
                self.largest_m = self.largest_m.max(read.largest_m);
                *state = next;
            }
            if step % stride == 0 || step == count {
                stop.check()?;
                if !self.take(state, start_s + step as f64 * step_s) {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// Adds a sample; returns false if slopes are too large.
    fn take(&mut self, state: &State, time_s: f64) -> bool {
        if time_s >= self.looked_s + LOOK_S {
            self.looked_s = time_s;
            let holds = self.probe.holds(state);
            self.found.largest_slope = self.probe.largest_slope;
            if !holds {
                self.found.valid_until_s = Some(time_s);
                return false;
            }
        }
        let read = Deflections {
            at_probe_m: self.probe.at_probe_m(state),
            largest_m: std::mem::take(&mut self.largest_m),
        };
        self.record.push(time_s, read);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::cut::history::cut_history;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Cut, CutRun, Scene, rad_per_s};

    fn plate() -> Plate {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        Plate::new(&Scene::paper(), resolution)
    }

    /// The paper's cut at its first speed, with or without stretching.
    fn cut(stretching: bool) -> Cut {
        let scene = Scene::paper().edited(|saw| {
            if let Some(cut) = &mut saw.cut {
                cut.stretching = stretching;
                cut.idle_s = 0.2;
            }
        });
        scene.unwrap().cut().unwrap().clone()
    }

    fn largest(record: &[f64]) -> f64 {
        record.iter().fold(0.0, |max, w| max.max(w.abs()))
    }

    /// Small deflections equal those of the linear model, computed by another integrator with more shapes; at
    /// 2800 rpm they grow.
    #[test]
    fn a_small_force_moves_the_blade_as_the_linear_model_says() {
        let plate = plate();
        for rpm in [1800.0, 2800.0] {
            let records = [false, true].map(|stretching| {
                let cut = cut(stretching);
                let run = CutRun {
                    lateral_n: 1e-6,
                    duration_s: 0.6,
                    ..cut.at_rpm(rpm).unwrap()
                };
                let saw = SawInCut::new(&plate, &cut, &run).unwrap();
                cut_history(&saw, Scene::paper().probe(), 0.85).unwrap()
            });
            let [linear, stretched] = records.each_ref().map(|r| largest(&r.record.deflection_m));
            assert!(linear > 1e-10);
            let error = stretched / linear - 1.0;
            println!("{rpm}: {linear:e} {error:e}");
            assert!(error.abs() < 0.02, "{rpm}: {linear:e} {stretched:e}");
            assert_eq!(records[1].valid_until_s(), None);
        }
    }

    /// ½ q̇ᵀq̇ + ½ qᵀKq + U₄ − fᵀq of a blade without damping is conserved under the forces of the cut; K includes
    /// the in-plane forces.
    #[test]
    fn the_energy_of_an_undamped_blade_in_the_cut_is_kept() {
        let plate = plate().conservative();
        let cut = cut(true);
        let run = cut.at_rpm(1800.0).unwrap();
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        let reduced = basis(&saw, MODES);
        let blade = StretchedBlade::of_shapes(&plate, reduced.basis().to_owned()).unwrap();
        let load =
            Scale(run.lateral_n) * reduced.vector(&lateral_load(&plate, &cut.teeth.standing()));
        let system = reduced.system(&saw.cutting_system);
        let speed = run.speed_rad_per_s;
        let probe = Point {
            radius_m: 0.4,
            angle_deg: 0.0,
        };
        let mut samples = Samples::new(&blade, &plate.blade, probe, speed);
        let phase = Phase {
            system: &system,
            load: &load,
            longest_s: 1e-3,
            span_s: (0.0, 1.0),
        };
        let mut state = State::rest(reduced.order());
        assert!(samples.through(&phase, &mut state, 1e-3).unwrap());
        let (q, v) = (&state.displacement, &state.velocity);
        let linear = q.transpose() * system.stiffness_at(speed) * q;
        let stored = blade.stretching().energy_j(q).unwrap();
        let energy = 0.5 * (v.transpose() * v + linear) + stored - load.transpose() * q;
        // The energy is zero at rest, where the motion starts.
        let moving = 0.5 * (v.transpose() * v);
        assert!(stored > 1e-3 * moving, "{stored:e} {moving:e}");
        assert!(energy.abs() < 1e-8 * moving, "{energy:e} {moving:e}");
    }

    /// In a flutter band, under a small lateral force without in-plane forces, the amplitude rises to the value of
    /// the normal form of two waves and no further.
    #[test]
    fn flutter_in_the_cut_rises_to_its_saturated_amplitude() {
        let plate = plate().conservative();
        let cut = cut(true);
        let speed = rad_per_s(2264.0);
        let near = StretchedBlade::at_speed(&plate, speed, 6).unwrap();
        let predicted = near.saturation(speed).unwrap().unwrap();
        let run = CutRun {
            rpm: 2264.0,
            speed_rad_per_s: speed,
            tangential_n: 0.0,
            radial_n: 0.0,
            lateral_n: 1e-3,
            duration_s: 14.0 / predicted.growth_per_s,
            ..cut.at_rpm(1800.0).unwrap()
        };
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        let probe = Point {
            radius_m: predicted.radius_m,
            angle_deg: predicted.angle_rad.to_degrees(),
        };
        let growth = Growth {
            growth_per_s: predicted.growth_per_s,
            frequency_rad_per_s: predicted.frequency_rad_per_s,
            diverges: false,
        };
        let StretchedCut { record, found } = stretched_cut(&saw, probe, [growth; 2]).unwrap();
        let seen = largest(&record.deflection_m);
        let error = predicted.amplitude_m / seen - 1.0;
        println!("{predicted:?} {seen} {error} {found:?}");
        assert!(error.abs() < 0.05, "{predicted:?} {seen}");
    }

    /// More modes change the largest deflection of the paper's cut by little.
    #[test]
    fn the_modes_are_enough() {
        let plate = plate();
        let cut = cut(true);
        let run = cut.at_rpm(1800.0).unwrap();
        let saw = SawInCut::new(&plate, &cut, &run).unwrap();
        let none = Growth {
            growth_per_s: 0.0,
            frequency_rad_per_s: 0.0,
            diverges: false,
        };
        let seen = [8, 12].map(|modes| {
            let cut = with_modes(&saw, Scene::paper().probe(), [none; 2], modes).unwrap();
            let record = cut.record;
            let upto = record.time_s.iter().take_while(|t| **t < 0.8).count();
            largest(&record.deflection_m[..upto])
        });
        println!("{seen:?}");
        assert!((seen[1] / seen[0] - 1.0).abs() < 0.03, "{seen:?}");
    }
}
