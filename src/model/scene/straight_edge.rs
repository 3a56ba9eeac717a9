//! A straight edge across a blade that lies on two points, and the light gap under it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::roll_band::RollBand;
use super::rule::refuse;
use super::{Blade, Bore, SceneError};
use crate::page::text::shown;

/// Straight edge across the blade off its machine. The blade lies level on two opposite points and sags under its own weight;
/// the straight edge touches it with both ends, on the diameter at right angles to that of the points. The light gap is read
/// in the middle, at the edge of the bore. It is positive where roll tension makes the middle sag more than the ends. A blade
/// that is not rolled touches the straight edge in the middle; its gap, which is then under the ends, is negative.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StraightEdgeFile {
    /// Length of the straight edge; by default the outer diameter of the blade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// Distance of the two points from the axis; by default the radius of the rim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support_radius_m: Option<f64>,
    /// Measured light gap. The report gives the eigenstrain of the rolled bands that causes it, all bands in proportion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured_gap_m: Option<f64>,
}

/// Validated straight edge.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StraightEdge {
    /// The blade off its machine, with a free bore.
    pub blade: Blade,
    /// Distance of the ends of the straight edge from the axis.
    pub end_radius_m: f64,
    /// Distance of the supports from the axis.
    pub support_radius_m: f64,
    /// Measured light gap.
    pub measured_gap_m: Option<f64>,
}

impl StraightEdge {
    pub(super) fn new(
        typed: &StraightEdgeFile,
        blade: &Blade,
        bore: f64,
        bands: &[RollBand],
    ) -> Result<Self, SceneError> {
        let key = |name: &str| format!("membrane.straight_edge.{name}");
        let rim = blade.outer_radius_m;
        let on_blade = |name: &str, typed: Option<f64>, times: f64, remedy| match typed {
            None => Ok(rim),
            Some(value) if value > times * bore && value <= times * rim => Ok(value / times),
            Some(value) => {
                let (from, to) = (shown(times * bore), shown(times * rim));
                let allowed = format!("above {from} and at most {to}, within bore and rim");
                Err(refuse(&key(name), value, allowed, remedy))
            }
        };
        let whole = "give the length that lies on the blade";
        let points = "give the distance of each point from the axis";
        let is_rolled = bands.iter().any(|band| band.eigenstrain != 0.0);
        if let Some(gap) = typed.measured_gap_m.filter(|_| !is_rolled) {
            let allowed = "given beside a rolled band, with an eigenstrain other than zero";
            let remedy = "add the band to roll_tension, with any eigenstrain such as 1e-4";
            return Err(refuse(&key("measured_gap_m"), gap, allowed, remedy));
        }
        Ok(StraightEdge {
            blade: Blade {
                inner_radius_m: bore,
                bore: Bore::Free,
                slots: None,
                wave_factors: None,
                clamp_n_m_per_rad_per_m: None,
                ..*blade
            },
            end_radius_m: on_blade("length_m", typed.length_m, 2.0, whole)?,
            support_radius_m: on_blade("support_radius_m", typed.support_radius_m, 1.0, points)?,
            measured_gap_m: typed.measured_gap_m,
        })
    }
}
