//! Deviation of the board: how far a constant lateral force deflects the rim at the cut.
//!
//! The force is the typed `side_force`, without one that of the cut, without either an assumed one of 1 N. Between pads with a gap the
//! deflection is that of the equilibrium of the blade in contact with them, otherwise that of the linear blade in its cut, if the scene has
//! one. All commands that name this deflection compute it here, whether they analyse the saw idling or in its cut.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::check::{Judged, point_load_plate, rim_at_cut};
use crate::analyses::deflect::PointLoad;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{ForceCause, Scene, rad_per_s, rpm};
use crate::motion::stretched_blade::{Deviation, PressedBlade, StretchedError};
use crate::motion::transient::{at_point, linear_limit_m};
use crate::page::outline::LENGTH;
use crate::page::text::{shown, shown_to};
use crate::stability::Analysis;

/// Stationary deflection of the rim at the cut under a constant lateral force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "BoardDeviationEntry")]
pub struct BoardDeviation {
    /// Rotation speed.
    pub rpm: f64,
    /// The lateral force.
    pub force_n: f64,
    /// Where the force comes from.
    pub cause: ForceCause,
    /// Whether the deflection is that of the blade in contact with guides that have a gap; otherwise all guides are linear.
    pub by_contact: bool,
    /// Deflection of the rim at the cut, as an absolute value; null if it is unknown.
    pub deflection_m: Option<f64>,
    /// Reason for which the deflection is unknown; null if it is known.
    #[serde(default)]
    pub unknown: Option<String>,
}

impl BoardDeviation {
    /// The deflection of the saw of an analysis at a speed. Unknown unless the saw is stable there.
    pub(crate) fn of(analysis: &Analysis, speed_rad_per_s: f64) -> Self {
        let judged = Judged::of(analysis, speed_rad_per_s);
        Self::of_judged(&analysis.scene, analysis.model.plate.resolution, &judged)
    }

    /// The deflection of a saw that was judged on a basis.
    pub(crate) fn of_judged(scene: &Scene, own: Resolution, judged: &Judged) -> Self {
        let rpm = rpm(judged.speed_rad_per_s);
        let force = scene.constant_force_at(rpm);
        let by_contact = is_in_contact(scene);
        let refused = if by_contact {
            judged.not_stable()
        } else {
            judged.no_answer()
        };
        let found = match refused {
            Some(reason) => Err(reason.to_owned()),
            None => at_cut_m(scene, own, &sawing_plate(scene, own, rpm), rpm),
        };
        let (deflection_m, unknown) = match found {
            Ok(m) => (Some(m), None),
            Err(reason) => (None, Some(reason)),
        };
        BoardDeviation {
            rpm,
            force_n: force.force_n,
            cause: force.cause,
            by_contact,
            deflection_m,
            unknown,
        }
    }

    /// The deflection in a sentence: "Sawing deviation at 2400 rpm: 0.105 mm under the lateral force of the cut, 3.33 N".
    pub(crate) fn in_words(&self) -> String {
        let speed = format!("at {} rpm", shown_to(6, self.rpm));
        let force = format!("{} N", shown_to(3, self.force_n));
        let found = match (self.deflection_m, &self.unknown) {
            (Some(m), _) => LENGTH.digits(3, m).with_unit(),
            (None, Some(reason)) => format!("unknown, because {reason}"),
            (None, None) => "unknown".to_owned(),
        };
        let contact = if self.by_contact {
            ", between guides with their gaps"
        } else {
            ""
        };
        match self.cause {
            ForceCause::Assumed => {
                format!("Deflection at the cut {speed} under {force}{contact}: {found}")
            }
            ForceCause::SideForce => {
                format!(
                    "Sawing deviation {speed} under side_force.force_n of {force}{contact}: {found}"
                )
            }
            ForceCause::Cut => {
                format!(
                    "Sawing deviation {speed} under the lateral force of the cut, {force}{contact}: {found}"
                )
            }
        }
    }
}

