//! Limits that a saw has to keep: as typed, in rpm, and validated, in rad/s.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::scene::{RefusedValue, Scene, rpm, speed_rad_per_s, unusual_number};
use crate::page::text::shown;
use crate::stability::OPERATING_LIMIT;

/// Limits of a saw, as options of `sawflutter check` and in the block `limits` of a study.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Operating speed; by default that of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_rpm: Option<f64>,
    /// Largest ratio of the operating speed to the first critical speed.
    #[serde(default = "default_margin")]
    pub margin: f64,
    /// Lower limit of the flutter speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_flutter_rpm: Option<f64>,
    /// Lower limit of the first critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_critical_rpm: Option<f64>,
}

fn default_margin() -> f64 {
    OPERATING_LIMIT
}

impl LimitsFile {
    /// The limits of a scene, with the usual limit of the rim speed.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the invalid limit, or the operating speed if it is missing.
    pub fn limits(&self, scene: &Scene) -> Result<Limits, RefusedValue> {
        let operating_rpm = scene.needed_operating_rpm(self.operating_rpm)?;
        if !(self.margin > 0.0 && self.margin <= 1.0) {
            let allowed = "above 0 and at most 1";
            let remedy = "the usual rule is 0.85";
            return Err(RefusedValue::new("margin", self.margin, allowed, remedy));
        }
        let speed = |key, rpm: Option<f64>| rpm.map(|rpm| speed_rad_per_s(key, rpm)).transpose();
        Ok(Limits {
            margin: self.margin,
            min_flutter_rad_per_s: speed("min_flutter_rpm", self.min_flutter_rpm)?,
            min_critical_rad_per_s: speed("min_critical_rpm", self.min_critical_rpm)?,
            ..Limits::at(speed_rad_per_s("operating_rpm", operating_rpm)?)
        })
    }
}

/// Limits that a saw has to keep, with speeds in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Operating speed.
    pub operating_rad_per_s: f64,
    /// Largest ratio of the operating speed to the first critical speed.
    pub margin: f64,
    /// Lower limit of the flutter speed.
    pub min_flutter_rad_per_s: Option<f64>,
    /// Lower limit of the first critical speed.
    pub min_critical_rad_per_s: Option<f64>,
    /// Largest rim speed.
    pub max_rim_m_per_s: f64,
    /// Largest amplitude of flutter in any band up to the operating speed, without damping.
    pub max_amplitude_m: Option<f64>,
    /// Whether a saw with unusual numbers may pass.
    pub accept_unusual: bool,
}

/// Default limit of the rim speed, the largest that manufacturers of carbide-tipped blades allow. Saws for
/// wood have 60 to 90 m/s.
pub const RIM_LIMIT_M_PER_S: f64 = 100.0;

/// Factor by which the sweep exceeds the speeds of the limits.
const BEYOND: f64 = 1.02;
/// Largest limit of the amplitude: at a larger amplitude the slopes of any saw exceed the range of the model.
const MAX_AMPLITUDE_M: f64 = 1.0;
/// Largest limit of the rim speed; it exceeds the speed of sound in steel.
const MAX_RIM_M_PER_S: f64 = 1e4;

impl Limits {
    /// Replaces the limit of the rim speed.
    ///
    /// # Errors
    /// [`RefusedValue`] if the limit is out of range.
    pub fn with_rim_speed(self, max_rim_m_per_s: f64) -> Result<Self, RefusedValue> {
        if max_rim_m_per_s > 0.0 && max_rim_m_per_s <= MAX_RIM_M_PER_S {
            return Ok(Limits {
                max_rim_m_per_s,
                ..self
            });
        }
        let allowed = format!("above 0 and at most {}", shown(MAX_RIM_M_PER_S));
        let remedy = "saws for wood run at 100 or less";
        let key = "max_rim_m_per_s";
        Err(RefusedValue::new(key, max_rim_m_per_s, allowed, remedy))
    }

    /// Replaces the limit of the amplitude of flutter.
    ///
    /// # Errors
    /// [`RefusedValue`] if the limit is out of range.
    pub fn with_amplitude(self, max_amplitude_m: Option<f64>) -> Result<Self, RefusedValue> {
        match max_amplitude_m {
            Some(given) if !(given > 0.0 && given <= MAX_AMPLITUDE_M) => {
                let allowed = format!("above 0 and at most {} m", shown(MAX_AMPLITUDE_M));
                let remedy = "give a length such as the gap of a guide or a share of the kerf";
                Err(RefusedValue::new("max_amplitude_m", given, allowed, remedy))
            }
            _ => Ok(Limits {
                max_amplitude_m,
                ..self
            }),
        }
    }

    /// The 85 % rule and the usual limit of the rim speed for an operating speed, without other limits.
    pub fn at(operating_rad_per_s: f64) -> Self {
        Limits {
            operating_rad_per_s,
            margin: OPERATING_LIMIT,
            min_flutter_rad_per_s: None,
            min_critical_rad_per_s: None,
            max_rim_m_per_s: RIM_LIMIT_M_PER_S,
            max_amplitude_m: None,
            accept_unusual: false,
        }
    }

    /// Unusual numbers of a scene and of these limits.
    pub fn unusual_numbers(&self, scene: &Scene) -> Vec<String> {
        let file = scene.file();
        let operating_rpm = rpm(self.operating_rad_per_s);
        let is_asked = scene.operating_rad_per_s() != Some(self.operating_rad_per_s);
        let asked = [
            (
                "the operating speed",
                "operating_rpm",
                is_asked.then_some(operating_rpm),
            ),
            (
                "the lower limit of the flutter speed",
                "sweep.to_rpm",
                self.min_flutter_rad_per_s.map(rpm),
            ),
            (
                "the lower limit of the first critical speed",
                "sweep.to_rpm",
                self.min_critical_rad_per_s.map(rpm),
            ),
        ];
        let of_limits = asked
            .into_iter()
            .filter_map(|(label, path, value)| unusual_number(file, label, path, value?));
        file.unusual_numbers()
            .into_iter()
            .chain(of_limits)
            .collect()
    }

    /// Smallest end of a sweep: it exceeds every speed of the limits, so that a band that begins there is
    /// found.
    pub fn reach(&self) -> Reach {
        let reach = |key, factor: f64, speed: Option<f64>| Reach {
            key,
            factor,
            end_rad_per_s: factor * speed.unwrap_or(0.0),
        };
        let operating = reach(
            "operating_rpm",
            BEYOND / self.margin,
            Some(self.operating_rad_per_s),
        );
        let others = [
            reach("min_flutter_rpm", BEYOND, self.min_flutter_rad_per_s),
            reach("min_critical_rpm", BEYOND, self.min_critical_rad_per_s),
        ];
        others.into_iter().fold(operating, |far, other| {
            if other.end_rad_per_s > far.end_rad_per_s {
                other
            } else {
                far
            }
        })
    }
}

/// How far a sweep has to go, and the limit that requires it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Key of the limit.
    pub key: &'static str,
    /// End of the sweep in multiples of the limit.
    pub factor: f64,
    /// End of the sweep.
    pub end_rad_per_s: f64,
}
