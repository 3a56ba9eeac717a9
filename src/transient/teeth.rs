//! Teeth that pass, instead of loads that stand still.
//!
//! The teeth in the cut carry their forces along for one pitch; then the next one takes
//! over. Within a tooth period T = pitch/Ω the stiffness K_e turns with them, and what is
//! left at its end is the product of the steps: a saw is stable when no Floquet multiplier
//! μ of that product exceeds one, and ln|μ|/T is its growth rate.

use faer::{Col, Mat, Scale, c64};

use crate::plate::Plate;
use crate::scene::{Cut, CutRun, Probe};
use crate::spectrum::fastest_growing;
use crate::system::GyroscopicSystem;

use super::cut::{finite, in_cut_plate, lateral_load};
use super::reduced::{MODES, ReducedBlade, Snapshot, at_point};
use super::{Propagator, State, TransientError};

/// What the passing of the teeth changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothPassing {
    /// Teeth passing a second, teeth · Ω / 2π.
    pub tooth_frequency_rad_per_s: f64,
    /// Growth with loads that stand still, one pitch apart.
    pub standing_growth_per_s: f64,
    /// Growth with the mean of the passing loads.
    pub mean_growth_per_s: f64,
    /// Growth with the passing loads, from Floquet multipliers.
    pub passing_growth_per_s: f64,
    /// Largest deflection at the probe in the cut, standing loads.
    pub standing_deflection_m: f64,
    /// The same under passing ones.
    pub passing_deflection_m: f64,
}

/// Compares standing, mean and passing loads; `stages` positions of the teeth within a
/// pitch, the force constant within each.
///
/// # Errors
/// [`TransientError`].
pub fn tooth_passing(
    plate: &Plate,
    cut: &Cut,
    run: &CutRun,
    probe: &Probe,
    stages: usize,
) -> Result<ToothPassing, TransientError> {
    let speed = run.speed_rad_per_s;
    let cutting = in_cut_plate(plate, cut, run);
    let load = lateral_load(plate, cut, 0.0);
    let systems = [plate, &cutting].map(GyroscopicSystem::of_plate);
    let snapshots = systems.each_ref().map(|system| Snapshot {
        system,
        speed_rad_per_s: speed,
    });
    let blade = ReducedBlade::new(plate, &snapshots, MODES, &[load]);
    let no_edge = Mat::zeros(plate.degrees_of_freedom(), plate.degrees_of_freedom());
    let edge = cutting.edge_stiffness.as_ref().unwrap_or(&no_edge);
    // What nothing holds is what nothing holds in the cut.
    let mut idle = blade.system(&systems[1]);
    idle.stiffness -= blade.matrix(edge);
    let turns: Vec<f64> = (0..stages)
        .map(|stage| ((stage as f64 + 0.5) / stages as f64 - 0.5) * cut.pitch_rad)
        .collect();
    // Loads turned by α on a blade are loads on a blade turned by −α.
    let stiffness_at = |turn: f64| blade.turned(plate, -turn).matrix(edge);
    let with = |edge: &Mat<f64>| {
        let mut system = idle.clone();
        system.stiffness += edge;
        system
    };
    let turned: Vec<Mat<f64>> = turns.iter().map(|turn| stiffness_at(*turn)).collect();
    let mut mean = Mat::zeros(blade.order(), blade.order());
    for edge in &turned {
        mean += Scale(1.0 / stages as f64) * edge;
    }
    let period_s = cut.pitch_rad / speed;
    let step_s = period_s / stages as f64;
    let stage = |edge: &Mat<f64>, turn: f64| -> Result<Stage, TransientError> {
        let load = blade.vector(&lateral_load(plate, cut, turn));
        let propagator = Propagator::new(&with(edge), speed, &[load], step_s)?;
        Ok(Stage { propagator })
    };
    let standing = [stage(&stiffness_at(0.0), 0.0)?];
    let passing = turned
        .iter()
        .zip(&turns)
        .map(|(edge, turn)| stage(edge, *turn))
        .collect::<Result<Vec<_>, _>>()?;
    let growth = |edge: &Mat<f64>| -> Result<f64, TransientError> {
        let fastest = fastest_growing(&with(edge), speed)?;
        Ok(fastest.map_or(0.0, |lambda| lambda.re))
    };
    let steps = (run.duration_s / step_s).ceil() as usize;
    let read = blade.vector(&at_point(plate, probe.radius_m, probe.angle_rad));
    let largest = |stages: &[Stage]| largest_deflection(stages, steps, run, &read, step_s);
    Ok(ToothPassing {
        tooth_frequency_rad_per_s: std::f64::consts::TAU / period_s,
        standing_growth_per_s: growth(&stiffness_at(0.0))?,
        mean_growth_per_s: growth(&mean)?,
        passing_growth_per_s: floquet_growth(&passing, period_s),
        standing_deflection_m: largest(&standing)?,
        passing_deflection_m: largest(&passing)?,
    })
}

/// One position of the teeth.
struct Stage {
    propagator: Propagator,
}

/// max ln|μ| / T over the multipliers of the product of the stages; zero when it is no
/// more than rounding.
fn floquet_growth(stages: &[Stage], period_s: f64) -> f64 {
    let Some(first) = stages.first() else {
        return 0.0;
    };
    let scale = first.propagator.scale_per_s();
    let mut product = Mat::<f64>::identity(
        first.propagator.transition().nrows(),
        first.propagator.transition().ncols(),
    );
    for stage in stages {
        product = rescaled(&stage.propagator, scale) * product;
    }
    let multipliers: Vec<c64> = product.eigenvalues().unwrap_or_default();
    let largest = multipliers.iter().fold(0.0_f64, |max, z| max.max(z.norm()));
    let growth = largest.ln() / period_s;
    // Multipliers are known to some thousand roundings.
    if growth.is_finite() && largest - 1.0 > 1e-11 {
        growth
    } else {
        0.0
    }
}

/// The transition for x = (q, q̇/s) of another s: stages differ a little in stiffness, so
/// that their scales may differ by a factor two.
fn rescaled(propagator: &Propagator, scale_per_s: f64) -> Mat<f64> {
    let mut transition = propagator.transition();
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

fn largest_deflection(
    stages: &[Stage],
    steps: usize,
    run: &CutRun,
    read: &Col<f64>,
    step_s: f64,
) -> Result<f64, TransientError> {
    let mut state = State::rest(read.nrows());
    let force = [run.lateral_n];
    let mut largest = 0.0_f64;
    for step in 0..steps {
        let stage = &stages[step % stages.len()];
        state = stage.propagator.step(&state, &force, &force);
        let time_s = (step + 1) as f64 * step_s;
        let deflection = finite(state.read(read), run.speed_rad_per_s, time_s)?;
        largest = largest.max(deflection.abs());
    }
    Ok(largest)
}