/// The plate of a scene for a deviation with linear guides, on a basis for point loads: in its cut at a speed in rpm, if it has one.
pub(crate) fn sawing_plate(scene: &Scene, own: Resolution, rpm: f64) -> Plate {
    let in_cut = scene.cut().map(|_| scene.charted_in_cut(rpm));
    match in_cut {
        Some(Ok(in_cut)) => point_load_plate(&in_cut, own),
        _ => point_load_plate(scene, own),
    }
}

fn is_in_contact(scene: &Scene) -> bool {
    scene.guides().iter().any(|guide| guide.lifting.is_some())
}

/// Deflection of the rim at the cut under the constant force of a scene at a speed in rpm, as an absolute value, or the reason for which
/// it is unknown. `own` is the basis on which contact is computed, `linear` the plate for linear guides, see [`sawing_plate`].
///
/// # Errors
/// The reason in words.
pub(crate) fn at_cut_m(
    scene: &Scene,
    own: Resolution,
    linear: &Plate,
    rpm: f64,
) -> Result<f64, String> {
    if is_in_contact(scene) {
        let found = pressed(scene, own, rpm).map_err(|error| error.to_string())?;
        let invalid = "the blade deflects further than the model is valid for";
        return found
            .map(|at| at.deviation_m.abs())
            .ok_or(invalid.to_owned());
    }
    let force = scene.constant_force_at(rpm);
    let Some(load) = PointLoad::on(linear, &force.places) else {
        return Err("nothing holds the blade's rigid motions".to_owned());
    };
    let Some(deflected) = load.deflected(rad_per_s(rpm)) else {
        return Err("the speed is a critical speed".to_owned());
    };
    let reading = at_point(linear, rim_at_cut(scene));
    let deflection_m = (force.force_n * (reading.transpose() * deflected)).abs();
    let limit_m = linear_limit_m(&linear.blade);
    (deflection_m <= limit_m)
        .then_some(deflection_m)
        .ok_or_else(|| {
            format!(
                "it exceeds {} mm, five thicknesses of the blade",
                shown(1e3 * limit_m)
            )
        })
}

