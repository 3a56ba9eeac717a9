//! Changes of a saw that a shop can make.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::decisive_speed::DecidedSpeed;
use super::error::DesignError;
use crate::analyses::campbell::Report;
use crate::model::scene::{Kind, Parameter, Quantity, Scene, SpeedRange, rpm};
use crate::modes::Cancellation;
use crate::stability::Onsets;

/// Number of changes in a report.
const SHOWN: usize = 2;

/// A change of one number of the scene, with the speeds of the changed saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ChangeEntry")]
pub struct Change {
    /// JSON path of the number.
    pub path: String,
    /// Value in the scene.
    pub from: f64,
    /// Changed value.
    pub to: f64,
    /// First critical speed of the changed saw, also above the sweep; null if it has none.
    pub first_critical_rpm: Option<f64>,
    /// Its flutter speed; null if the sweep contains none.
    pub flutter_rpm: Option<f64>,
}

impl Change {
    /// The changes that raise a speed most by the sensitivities of an analysis, computed over its range of speeds. A change that does not
    /// raise it, or that makes a saw that the scene or the analysis refuses, is left out.
    pub(super) fn best(
        scene: &Scene,
        range: SpeedRange,
        report: &Report,
        raised: DecidedSpeed,
    ) -> Result<Vec<Self>, DesignError> {
        let mut candidates: Vec<(f64, Parameter, [f64; 2])> = Vec::new();
        for sensitivity in &report.sensitivities {
            let parameter = Parameter::new(&sensitivity.parameter);
            let value = parameter.get(scene.file())?;
            let percent = raised.percent(sensitivity);
            let (Some(percent), Some(step)) = (percent, step(&parameter, value)) else {
                continue;
            };
            let slope = percent / sensitivity.step(value);
            let to = value + step * slope.signum();
            candidates.push((step * slope.abs(), parameter, [value, to]));
        }
        candidates.sort_by(|x, y| y.0.total_cmp(&x.0));
        let mut changes = Vec::new();
        for (_, parameter, [from, to]) in candidates {
            Cancellation::current().check()?;
            let changed = scene.file().with(&[(&parameter, to)]);
            let Ok(changed) = changed.and_then(|changed| changed.swept(range)) else {
                continue;
            };
            let Ok(onsets) = Onsets::new(&changed) else {
                continue;
            };
            let before = raised.rpm(report).unwrap_or(0.0);
            if raised.of_onsets(&onsets) <= before {
                continue;
            }
            changes.push(Change {
                path: parameter.path().to_owned(),
                from,
                to,
                first_critical_rpm: onsets.first_critical_rad_per_s.map(rpm),
                flutter_rpm: onsets.flutter_speed_rad_per_s.map(rpm),
            });
            if changes.len() == SHOWN {
                break;
            }
        }
        Ok(changes)
    }
}

/// Step of a number that a shop can make: 0.2 mm of the thickness, at most a tenth of it, 10 mm of a guide's radius, 5° of its angle, half of its stiffness, a fifth
/// of the roll tension. `None` for what a shop does not change, such as the material.
fn step(parameter: &Parameter, value: f64) -> Option<f64> {
    let path = parameter.path();
    match Quantity::kind_of(path) {
        Kind::GuideRadius => Some(0.01),
        Kind::Angle => Some(5.0),
        Kind::Stiffness => Some(0.5 * value),
        _ if path == "blade.thickness_m" => Some(f64::min(2e-4, 0.1 * value)),
        _ if path.ends_with(".eigenstrain") || path.ends_with(".groove_depth_m") => {
            Some(0.2 * value.abs())
        }
        _ => None,
    }
}
