//! The side force, and the range of speeds.

use crate::plate::Plate;
use crate::scene::{RefusedValue, Scene, quantity, speed_rad_per_s, typical_value};
use crate::stretched::{LARGEST_SLOPE, StretchedBlade, StretchedError};
use crate::text::{rounded_down, shown_to};

/// Options of the computation of equilibria.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Options {
    /// Lateral force at the rim, fixed in space; by default that of the scene's run-up, or 1 N.
    pub force_n: Option<f64>,
    /// Angle of the force; by default that of the scene's run-up, or 0.
    pub angle_deg: Option<f64>,
    /// Last speed; by default the end of the scene's sweep.
    pub to_rpm: Option<f64>,
}

/// A constant lateral force at the rim, fixed in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideForce {
    /// Force in the direction of positive deflections.
    pub force_n: f64,
    /// Angle, positive in the direction of rotation.
    pub angle_rad: f64,
}

/// Side force for a scene without a run-up.
const USUAL_FORCE_N: f64 = typical_value("response.force_n");

impl Options {
    /// Checks the options.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option.
    pub fn checked(&self, scene: &Scene) -> Result<(), RefusedValue> {
        self.side_force(scene).map(|_| ())
    }

    /// The validated force; checks the speed too.
    pub(crate) fn side_force(&self, scene: &Scene) -> Result<SideForce, RefusedValue> {
        if let Some(to_rpm) = self.to_rpm {
            speed_rad_per_s("to_rpm", to_rpm)?;
        }
        let runup = scene.file().runup.as_ref();
        let force_n = self.force_n.or(runup.map(|runup| runup.force_n));
        let force_n = force_n.unwrap_or(USUAL_FORCE_N);
        const { quantity("response.force_n") }.checked("force_n", force_n)?;
        let angle_deg = self.angle_deg.or(runup.map(|runup| runup.angle_deg));
        let angle_deg = angle_deg.unwrap_or(0.0);
        const { quantity("response.angle_deg") }.checked("angle_deg", angle_deg)?;
        Ok(SideForce {
            force_n,
            angle_rad: angle_deg.to_radians(),
        })
    }

    /// The refusal of a force that deflects the blade beyond the model at the first speed; a `gentle_n` does not.
    pub(super) fn steep(&self, scene: &Scene, force: &SideForce, gentle_n: f64) -> RefusedValue {
        let key = match (self.force_n, scene.file().runup.as_ref()) {
            (None, Some(_)) => "runup.force_n",
            _ => "force_n",
        };
        let most = shown_to(2, rounded_down(2, gentle_n.abs()));
        let allowed = format!(
            "between -{most} and {most} for this saw: a larger force deflects it to slopes above {LARGEST_SLOPE}, where the model ends"
        );
        let remedy = "give a smaller force";
        RefusedValue::new(key, force.force_n, allowed, remedy)
    }
}

impl SideForce {
    /// A blade under this force, on a reduced basis of `modes` modes at rest and the shapes needed for equilibria up to
    /// a speed.
    pub(super) fn on(
        &self,
        plate: &Plate,
        to_rad_per_s: f64,
        modes: usize,
    ) -> Result<StretchedBlade, StretchedError> {
        let place = (plate.blade.outer_radius_m, self.angle_rad);
        StretchedBlade::up_to(plate, to_rad_per_s, place, modes)?.pressed(self.force_n, place)
    }

    /// A blade under this force instead of its own.
    pub(super) fn presses(&self, blade: &StretchedBlade) -> Result<StretchedBlade, StretchedError> {
        let radius_m = blade.blade().outer_radius_m;
        let pressed = blade.clone();
        pressed.pressed(self.force_n, (radius_m, self.angle_rad))
    }
}
