//! Tooth loads that move with the teeth, in contrast to stationary loads.
//!
//! The teeth in the cut move with their forces, enter the cut at one end of its arc and leave it at the other. After a tooth
//! period T = pitch/Ω each is at the place of the preceding one. The stiffness K_e changes with their places and their
//! number, and the transition over the period is the product of the steps: a saw is stable if no Floquet multiplier μ of
//! this product exceeds one in magnitude, and ln|μ|/T is its growth rate. A tooth that enters or leaves within a step acts
//! with its mean force over the step, so that the mean over all steps is that of the loads for any number of steps.

use std::f64::consts::TAU;

use faer::{Mat, Scale};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::linalg::real_eigenvalues;
use crate::model::plate::RimForce;
use crate::model::scene::{Point, Tooth, rad_per_s};
use crate::model::system::GyroscopicSystem;
use crate::modes::{Growing, SpectrumError};
use crate::motion::transient::{
    Gauge, Integrator, Propagator, ReducedBlade, State, TransientError, lateral_load,
};

use super::record::Growth;
use super::saw::SawInCut;

/// The effect of loads that move with the teeth, compared with stationary loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ToothPassingEntry")]
pub struct ToothPassing {
    /// Number of teeth that pass per second.
    pub tooth_frequency_hz: f64,
    /// Growth under stationary loads at the mean places of the teeth.
    pub standing_growth_per_s: f64,
    /// Growth under the mean of the moving loads.
    pub mean_growth_per_s: f64,
    /// Growth under the moving loads, from Floquet multipliers.
    pub passing_growth_per_s: f64,
    /// Largest deflection of the rim in the cut under stationary loads; null if the linear model ends
    /// before the cut.
    pub standing_deflection_m: Option<f64>,
    /// Largest deflection of the rim in the cut under moving loads.
    pub passing_deflection_m: Option<f64>,
}

/// Multiple of the tooth passing frequency up to which shapes are in the basis. Moving loads couple two modes
/// whose frequencies add up to that of the teeth or differ by it. With fewer shapes the highest frequencies would
/// be wrong and could cause false resonances at any speed. On the saw with two pads (410 functions, 1800 rpm) the
/// growth is 0.25 1/s for multiples of 1.5, 2, 3 and 4.
const SHAPES_UP_TO: f64 = 2.0;

/// Stationary, mean and moving loads compared.
pub(super) struct LoadsCompared {
    pub found: ToothPassing,
    /// Growth under moving loads, which diverges if a motion does under their mean: a multiplier does not show this,
    /// because it leaves multiples of the tooth frequency open.
    pub moving: Growth,
}

/// Compares the loads, with `stages` steps within a tooth period and constant forces in each.
///
/// # Errors
/// [`TransientError`].
pub(super) fn tooth_passing(
    saw: &SawInCut<'_>,
    probe: Point,
    stages: usize,
) -> Result<LoadsCompared, TransientError> {
    let speed = saw.run.speed_rad_per_s;
    let period_s = saw.cut.teeth.pitch_rad() / speed;
    let tooth_frequency_rad_per_s = std::f64::consts::TAU / period_s;
    let highest = SHAPES_UP_TO * tooth_frequency_rad_per_s;
    let blade = saw.blade.with_shapes_below(&saw.cutting_system, highest)?;
    let loads = MovingLoads::new(saw, &blade, stages);
    let growth = |teeth: &[Tooth]| -> Result<Growth, TransientError> {
        Ok(Growing::at(&loads.system(teeth), speed)?.into())
    };
    let standing = saw.cut.teeth.standing();
    let mean = growth(&loads.mean())?;
    let few = MovingLoads::new(saw, &saw.blade, stages);
    let gauge = Gauge::new(saw.plate, &saw.blade, probe);
    let found = ToothPassing {
        tooth_frequency_hz: tooth_frequency_rad_per_s / TAU,
        standing_growth_per_s: growth(&standing)?.growth_per_s,
        mean_growth_per_s: mean.growth_per_s,
        passing_growth_per_s: loads.floquet_growth()?,
        standing_deflection_m: few.largest_deflection(&[few.propagator(&standing)?], &gauge)?,
        passing_deflection_m: few.largest_deflection(&few.propagators()?, &gauge)?,
    };
    let moving = Growth {
        growth_per_s: found.passing_growth_per_s,
        frequency_rad_per_s: 0.0,
        diverges: mean.diverges,
    };
    Ok(LoadsCompared { found, moving })
}

/// The loads in the steps within a tooth period, in a reduced basis.
struct MovingLoads<'a> {
    saw: &'a SawInCut<'a>,
    blade: &'a ReducedBlade,
    idle: GyroscopicSystem,
    /// The teeth in each step.
    steps: Vec<Vec<Tooth>>,
}

impl<'a> MovingLoads<'a> {
    fn new(saw: &'a SawInCut<'a>, blade: &'a ReducedBlade, stages: usize) -> Self {
        let share = |stage: usize| stage as f64 / stages as f64;
        MovingLoads {
            saw,
            blade,
            idle: saw.idle_on(blade),
            steps: (0..stages)
                .map(|stage| saw.cut.teeth.passing([stage, stage + 1].map(share)))
                .collect(),
        }
    }

