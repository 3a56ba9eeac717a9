//! The splined bore: its teeth and their contact with the arbor.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::refuse;
use super::{Blade, Mount, RefusedValue, SceneError};
use crate::page::text::shown;

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

impl SplineFile {
    /// Checks that the bore of a blade with a mount has room for the contact.
    pub(super) fn checked(&self, mount: &Mount, blade: &Blade) -> Result<(), SceneError> {
        if let Mount::Collar { .. } = mount {
            let allowed = "spline when the scene has a spline block";
            let remedy = "a collar holds the blade in its plane; leave one of the two out";
            return Err(RefusedValue::new("mount.kind", "collar", allowed, remedy).into());
        }
        let bore = blade.inner_radius_m;
        if self.clearance_m > bore {
            let allowed = format!("at most the radius of the bore ({})", shown(bore));
            let remedy = "with a larger one the blade would fall off the arbor";
            return Err(refuse(
                "spline.clearance_m",
                self.clearance_m,
                allowed,
                remedy,
            ));
        }
        let (least, most) = (0.5 * bore, blade.outer_radius_m);
        if let Some(radius) = self.pitch_radius_m.filter(|r| !(least..=most).contains(r)) {
            let allowed = format!("between {} and {}", shown(least), shown(most));
            let remedy = "give the radius at which the flanks touch, near that of the bore";
            return Err(refuse("spline.pitch_radius_m", radius, allowed, remedy));
        }
        Ok(())
    }

    /// Radius of the contact with a blade.
    pub(crate) fn pitch_radius_on_m(&self, blade: &Blade) -> f64 {
        self.pitch_radius_m.unwrap_or(blade.inner_radius_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;

    #[test]
    fn the_papers_clearance_and_the_bore_are_the_only_defaults() {
        let json = r#"{ "teeth": 20, "pressure_angle_deg": 0,
            "contact_stiffness_n_per_m_3_2": 7e9, "contact_damping_n_s_3_2_per_m_3_2": 0 }"#;
        let typed: SplineFile = serde_json::from_str(json).unwrap();
        let blade = Scene::paper().blade;
        assert_eq!(typed.clearance_m, 0.25e-3);
        assert_eq!(typed.pitch_radius_on_m(&blade), blade.inner_radius_m);
        assert_eq!(typed.weight_angle_deg, None);
        assert!(serde_json::from_str::<SplineFile>(r#"{ "teeth": 20 }"#).is_err());
    }
}
