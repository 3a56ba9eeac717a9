//! Results of the spline in `cut.json`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::cut::{Verdict, growing_hz};
use crate::scene::Scene;
use crate::transient::OnSpline;

/// The cut with the reaction of the simulated spline teeth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplineEntry {
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
    /// Index in the reported orbit from which on the reaction was averaged.
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

impl SplineEntry {
    pub(super) fn new(scene: &Scene, found: &OnSpline) -> Self {
        let motion = &found.motion;
        let (reaction, teeth) = (&motion.reaction, &motion.reaction.teeth);
        let stride = motion.orbit.len().div_ceil(ORBIT_POINTS).max(1);
        let orbit = || motion.orbit.iter().step_by(stride);
        SplineEntry {
            verdict: Verdict::of(scene, found.in_cut),
            growth_per_s: found.in_cut.growth_per_s,
            frequency_hz: growing_hz(found.in_cut),
            stiffness_change: found.stiffness_change,
            force_n: reaction.force_n,
            torque_n_m: reaction.torque_n_m,
            clearance_m: scene.spline().map_or(0.0, |spline| spline.clearance_m),
            teeth_in_contact: teeth.in_contact,
            peak_tooth_n: teeth.peak_n,
            deepest_m: teeth.deepest_m,
            imbalance: reaction.imbalance,
            unsteadiness: reaction.unsteadiness,
            settled_from: motion.settled_from.div_ceil(stride),
            time_s: orbit().map(|point| point.time_s).collect(),
            x_m: orbit().map(|point| point.x_m).collect(),
            y_m: orbit().map(|point| point.y_m).collect(),
        }
    }
}
