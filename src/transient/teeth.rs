//! Teeth that pass, instead of loads that stand still.
//!
//! The teeth in the cut carry their forces along for one pitch; then the next one takes
//! over. Within a tooth period T = pitch/Ω the stiffness K_e turns with them, and what is
//! left at its end is the product of the steps: a saw is stable when no Floquet multiplier
//! μ of that product exceeds one, and ln|μ|/T is its growth rate.

use faer::{Col, Mat, Scale, c64};

use crate::scene::{CutRun, Probe};
use crate::spectrum::fastest_growing;

use super::cut::finite;
use super::reduced::at_point;
use super::saw_in_cut::{SawInCut, lateral_load};
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
    saw: &SawInCut<'_>,
    probe: &Probe,
    stages: usize,
) -> Result<ToothPassing, TransientError> {
    let (plate, run, blade) = (saw.plate, saw.run, &saw.blade);
    let speed = run.speed_rad_per_s;
    let period_s = saw.cut.pitch_rad / speed;
    let step_s = period_s / stages as f64;
    let idle = saw.idle_on(blade);
    let with = |edge: &Mat<f64>| {
        let mut system = idle.clone();
        system.stiffness += edge;
        system
    };
    // Loads turned by α on a blade are loads on a blade turned by −α.
    let edge_at = |turn: f64| blade.turned(plate, -turn).matrix(&saw.edge_stiffness);
    let propagator = |edge: &Mat<f64>, turn: f64| {
        let load = blade.vector(&lateral_load(plate, saw.cut, turn));
        Propagator::new(&with(edge), speed, &[load], step_s)
    };
    let turns: Vec<f64> = (0..stages)
        .map(|stage| ((stage as f64 + 0.5) / stages as f64 - 0.5) * saw.cut.pitch_rad)
        .collect();
    let edges: Vec<Mat<f64>> = turns.iter().map(|turn| edge_at(*turn)).collect();
    let mut mean = Mat::zeros(blade.order(), blade.order());
    for edge in &edges {
        mean += Scale(1.0 / stages as f64) * edge;
    }
    let middle = edge_at(0.0);
    let standing = [propagator(&middle, 0.0)?];
    let passing = edges
        .iter()
        .zip(&turns)
        .map(|(edge, turn)| propagator(edge, *turn))
        .collect::<Result<Vec<_>, _>>()?;
    let growth = |edge: &Mat<f64>| -> Result<f64, TransientError> {
        let fastest = fastest_growing(&with(edge), speed)?;
        Ok(fastest.map_or(0.0, |lambda| lambda.re))
    };
    let read = blade.vector(&at_point(plate, probe.radius_m, probe.angle_rad));
    let largest = |stages: &[Propagator]| largest_deflection(stages, run, &read, step_s);
    Ok(ToothPassing {
        tooth_frequency_rad_per_s: std::f64::consts::TAU / period_s,
        standing_growth_per_s: growth(&middle)?,
        mean_growth_per_s: growth(&mean)?,
        passing_growth_per_s: floquet_growth(&passing, period_s),
        standing_deflection_m: largest(&standing)?,
        passing_deflection_m: largest(&passing)?,
    })
}

/// max ln|μ| / T over the multipliers of the product of the stages; zero when it is no
/// more than rounding.
fn floquet_growth(stages: &[Propagator], period_s: f64) -> f64 {
    let Some((first, others)) = stages.split_first() else {
        return 0.0;
    };
    let mut product = first.transition();
    for stage in others {
        product = rescaled(stage, first.scale_per_s()) * product;
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
    stages: &[Propagator],
    run: &CutRun,
    read: &Col<f64>,
    step_s: f64,
) -> Result<f64, TransientError> {
    let mut state = State::rest(read.nrows());
    let force = [run.lateral_n];
    let steps = (run.duration_s / step_s).ceil() as usize;
    let mut largest = 0.0_f64;
    for step in 0..steps {
        state = stages[step % stages.len()].step(&state, &force, &force);
        let time_s = (step + 1) as f64 * step_s;
        let deflection = finite(state.read(read), run.speed_rad_per_s, time_s)?;
        largest = largest.max(deflection.abs());
    }
    Ok(largest)
}
