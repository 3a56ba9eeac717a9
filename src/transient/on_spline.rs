//! The cut with the simulated reaction of the spline teeth instead of the assumed one.

use crate::plate::{Plate, RimForce};
use crate::scene::{Cut, CutRun, Scene};
use crate::spline::{self, SplineRun, reaction_effect};
use crate::system::GyroscopicSystem;

use super::Growth;
use super::TransientError;
use super::reduced::{ReducedBlade, Snapshot};
use super::saw_in_cut::MODES;

/// Effect of the simulated reaction.
#[derive(Debug, Clone)]
pub struct OnSpline {
    /// Motion of the blade on its arbor, and its mean reaction.
    pub motion: SplineRun,
    /// ‖change of K_e‖ / ‖K_e‖ on the lowest modes of the idle saw.
    pub stiffness_change: f64,
    /// Eigenvalues in the cut with the simulated reaction.
    pub in_cut: Growth,
}

/// Simulates the spline in a cut; `None` unless the scene has the block `spline`.
///
/// # Errors
/// [`TransientError`].
pub fn on_spline(
    scene: &Scene,
    plate: &Plate,
    cut: &Cut,
    run: &CutRun,
) -> Result<Option<OnSpline>, TransientError> {
    if scene.spline().is_none() {
        return Ok(None);
    }
    let speed_rad_per_s = run.speed_rad_per_s;
    let loads = RimForce::of_teeth(&cut.teeth.standing(), run);
    let motion = spline::simulate(scene, &loads, speed_rad_per_s, &spline::Run::default())?;
    let effect = reaction_effect(plate, &loads, &motion.reaction);
    let system = GyroscopicSystem::of_plate(plate);
    let snapshot = Snapshot {
        system: &system,
        speed_rad_per_s,
    };
    let blade = ReducedBlade::new(plate, &[snapshot], MODES, &[]);
    let stiffness_change = effect.relative_change_on(blade.basis());
    let cutting = plate.with_edge_stiffness(effect.simulated);
    let in_cut = Growth::of_plate(&cutting, speed_rad_per_s)?;
    Ok(Some(OnSpline {
        motion,
        stiffness_change,
        in_cut,
    }))
}
