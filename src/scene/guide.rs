//! Validated guide pads, angles in radians.

use super::check::{MAX_GUIDE, SPAN, positive, refuse, within};
use super::{Blade, GuideFile, SceneError};
use crate::text::shown;

/// Validated guide pad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Guide {
    /// Distance of the centre from the axis.
    pub radius_m: f64,
    /// Angle of the centre.
    pub angle_rad: f64,
    /// Length along the radius; zero for a point spring.
    pub radial_length_m: f64,
    /// Length across the radius; zero for a point spring.
    pub tangential_length_m: f64,
    /// Stiffness of the whole pad.
    pub stiffness_n_per_m: f64,
    /// Damping of the whole pad.
    pub damping_n_s_per_m: f64,
}

impl Guide {
    /// Whether the pad has no extent and acts at a point.
    pub fn is_point(&self) -> bool {
        self.radial_length_m == 0.0
    }

    /// Smallest and largest distance of the pad from the axis.
    fn reach_m(&self) -> (f64, f64) {
        let half = [0.5 * self.radial_length_m, 0.5 * self.tangential_length_m];
        let nearest = (self.radius_m - half[0]).max(0.0);
        (nearest, (self.radius_m + half[0]).hypot(half[1]))
    }
}

/// Validates a pad; `key` is its JSON path.
pub fn guide(key: &str, typed: &GuideFile, blade: &Blade) -> Result<Guide, SceneError> {
    let of = |name: &str| format!("{key}.{name}");
    let size = (0.0, SPAN.1);
    let pad = Guide {
        radius_m: within(&of("radius_m"), typed.radius_m, size)?,
        angle_rad: within(&of("angle_deg"), typed.angle_deg, (-3600.0, 3600.0))?.to_radians(),
        radial_length_m: within(&of("radial_length_m"), typed.radial_length_m, size)?,
        tangential_length_m: within(&of("tangential_length_m"), typed.tangential_length_m, size)?,
        stiffness_n_per_m: within(
            &of("stiffness_n_per_m"),
            typed.stiffness_n_per_m,
            (0.0, MAX_GUIDE),
        )?,
        damping_n_s_per_m: within(
            &of("damping_n_s_per_m"),
            typed.damping_n_s_per_m,
            (0.0, MAX_GUIDE),
        )?,
    };
    if let Some(gap_m) = typed.gap_m {
        positive(&of("gap_m"), gap_m)?;
    }
    if (pad.radial_length_m == 0.0) != (pad.tangential_length_m == 0.0) {
        return Err(refuse(
            &of("tangential_length_m"),
            pad.tangential_length_m,
            "zero exactly when radial_length_m is",
            "give both sides of the pad, or zero for both to make it a point spring",
        ));
    }
    let (nearest_m, farthest_m) = pad.reach_m();
    let touches = if pad.is_point() {
        (blade.inner_radius_m..=blade.outer_radius_m).contains(&pad.radius_m)
    } else {
        nearest_m < blade.outer_radius_m && farthest_m > blade.inner_radius_m
    };
    if !touches {
        let allowed = format!(
            "such that the pad lies on the blade, which reaches from r = {} to {} m",
            shown(blade.inner_radius_m),
            shown(blade.outer_radius_m)
        );
        let remedy = "this pad is wholly off the blade; move it, or leave it out";
        return Err(refuse(&of("radius_m"), pad.radius_m, allowed, remedy));
    }
    Ok(pad)
}