/// The equilibrium of the blade in contact with its guides under the constant force of the scene, without other forces of a cut; `None`
/// if the model is not valid.
///
/// # Errors
/// [`StretchedError`].
pub(crate) fn pressed(
    scene: &Scene,
    own: Resolution,
    rpm: f64,
) -> Result<Option<Deviation>, StretchedError> {
    let force_n = scene.constant_force_at(rpm).force_n;
    let still = scene.idling();
    let scene = still.as_ref().unwrap_or(scene);
    PressedBlade::new(scene, own, rpm, PressedBlade::MODES)?.deviation(force_n, rpm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::solvers::Solve;

    use crate::analyses::check::{Limits, check};
    use crate::model::scene::{ContactLaw, Polar, SceneFile, SideForceFile};
    use crate::model::system::GyroscopicSystem;

    /// A saw for boards of 80 mm, on a collar between two pads.
    const BOARDS: &str = r#"{
        "name": "Boards of 80 mm", "accuracy": "draft", "operating_rpm": 2400,
        "blade": {"outer_diameter_m": 0.55, "inner_diameter_m": 0.04, "thickness_m": 0.0022, "teeth": 36, "material":
            {"youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}},
        "mount": {"kind": "collar", "diameter_m": 0.12, "in_plane": "free"},
        "guides": [
            {"radius_m": 0.22, "angle_deg": -40, "radial_length_m": 0.06, "tangential_length_m": 0.05, "stiffness_n_per_m": 1e7},
            {"radius_m": 0.22, "angle_deg": 40, "radial_length_m": 0.06, "tangential_length_m": 0.05, "stiffness_n_per_m": 1e7}]}"#;

    fn analysed(change: impl FnOnce(&mut SceneFile)) -> Analysis {
        let scene = Scene::from_json(BOARDS).unwrap().edited(change).unwrap();
        Analysis::new(&scene).unwrap()
    }

    fn deviation(analysis: &Analysis) -> BoardDeviation {
        let operating = analysis.report().operating.unwrap();
        operating.deviation.unwrap()
    }

    fn with_gaps(gap_m: f64, saw: &mut SceneFile) {
        for guide in &mut saw.guides {
            (guide.contact, guide.gap_m) = (ContactLaw::OneSided, Some(gap_m));
        }
    }

    /// Within a gap that the blade does not cross, its pads hold nothing: the deflection is that of the blade without them. At a quarter
    /// of the speed the blade stretches by less than its linear deflection.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn between_wide_gaps_the_blade_deflects_as_without_guides() {
        let slow = |saw: &mut SceneFile| {
            (saw.operating_rpm, saw.side_force) = (Some(600.0), Some(SideForceFile::of(0.1)));
        };
        let wide = deviation(&analysed(|saw| {
            slow(saw);
            with_gaps(1e-3, saw);
        }));
        let guided = deviation(&analysed(slow));
        let bare = deviation(&analysed(|saw| {
            slow(saw);
            saw.guides.clear();
        }));
        let [wide_m, guided_m, bare_m] =
            [&wide, &guided, &bare].map(|found| found.deflection_m.unwrap());
        assert!(wide.by_contact && !bare.by_contact);
        assert!((wide_m / bare_m - 1.0).abs() < 0.02, "{wide_m} {bare_m}");
        assert!(wide_m > 1.5 * guided_m, "{wide_m} {guided_m}");
    }

    /// Pads with a gap of 0.05 mm at 2400 rpm, where the blade between them is past its critical speed: 0.309 mm, by Newton's method on
    /// the equilibrium of its matrices, and not the 0.031 mm of pads that touch.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn pads_with_a_gap_let_the_blade_deflect_ten_times_as_far() {
        let analysis = analysed(|saw| with_gaps(5e-5, saw));
        let found = deviation(&analysis);
        let deflection_m = found.deflection_m.unwrap();
        assert!((deflection_m / 3.09e-4 - 1.0).abs() < 0.01, "{found:?}");
        assert_eq!((found.cause, found.force_n), (ForceCause::Assumed, 1.0));
        assert!(
            found
                .in_words()
                .starts_with("Deflection at the cut at 2400 rpm under 1 N")
        );
        let limits = Limits::at(rad_per_s(2400.0));
        let checked = check(&analysis.scene, &limits).unwrap().deviation.unwrap();
        assert_eq!(checked.deflection_m, found.deflection_m);
    }

    /// By reciprocity the deflection at the cut under forces on the teeth is that of the teeth of the adjoint blade under the same force at
    /// the cut.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn the_force_of_the_cut_acts_on_its_teeth() {
        let analysis = analysed(|saw| {
            let cut = r#"{"depth_m": 0.08, "power_w": 12000, "lateral_n_per_tooth": 2}"#;
            saw.cut = Some(serde_json::from_str(cut).unwrap());
        });
        let found = deviation(&analysis);
        let scene = &analysis.scene;
        let speed = rad_per_s(2400.0);
        let plate = sawing_plate(scene, analysis.model.plate.resolution, 2400.0);
        let stiffness = GyroscopicSystem::of_plate(&plate).stiffness_at(speed);
        let at_cut = at_point(&plate, rim_at_cut(scene));
        // The forces of the cut follow the blade, so that its stiffness is not symmetric.
        let adjoint = stiffness
            .transpose()
            .to_owned()
            .partial_piv_lu()
            .solve(&at_cut);
        // A depth of 5/3 of the pitch: one tooth in the middle for a third of the time, else two half a pitch beside it.
        let mean = 0.08 * 36.0 / (std::f64::consts::PI * 0.55);
        let at = |pitches: f64| -> f64 {
            let angle = pitches * std::f64::consts::TAU / 36.0;
            at_point(&plate, Polar::new(0.275, angle)).transpose() * &adjoint
        };
        let expected = 2.0 * ((2.0 - mean) * at(0.0) + (mean - 1.0) * (at(-0.5) + at(0.5)));
        let deflection_m = found.deflection_m.unwrap();
        assert!(
            (deflection_m / expected - 1.0).abs() < 1e-9,
            "{expected} {found:?}"
        );
        assert!((found.force_n - 2.0 * mean).abs() < 1e-9);
        assert!(found.in_words().starts_with(
            "Sawing deviation at 2400 rpm under the lateral force of the cut, 3.33 N"
        ));
    }
}