    fn step_s(&self) -> f64 {
        let pitch_s = self.saw.cut.teeth.pitch_rad() / self.saw.run.speed_rad_per_s;
        pitch_s / self.steps.len() as f64
    }

    /// The teeth of all steps, each for its share of the tooth period.
    fn mean(&self) -> Vec<Tooth> {
        let of_period = |tooth: &Tooth| Tooth {
            share: tooth.share / self.steps.len() as f64,
            ..*tooth
        };
        self.steps.iter().flatten().map(of_period).collect()
    }

    /// The saw under the forces of some teeth.
    fn system(&self, teeth: &[Tooth]) -> GyroscopicSystem {
        let loads = RimForce::of_teeth(teeth, self.saw.run);
        let edge = self.saw.plate.edge_stiffness_of(&loads);
        let mut system = self.idle.clone();
        system.stiffness += self.blade.matrix(&edge);
        system
    }

    fn propagator(&self, teeth: &[Tooth]) -> Result<Propagator, TransientError> {
        let load = self.blade.vector(&lateral_load(self.saw.plate, teeth));
        let speed = self.saw.run.speed_rad_per_s;
        Propagator::new(&self.system(teeth), speed, &[load], self.step_s())
    }

    fn propagators(&self) -> Result<Vec<Propagator>, TransientError> {
        let steps = self.steps.par_iter();
        steps.map(|teeth| self.propagator(teeth)).collect()
    }

    /// max ln|μ| / T over the multipliers of the product of the stages; zero if nothing grows beyond rounding
    /// in an undamped saw.
    fn floquet_growth(&self) -> Result<f64, TransientError> {
        let stages = self.propagators()?;
        let logarithm = largest_multiplier_ln(&stages, self.saw.run.rpm, self.step_s())?;
        if self.idle.is_conservative() && logarithm <= MULTIPLIER_NOISE {
            return Ok(0.0);
        }
        Ok(logarithm / (self.step_s() * stages.len() as f64))
    }

    /// Largest deflection of the rim in m while the cut lasts; `None` if it is beyond the linear model.
    fn largest_deflection(
        &self,
        stages: &[Propagator],
        gauge: &Gauge,
    ) -> Result<Option<f64>, TransientError> {
        let run = self.saw.run;
        let mut state = State::rest(self.blade.order());
        let force = [run.lateral_n];
        let steps = (run.duration_s / self.step_s()).ceil() as usize;
        let mut largest = 0.0_f64;
        for step in 0..steps {
            let next = stages[step % stages.len()].step(&state, [&force, &force])?;
            let time_s = (step + 1) as f64 * self.step_s();
            let read = gauge.read([&state, &next], self.step_s(), (run.rpm, time_s))?;
            if gauge.beyond(read.largest_m) {
                return Ok(None);
            }
            largest = largest.max(read.largest_m);
            state = next;
        }
        Ok(Some(largest))
    }
}

/// Largest ln|μ| that is rounding: the accuracy of a product of some transitions and of its eigenvalues.
const MULTIPLIER_NOISE: f64 = 1e-11;

/// ln max|μ| over the eigenvalues μ of the product of the stages. The product is scaled by powers of two,
/// which are counted separately, because violent growth within one tooth period would overflow.
fn largest_multiplier_ln(
    stages: &[Propagator],
    rpm: f64,
    step_s: f64,
) -> Result<f64, TransientError> {
    let not_finite = TransientError::NotFinite { rpm, step_s };
    let Some((first, others)) = stages.split_first() else {
        return Err(not_finite);
    };
    let mut product = first.transition().clone();
    let mut doublings = 0.0;
    for stage in others {
        product = rescaled(stage, first.scale_per_s()) * product;
        let size = product.norm_max();
        if !(size > 0.0 && size.is_finite()) {
            return Err(not_finite);
        }
        let power = size.log2().floor();
        product *= Scale((-power).exp2());
        doublings += power;
    }
    let multipliers =
        real_eigenvalues(product.as_ref()).map_err(SpectrumError::at(rad_per_s(rpm)))?;
    let largest = multipliers.iter().fold(0.0_f64, |max, z| max.max(z.norm()));
    let logarithm = largest.ln() + doublings * std::f64::consts::LN_2;
    if logarithm.is_finite() {
        Ok(logarithm)
    } else {
        Err(not_finite)
    }
}

/// Transition of x = (q, q̇/s) with another time scale s. The stiffness of the stages differs slightly, so that
/// their scales may differ by a factor of two.
fn rescaled(propagator: &Propagator, scale_per_s: f64) -> Mat<f64> {
    let mut transition = propagator.transition().clone();
    let factor = propagator.scale_per_s() / scale_per_s;
    let order = transition.nrows() / 2;
    for i in 0..order {
        for k in 0..order {
            transition[(order + i, k)] *= factor;
            transition[(i, order + k)] /= factor;
        }
    }
    transition
}

#[cfg(test)]
#[path = "tooth_passing_tests.rs"]
mod tests;
