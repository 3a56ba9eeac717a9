//! The cut with the simulated reaction of the spline teeth instead of the assumed one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::record::Growth;
use super::saw::MODES;
use crate::analyses::campbell::Verdict;
use crate::model::plate::{Plate, RimForce};
use crate::model::scene::{Cut, CutRun, Scene};
use crate::model::spline::{self, reaction_effect};
use crate::model::system::GyroscopicSystem;
use crate::motion::transient::{ReducedBlade, Snapshot, TransientError};

/// The cut with the reaction of the simulated spline teeth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SplineEntry")]
pub struct SplineOrbit {
    /// Verdict in the cut, by the eigenvalues with the simulated reaction.
    pub verdict: Verdict,
    /// Largest Re λ with this reaction.
    pub growth_per_s: f64,
    /// Frequency of the mode of this growth; null if none grows.
    pub frequency_hz: Option<f64>,
    /// ‖change of K_e‖ / ‖K_e‖ from the assumed to the simulated reaction, on the lowest
    /// modes of the idle saw.
    pub stiffness_change: f64,
    /// Mean force of the arbor on the blade, towards the cut and a quarter turn further.
    pub force_n: [f64; 2],
    /// Mean torque of the arbor on the blade.
    pub torque_n_m: f64,
    /// Gap between two flanks while the blade is centred.
    pub clearance_m: f64,
    /// Mean number of spline teeth in contact.
    pub teeth_in_contact: f64,
    /// Largest normal force on a spline tooth.
    pub peak_tooth_n: f64,
    /// Largest depth by which two flanks overlap.
    pub deepest_m: f64,
    /// Mean reaction plus load, relative to the load: the remaining imbalance of the average.
    pub imbalance: f64,
    /// Measure of how far the motion is from being settled.
    pub unsteadiness: f64,
    /// Index in the reported orbit above which the reaction was averaged.
    pub settled_from: usize,
    /// Times of the orbit.
    pub time_s: Vec<f64>,
    /// Position of the centre of the blade, towards the cut.
    pub x_m: Vec<f64>,
    /// Position of the centre of the blade, a quarter turn further in the direction of rotation.
    pub y_m: Vec<f64>,
}

/// Number of points of a reported orbit; the simulation has tens of thousands.
const ORBIT_POINTS: usize = 4000;

/// Simulates the spline in a cut; `None` unless the scene has the block `spline`.
///
/// # Errors
/// [`TransientError`].
pub(super) fn on_spline(
    scene: &Scene,
    plate: &Plate,
    cut: &Cut,
    run: &CutRun,
) -> Result<Option<SplineOrbit>, TransientError> {
    let Some(spline) = scene.spline() else {
        return Ok(None);
    };
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
    let (reaction, teeth) = (&motion.reaction, &motion.reaction.teeth);
    let stride = motion.orbit.len().div_ceil(ORBIT_POINTS).max(1);
    let orbit = || motion.orbit.iter().step_by(stride);
    Ok(Some(SplineOrbit {
        verdict: Verdict::of(scene, in_cut),
        growth_per_s: in_cut.growth_per_s,
        frequency_hz: in_cut.growing_hz(),
        stiffness_change,
        force_n: reaction.force_n,
        torque_n_m: reaction.torque_n_m,
        clearance_m: spline.clearance_m,
        teeth_in_contact: teeth.in_contact,
        peak_tooth_n: teeth.peak_n,
        deepest_m: teeth.deepest_m,
        imbalance: reaction.imbalance,
        unsteadiness: reaction.unsteadiness,
        settled_from: motion.settled_from.div_ceil(stride),
        time_s: orbit().map(|point| point.time_s).collect(),
        x_m: orbit().map(|point| point.x_m).collect(),
        y_m: orbit().map(|point| point.y_m).collect(),
    }))
}
