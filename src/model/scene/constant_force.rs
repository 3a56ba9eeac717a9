//! The constant lateral force on the blade: as typed, that of the cut, or an assumed one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Polar, Scene, USUAL_SIDE_FORCE_N};

/// Where a constant lateral force comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "ForceCauseEntry")]
pub enum ForceCause {
    /// `side_force.force_n` of the scene.
    SideForce,
    /// The mean lateral force of the cut on all teeth in it, `cut.lateral_n_per_tooth` on each.
    Cut,
    /// The scene has neither: 1 N was assumed.
    Assumed,
}

/// A constant lateral force, fixed in space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ConstantForce {
    /// The whole force, in the direction of positive deflections.
    pub force_n: f64,
    /// Where it comes from.
    pub cause: ForceCause,
    /// Points on which it acts, each with its share of the whole.
    pub places: Vec<(Polar, f64)>,
}

impl Scene {
    /// The constant lateral force at a speed in rpm: the typed side force; without one the mean lateral force of the cut on the teeth
    /// in it; without either 1 N.
    pub(crate) fn constant_force_at(&self, rpm: f64) -> ConstantForce {
        self.constant_force_of(Some(rpm))
    }

    /// The force of [`Scene::constant_force_at`] at the speed of the cut.
    pub(crate) fn constant_force(&self) -> ConstantForce {
        self.constant_force_of(self.cutting_rpm())
    }

    fn constant_force_of(&self, rpm: Option<f64>) -> ConstantForce {
        let side = self.side_force();
        let at = |cause: ForceCause, force_n: f64| ConstantForce {
            force_n,
            cause,
            places: vec![(side.at.polar(), 1.0)],
        };
        let side_force = self.file().side_force;
        let typed = side_force
            .and_then(|typed| typed.force_n)
            .filter(|force_n| *force_n != 0.0);
        if let Some(force_n) = typed {
            return at(ForceCause::SideForce, force_n);
        }
        let run = self.cut().zip(rpm).map(|(cut, rpm)| (cut, cut.at_rpm(rpm)));
        match run {
            Some((cut, Ok(run))) if run.lateral_n != 0.0 => {
                let teeth = cut.teeth.standing().into_iter();
                let rim_m = self.blade().outer_radius_m;
                ConstantForce {
                    force_n: run.lateral_n * cut.teeth.mean,
                    cause: ForceCause::Cut,
                    places: teeth
                        .map(|tooth| {
                            let place = Polar::new(rim_m, tooth.angle_rad);
                            (place, tooth.share / cut.teeth.mean)
                        })
                        .collect(),
                }
            }
            _ => at(ForceCause::Assumed, USUAL_SIDE_FORCE_N),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::SideForceFile;

    /// A depth of 80 mm is 5/3 of the pitch of 36 teeth on a blade of 550 mm (48.0 mm): 2 N on each are 3.33 N. One tooth is in the
    /// middle for a third of the time, and two are half a pitch beside it for the rest.
    #[test]
    fn the_cut_presses_with_the_mean_number_of_its_teeth() {
        let with = |force_n: Option<f64>, lateral_n: Option<f64>| {
            let edited = Scene::paper().edited(|saw| {
                saw.side_force = force_n.map(SideForceFile::of);
                (saw.blade.outer_diameter_m, saw.blade.teeth) = (0.55, Some(36));
                saw.operating_rpm = Some(2400.0);
                saw.guides.clear();
                let cut = saw.cut.as_mut().unwrap();
                cut.speeds.clear();
                (cut.teeth_in_cut, cut.depth_m) = (None, Some(0.08));
                (cut.tangential_n_per_tooth, cut.lateral_n_per_tooth) = (Some(20.0), lateral_n);
            });
            edited.unwrap().constant_force()
        };
        let of_cut = with(None, Some(2.0));
        assert_eq!(of_cut.cause, ForceCause::Cut);
        let teeth = 0.08 / (std::f64::consts::PI * 0.55 / 36.0);
        assert!((of_cut.force_n - 2.0 * teeth).abs() < 1e-9);
        let whole: f64 = of_cut.places.iter().map(|(_, share)| share).sum();
        assert!((whole - 1.0).abs() < 1e-12, "{of_cut:?}");
        assert_eq!(of_cut.places.len(), 3);
        assert_eq!(with(None, None).cause, ForceCause::Assumed);
        let typed = with(Some(5.0), Some(2.0));
        assert_eq!((typed.cause, typed.force_n), (ForceCause::SideForce, 5.0));
    }
}
