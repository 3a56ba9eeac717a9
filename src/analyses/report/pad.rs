//! Forces of linear pads under a side force at the cut.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::check::point_load_plate;
use crate::analyses::deflect::PointLoad;
use crate::model::plate::pad_force;
use crate::model::scene::rpm;
use crate::stability::{Analysis, StabilityState};

/// A linear pad under the constant lateral force of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "LoadedPadEntry")]
pub struct LoadedPad {
    /// Index of the guide.
    pub guide: usize,
    /// Speed of the saw.
    pub rpm: f64,
    /// The lateral force.
    pub side_force_n: f64,
    /// Force of the blade on the pad: positive if the pad is pressed in the direction of the side force.
    pub force_n: f64,
}

impl LoadedPad {
    /// The linear pads of a saw at its operating speed, by the stationary deflection of the flat blade: force = stiffness × mean
    /// deflection over the pad, less that of its head. None unless the saw is stable there and something holds its rigid motions, and
    /// none for a saw with a pad that has a gap.
    pub(super) fn all(analysis: &Analysis) -> Vec<Self> {
        let scene = &analysis.scene;
        let Some(speed) = scene.operating_rad_per_s() else {
            return Vec::new();
        };
        // Where pads have a gap, contact shares the force among all of them, and not their stiffness.
        let lifts = scene.guides().iter().any(|guide| guide.lifting.is_some());
        if lifts || analysis.verdict(speed).state != StabilityState::Stable {
            return Vec::new();
        }
        let plate = point_load_plate(&analysis.scene, analysis.model.plate.resolution);
        let force = scene.constant_force();
        let load = PointLoad::on(&plate, &force.places);
        let Some(deflected) = load.and_then(|load| load.deflected(speed)) else {
            return Vec::new();
        };
        let side_force_n = force.force_n;
        let linear = scene
            .guides()
            .iter()
            .filter(|guide| guide.lifting.is_none() && guide.typed.stiffness_n_per_m > 0.0);
        let loaded = linear.map(|guide| LoadedPad {
            guide: guide.index,
            rpm: rpm(speed),
            side_force_n,
            force_n: side_force_n * (pad_force(&plate, guide).transpose() * &deflected),
        });
        loaded.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, GuideFile, Scene};

    /// Nothing but its pads holds a blade along its arbor, and a blade that does not rotate rigidly needs as many pads as it has
    /// rigid motions: their forces have the sum and the moments of the side force.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn pads_of_a_blade_on_a_spline_balance_the_side_force() {
        let saw = Scene::paper().edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            saw.operating_rpm = Some(300.0);
            let pad = saw.guides[0].clone();
            let at = |angle_deg: f64, radius_m: f64| GuideFile {
                angle_deg,
                radius_m,
                ..pad.clone()
            };
            saw.guides = vec![at(-60.0, 0.25), at(80.0, 0.2), at(200.0, 0.3)];
        });
        let saw = saw.unwrap();
        let pads = LoadedPad::all(&Analysis::new(&saw).unwrap());
        assert_eq!(pads.len(), 3);
        let sum: f64 = pads.iter().map(|pad| pad.force_n).sum();
        let side_force_n = saw.file().side_force_n();
        assert!((sum / side_force_n - 1.0).abs() < 1e-6, "{pads:?}");
    }
}
