//! Validated guide pads, angles in radians.

use super::rule::refuse;
use super::{
    Blade, ContactLaw, GuideFile, GuideShape, GuideSide, PadLaw, RefusedValue, SceneError,
};
use crate::page::text::shown;
use std::f64::consts::{PI, TAU};

/// Validated guide pad.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Guide {
    /// Index in the list of the scene.
    pub index: usize,
    /// The pad as typed.
    pub typed: GuideFile,
    /// Gap of a pad that lifts off; `None` for a linear pad.
    pub lifting: Option<Lifting>,
    /// The law of the film on each rigid motion of the pad, in place of its damper.
    pub film: Option<PadLaw>,
    /// The law of the controller on the mean deflection over the pad.
    pub controller: Option<PadLaw>,
}

impl Guide {
    /// The laws of film and controller, each with the rigid motion of the pad on which it acts: its heave, 0, or a tilt, 1 or 2.
    pub fn laws(&self) -> impl Iterator<Item = (usize, &PadLaw)> {
        let motions = if self.typed.is_point() { 1 } else { 3 };
        let film = self
            .film
            .iter()
            .flat_map(move |law| (0..motions).map(move |motion| (motion, law)));
        film.chain(self.controller.iter().map(|law| (0, law)))
    }
}

/// A pad that touches the blade only beyond a gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lifting {
    /// Gap on each side.
    pub gap_m: f64,
    /// Stiffness of the whole pad within the gap.
    pub film_stiffness_n_per_m: f64,
    /// Sides of the blade on which the pad is.
    pub side: GuideSide,
    /// Deflection at which the blade is in the middle between the faces of the pad.
    pub offset_m: f64,
}

impl Lifting {
    /// Whether a face presses on the blade where it is flat: the offset then exceeds the gap.
    pub fn presses_on_flat_blade(&self) -> bool {
        let beyond_left = self.gap_m + self.offset_m < 0.0;
        let beyond_right = self.gap_m - self.offset_m < 0.0;
        match self.side {
            GuideSide::Both => beyond_left || beyond_right,
            GuideSide::Left => beyond_left,
            GuideSide::Right => beyond_right,
        }
    }
}

/// Number of corners of the polygon that represents an ellipse. A circle of 100 mm deviates from it by 0.06 mm.
const ELLIPSE_CORNERS: u32 = 64;

