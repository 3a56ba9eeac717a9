//! Speed and limit of the deflection, and the scenes that are answered.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::scene::{Blade, Bore, Guide, RefusedValue, Scene, speed_rad_per_s};
use crate::motion::steady::Oscillators;
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::page::text::shown_to;
use crate::stability::check_speed;

/// Evaluates guides with a gap: the chart over the amplitude at them, and the deflection at the cut over the gap.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Gap of every guide, one-sided, in place of the contact of the guides of the scene.
    pub gap_m: Option<f64>,
    /// Speed of the map over gap and force; by default the operating speed, or half of the first critical speed.
    pub rpm: Option<f64>,
}

impl Options {
    /// Refuses invalid numbers, and a scene without a one-sided guide.
    ///
    /// # Errors
    /// [`RefusedValue`].
    pub fn checked(&self, scene: &Scene) -> Result<(), RefusedValue> {
        self.checked_still(scene)?;
        Oscillators::of(scene).map_or(Ok(()), Oscillators::checked)
    }

    /// As [`Options::checked`], for deflections without oscillation.
    pub(super) fn checked_still(&self, scene: &Scene) -> Result<(), RefusedValue> {
        if let Some(rpm) = self.rpm {
            speed_rad_per_s("rpm", rpm)?;
            check_speed(scene.blade(), "rpm", rpm)?;
        } else if let Some(rpm) = scene.file().operating_rpm {
            check_speed(scene.blade(), "operating_rpm", rpm)?;
        }
        let force_n = scene.file().side_force_n();
        if force_n == 0.0 {
            let (key, allowed) = ("side_force.force_n", "other than 0");
            let remedy = "a side force presses the blade on its guides; give it, such as 5";
            return Err(RefusedValue::new(key, force_n, allowed, remedy));
        }
        let mut guides = scene.guides().iter();
        guides.try_for_each(|guide| check_reached(scene.blade(), guide))?;
        if scene.guides().iter().any(|guide| guide.lifting.is_some()) {
            Ok(())
        } else {
            Err(RefusedValue::missing(
                "guides[].contact",
                "\"one_sided\" for at least one guide",
                "a linear guide acts at any deflection; give contact as \"one_sided\" and gap_m, or give the command a gap to try",
            ))
        }
    }
}

/// Refuses a gap that a clamped blade does not cross at any deflection for which the model is valid: with slopes up to
/// [`LARGEST_SLOPE`] the deflection at a distance from the collar is at most this share of the distance. A blade on a
/// spline crosses any gap, because it moves along its arbor.
fn check_reached(blade: &Blade, guide: &Guide) -> Result<(), RefusedValue> {
    let (Some(lifting), Bore::Clamped(_)) = (guide.lifting, blade.bore) else {
        return Ok(());
    };
    let [_, farthest_m] = guide.typed.reach_m();
    let free_m = farthest_m.min(blade.outer_radius_m) - blade.inner_radius_m;
    let most_m = LARGEST_SLOPE * free_m + lifting.offset_m.abs();
    if lifting.gap_m <= most_m {
        Ok(())
    } else {
        Err(RefusedValue::new(
            format!("guides[{}].gap_m", guide.index),
            lifting.gap_m,
            format!(
                "at most {} m, as far as a blade between collars deflects with slopes up to {LARGEST_SLOPE}, to which the model is valid",
                shown_to(3, most_m)
            ),
            "give the gap in metres, such as 5e-5, or leave this pad out",
        ))
    }
}
