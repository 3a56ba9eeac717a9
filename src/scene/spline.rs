//! The splined bore: its teeth and their contact with the arbor.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::refuse;
use super::{Blade, Mount, RefusedValue, SceneError, SceneFile};
use crate::text::shown;

/// Contact between the splined bore and the arbor; with it the in-plane motion of the blade is simulated.
///
/// The paper states the clearance. It gives neither the number of spline teeth nor their shape, and for the
/// contact two numbers whose units do not fit its formula F = K x^{3/2} + C ẋ^{3/2}: K = 2.2e5 "N/m" and C =
/// 0.15 "N-s/m". Interpreted in metres, with 2.2e5 N/m^{3/2} the weight of the paper's blade alone would
/// cause an approach of millimetres. In millimetres, the usual unit of the program used in the paper, they
/// are 6.96e9 N/m^{3/2} and 4.74e3 N/(m/s)^{3/2}. Therefore neither has a default.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplineFile {
    /// Number of spline teeth.
    pub teeth: u32,
    /// Angle between a flank and the radius through it: 0 for straight-sided teeth, 30 for the usual involute
    /// spline.
    pub pressure_angle_deg: f64,
    /// K of the contact force K x^{3/2} at the approach x of a flank.
    pub contact_stiffness_n_per_m_3_2: f64,
    /// C of the contact force C ẋ^{3/2} at the speed of approach ẋ of a flank.
    pub contact_damping_n_s_3_2_per_m_3_2: f64,
    /// Gap between two flanks while the blade is centred.
    #[serde(default = "papers_clearance_m")]
    pub clearance_m: f64,
    /// Radius of the contact; by default that of the bore.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch_radius_m: Option<f64>,
    /// Direction of the weight of the blade, from the cut (θ = 0), positive in the direction of rotation.
    /// Without it the weight does not act in the plane of the blade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight_angle_deg: Option<f64>,
}

/// Section 2 of the paper: "the clearance between the spline arbor and the matching
/// spline of the disk is 0.25 mm".
fn papers_clearance_m() -> f64 {
    0.25e-3
}

/// Validated contact between bore and arbor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spline {
    /// Number of spline teeth.
    pub teeth: usize,
    /// Angle between a flank and the radius through it.
    pub pressure_angle_rad: f64,
    /// K of the contact force K x^{3/2}.
    pub contact_stiffness_n_per_m_3_2: f64,
    /// C of the contact force C ẋ^{3/2}.
    pub contact_damping_n_s_3_2_per_m_3_2: f64,
    /// Gap at every flank while the blade is centred.
    pub clearance_m: f64,
    /// Radius of the contact.
    pub pitch_radius_m: f64,
    /// Direction of the weight, if it acts in the plane of the blade.
    pub weight_angle_rad: Option<f64>,
}

impl Spline {
    pub(super) fn of(file: &SceneFile, blade: &Blade) -> Result<Option<Self>, SceneError> {
        let Some(typed) = &file.spline else {
            return Ok(None);
        };
        if let Mount::Collar { .. } = file.mount {
            let allowed = "spline when the scene has a spline block";
            let remedy = "a collar holds the blade in its plane; leave one of the two out";
            return Err(RefusedValue::new("mount.kind", "collar", allowed, remedy).into());
        }
        Self::measured(typed, blade).map(Some)
    }

    fn measured(typed: &SplineFile, blade: &Blade) -> Result<Self, SceneError> {
        let bore = blade.inner_radius_m;
        if typed.clearance_m > bore {
            let allowed = format!("at most the radius of the bore ({})", shown(bore));
            let remedy = "with a larger one the blade would fall off the arbor";
            return Err(refuse(
                "spline.clearance_m",
                typed.clearance_m,
                allowed,
                remedy,
            ));
        }
        let pitch_radius_m = typed.pitch_radius_m.unwrap_or(bore);
        let (least, most) = (0.5 * bore, blade.outer_radius_m);
        if !(least..=most).contains(&pitch_radius_m) {
            let allowed = format!("between {} and {}", shown(least), shown(most));
            let remedy = "give the radius at which the flanks touch, near that of the bore";
            return Err(refuse(
                "spline.pitch_radius_m",
                pitch_radius_m,
                allowed,
                remedy,
            ));
        }
        Ok(Spline {
            teeth: typed.teeth as usize,
            pressure_angle_rad: typed.pressure_angle_deg.to_radians(),
            contact_stiffness_n_per_m_3_2: typed.contact_stiffness_n_per_m_3_2,
            contact_damping_n_s_3_2_per_m_3_2: typed.contact_damping_n_s_3_2_per_m_3_2,
            clearance_m: typed.clearance_m,
            pitch_radius_m,
            weight_angle_rad: typed.weight_angle_deg.map(f64::to_radians),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn the_papers_clearance_and_the_bore_are_the_only_defaults() {
        let typed = r#"{ "teeth": 20, "pressure_angle_deg": 0,
            "contact_stiffness_n_per_m_3_2": 7e9, "contact_damping_n_s_3_2_per_m_3_2": 0 }"#;
        let typed: SplineFile = serde_json::from_str(typed).unwrap();
        let blade = Scene::paper().blade;
        let spline = Spline::measured(&typed, &blade).unwrap();
        assert_eq!(spline.clearance_m, 0.25e-3);
        assert_eq!(spline.pitch_radius_m, blade.inner_radius_m);
        assert_eq!(spline.weight_angle_rad, None);
        assert!(serde_json::from_str::<SplineFile>(r#"{ "teeth": 20 }"#).is_err());
    }
}