impl GuideFile {
    /// Corners of the pad on the blade, or points of an ellipse, with x from the axis at θ = 0 and y at θ = 90°.
    pub fn outline_m(&self) -> Vec<[f64; 2]> {
        let (sin, cos) = self.angle_deg.to_radians().sin_cos();
        let half = [self.radial_length_m, self.tangential_length_m].map(|side| 0.5 * side);
        let unit_corners: Vec<(f64, f64)> = match self.shape {
            GuideShape::Rectangle => vec![(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
            GuideShape::Round => {
                let turns = (0..ELLIPSE_CORNERS).map(|k| f64::from(k) / f64::from(ELLIPSE_CORNERS));
                turns.map(|turn| (TAU * turn).sin_cos()).collect()
            }
        };
        let corners = unit_corners.iter().map(|(along, across)| {
            let (x, y) = (self.radius_m + along * half[0], across * half[1]);
            [x * cos - y * sin, x * sin + y * cos]
        });
        corners.collect()
    }

    /// Whether the pad has stiffness, damping or a controller.
    pub(super) fn acts(&self) -> bool {
        self.stiffness_n_per_m > 0.0 || self.damping_n_s_per_m > 0.0 || self.controller.is_some()
    }

    /// Angle of the centre.
    pub(crate) fn angle_rad(&self) -> f64 {
        self.angle_deg.to_radians()
    }

    /// Whether the pad has no extent and acts at a point.
    pub(crate) fn is_point(&self) -> bool {
        self.radial_length_m == 0.0
    }

    /// Half the lengths along and across the radius.
    pub(crate) fn half_lengths_m(&self) -> [f64; 2] {
        [0.5 * self.radial_length_m, 0.5 * self.tangential_length_m]
    }

    /// Area of the pad.
    pub(crate) fn area_m2(&self) -> f64 {
        let rectangle = self.radial_length_m * self.tangential_length_m;
        match self.shape {
            GuideShape::Rectangle => rectangle,
            GuideShape::Round => 0.25 * PI * rectangle,
        }
    }

    /// Radii of the circles about the axis that touch a side of the pad or pass through a corner. At these radii the
    /// arcs inside the pad are not smooth functions of the radius.
    pub(crate) fn touching_radii_m(&self) -> Vec<f64> {
        let [a, b] = self.half_lengths_m();
        let c = self.radius_m;
        let (near, far) = (c - a, c + a);
        let mut radii = vec![near.abs(), far.abs()];
        match self.shape {
            GuideShape::Rectangle => radii.extend([b, near.hypot(b), far.hypot(b)]),
            GuideShape::Round => {
                // The edge of the pad consists of the points (c + a cos t, b sin t). Their distance from the
                // axis is stationary at sin t = 0 and at cos t = u.
                let u = c * a / (b * b - a * a);
                if u.abs() < 1.0 {
                    radii.push((c * c + b * b + c * a * u).sqrt());
                }
            }
        }
        radii
    }

    /// Smallest and largest distance of the pad from the axis, including the part of the pad beside the blade.
    pub(crate) fn reach_m(&self) -> [f64; 2] {
        let nearest = (self.radius_m - self.half_lengths_m()[0]).max(0.0);
        [
            nearest,
            self.touching_radii_m().into_iter().fold(0.0, f64::max),
        ]
    }
}

/// Validates a pad; `index` is its position in the list of the scene.
pub fn guide(index: usize, pad: &GuideFile, blade: &Blade) -> Result<Guide, SceneError> {
    let of = |name: &str| format!("guides[{index}].{name}");
    let lifting = lifting(&of, pad)?;
    lifts_alone(&of, pad)?;
    arm(&of, pad)?;
    let film = film(&of, pad)?;
    let controller = pad.controller.as_ref();
    let controller = controller
        .map(|it| it.law(|name| of(&format!("controller.{name}"))))
        .transpose()?;
    if (pad.radial_length_m == 0.0) != (pad.tangential_length_m == 0.0) {
        return Err(refuse(
            &of("tangential_length_m"),
            pad.tangential_length_m,
            "zero exactly when radial_length_m is",
            "give both sides of the pad, or zero for both to make it a point spring",
        ));
    }
    let [nearest_m, farthest_m] = pad.reach_m();
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
    Ok(Guide {
        index,
        typed: pad.clone(),
        lifting,
        film,
        controller,
    })
}

/// Validates the gap of a pad that lifts off; `None` for a linear pad.
fn lifting(of: &impl Fn(&str) -> String, typed: &GuideFile) -> Result<Option<Lifting>, SceneError> {
    if typed.contact == ContactLaw::Linear {
        if typed.side != GuideSide::Both {
            let is_left = typed.side == GuideSide::Left;
            let side = if is_left { "left" } else { "right" };
            let allowed = "\"both\" where the contact is linear";
            let remedy = "a spring acts in both directions; give contact as \"one_sided\"";
            return Err(RefusedValue::new(of("side"), side, allowed, remedy).into());
        }
        let film = "a linear pad has one stiffness; give contact as \"one_sided\"";
        let offset = "a linear pad is at rest on the flat blade; give contact as \"one_sided\"";
        for (name, value, remedy) in [
            ("film_stiffness_n_per_m", typed.film_stiffness_n_per_m, film),
            ("offset_m", typed.offset_m, offset),
        ] {
            if value != 0.0 {
                let allowed = "0 where the contact is linear";
                return Err(refuse(&of(name), value, allowed, remedy));
            }
        }
        return Ok(None);
    }
    let Some(gap_m) = typed.gap_m else {
        let allowed = "given where the contact is one_sided";
        let remedy = "a pad that lifts off touches the blade beyond a gap; give it, such as 4e-5";
        return Err(RefusedValue::missing(&of("gap_m"), allowed, remedy).into());
    };
    let stiffness = typed.stiffness_n_per_m;
    if stiffness == 0.0 {
        let allowed = "above 0 where the contact is one_sided";
        let remedy = "give the stiffness of the pad, or leave the pad out";
        return Err(refuse(&of("stiffness_n_per_m"), stiffness, allowed, remedy));
    }
    let film = typed.film_stiffness_n_per_m;
    if film > stiffness {
        return Err(refuse(
            &of("film_stiffness_n_per_m"),
            film,
            format!("from 0 to the stiffness of the pad ({})", shown(stiffness)),
            "a film is softer than its pad",
        ));
    }
    Ok(Some(Lifting {
        offset_m: typed.offset_m,
        gap_m,
        film_stiffness_n_per_m: film,
        side: typed.side,
    }))
}

/// Checks that a pad that lifts off has neither arm nor film nor controller.
fn lifts_alone(of: &impl Fn(&str) -> String, pad: &GuideFile) -> Result<(), SceneError> {
    if pad.contact == ContactLaw::Linear {
        return Ok(());
    }
    let arm =
        "a pad that lifts off stands on the frame; give it the stiffness of pad and arm in series";
    let film = "a pad that lifts off has no film that pulls";
    let controller = "a pad that lifts off cannot pull";
    let parts = [
        (
            "arm.stiffness_n_per_m",
            pad.arm.map(|arm| shown(arm.stiffness_n_per_m)),
            arm,
        ),
        ("film.lag_s", pad.film.map(|film| shown(film.lag_s)), film),
        (
            "controller",
            pad.controller.as_ref().map(|_| "given".to_owned()),
            controller,
        ),
    ];
    for (name, given, remedy) in parts {
        if let Some(given) = given {
            let allowed = "left out where the contact is one_sided";
            return Err(RefusedValue::new(of(name), given, allowed, remedy).into());
        }
    }
    Ok(())
}

/// The law of the film of a pad, if it has one.
fn film(of: &impl Fn(&str) -> String, pad: &GuideFile) -> Result<Option<PadLaw>, SceneError> {
    let damping = pad.damping_n_s_per_m;
    if pad.film.is_some() && damping == 0.0 {
        let allowed = "above 0 where the pad has a film";
        let remedy = "give the damping of the film, whose force lags, or leave the film out";
        return Err(refuse(&of("damping_n_s_per_m"), damping, allowed, remedy));
    }
    Ok(pad.film.map(|film| PadLaw::lagging(damping, film.lag_s)))
}

/// Validates the arm of a pad.
fn arm(of: &impl Fn(&str) -> String, pad: &GuideFile) -> Result<(), SceneError> {
    let Some(arm) = pad.arm else {
        return Ok(());
    };
    if arm.damping_n_s_per_m > 0.0 && arm.loss_factor > 0.0 {
        let allowed = "0 where the arm has damping_n_s_per_m";
        let remedy = "give one of them";
        return Err(refuse(
            &of("arm.loss_factor"),
            arm.loss_factor,
            allowed,
            remedy,
        ));
    }
    let damping = pad.damping_n_s_per_m + arm.damping_n_s_per_m + arm.loss_factor;
    if (damping > 0.0 || pad.controller.is_some()) && arm.mass_kg == 0.0 {
        let allowed = "above 0 where the pad or its arm has damping, or the pad a controller";
        let remedy = "give the mass of the head";
        return Err(refuse(&of("arm.mass_kg"), 0.0, allowed, remedy));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;

    /// A pad that lifts off with all that it needs, modified.
    fn with(change: impl FnOnce(&mut GuideFile)) -> Result<Scene, SceneError> {
        Scene::paper().edited(|file| {
            let pad = &mut file.guides[0];
            pad.contact = ContactLaw::OneSided;
            pad.gap_m = Some(4e-5);
            change(pad);
        })
    }

    #[test]
    fn a_pad_that_lifts_off_has_what_was_typed() {
        let scene = with(|pad| {
            pad.side = GuideSide::Left;
            pad.film_stiffness_n_per_m = 1e5;
            pad.offset_m = -1e-5;
        });
        let expected = Lifting {
            gap_m: 4e-5,
            film_stiffness_n_per_m: 1e5,
            side: GuideSide::Left,
            offset_m: -1e-5,
        };
        assert_eq!(scene.unwrap().guides()[0].lifting, Some(expected));
        assert_eq!(Scene::paper().guides()[0].lifting, None);
    }
}
