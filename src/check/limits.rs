//! What a saw has to keep: as typed, in rpm, and validated, in rad/s.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::{RefusedValue, Scene, rpm, speed_rad_per_s, unusual_number};
use crate::stability::OPERATING_LIMIT;
use crate::text::shown;

/// What a saw has to keep, as the options of `sawflutter check` and the block `limits` of a study.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Speed at which it is run; the scene's by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub operating_rpm: Option<f64>,
    /// Largest share of the lowest critical speed that the operating speed may be.
    #[serde(default = "default_margin")]
    pub margin: f64,
    /// Least flutter speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_flutter_rpm: Option<f64>,
    /// Least first critical speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_critical_rpm: Option<f64>,
}

fn default_margin() -> f64 {
    OPERATING_LIMIT
}

impl LimitsFile {
    /// The limits of a scene, and the usual one of the rim.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the number that no limit has, or the operating speed where
    /// there is none.
    pub fn limits(&self, scene: &Scene) -> Result<Limits, RefusedValue> {
        let operating_rpm = scene.needed_operating_rpm(self.operating_rpm)?;
        if !(self.margin > 0.0 && self.margin <= 1.0) {
            let allowed = "above 0 and at most 1";
            let remedy = "the usual rule is 0.85";
            return Err(RefusedValue::new("margin", self.margin, allowed, remedy));
        }
        let speed = |key, rpm: Option<f64>| rpm.map(|rpm| speed_rad_per_s(key, rpm)).transpose();
        Ok(Limits {
            operating_rad_per_s: speed_rad_per_s("operating_rpm", operating_rpm)?,
            margin: self.margin,
            min_flutter_rad_per_s: speed("min_flutter_rpm", self.min_flutter_rpm)?,
            min_critical_rad_per_s: speed("min_critical_rpm", self.min_critical_rpm)?,
            max_rim_m_per_s: RIM_LIMIT_M_PER_S,
            max_amplitude_m: None,
            accept_unusual: false,
        })
    }
}

/// What a saw has to keep, speeds in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Speed at which it is run.
    pub operating_rad_per_s: f64,
    /// Largest share of the lowest critical speed that the operating speed may be.
    pub margin: f64,
    /// Least flutter speed.
    pub min_flutter_rad_per_s: Option<f64>,
    /// Least first critical speed.
    pub min_critical_rad_per_s: Option<f64>,
    /// Largest speed of the rim.
    pub max_rim_m_per_s: f64,
    /// Largest deflection that flutter may rise to in any band from rest to the operating speed, without damping.
    pub max_amplitude_m: Option<f64>,
    /// Whether a saw with numbers that no saw has may pass.
    pub accept_unusual: bool,
}

/// Saws for wood are run with 60 to 90 m/s at the rim, and makers of carbide-tipped blades allow no
/// more than this.
pub const RIM_LIMIT_M_PER_S: f64 = 100.0;

/// The sweep reaches past the speeds asked for by this factor.
const BEYOND: f64 = 1.02;
/// Slopes of any saw would be far beyond what the model holds for.
const MAX_AMPLITUDE_MM: f64 = 1e3;
/// Faster than sound in steel.
const MAX_RIM_M_PER_S: f64 = 1e4;

impl Limits {
    /// The same with another limit of the speed of the rim.
    ///
    /// # Errors
    /// [`RefusedValue`] where no rim has this speed.
    pub fn with_rim_speed(self, max_rim_m_per_s: f64) -> Result<Self, RefusedValue> {
        if max_rim_m_per_s > 0.0 && max_rim_m_per_s <= MAX_RIM_M_PER_S {
            return Ok(Limits {
                max_rim_m_per_s,
                ..self
            });
        }
        let allowed = format!("above 0 and at most {}", shown(MAX_RIM_M_PER_S));
        let remedy = "saws for wood are run with at most 100";
        let key = "max_rim_m_per_s";
        Err(RefusedValue::new(key, max_rim_m_per_s, allowed, remedy))
    }

    /// The same with a limit of how far flutter rises, in millimetres, where there is one.
    ///
    /// # Errors
    /// [`RefusedValue`] where it is no length of a blade.
    pub fn with_amplitude(self, max_amplitude_mm: Option<f64>) -> Result<Self, RefusedValue> {
        let Some(given) = max_amplitude_mm else {
            return Ok(self);
        };
        if given > 0.0 && given <= MAX_AMPLITUDE_MM {
            return Ok(Limits {
                max_amplitude_m: Some(1e-3 * given),
                ..self
            });
        }
        let allowed = format!("above 0 and at most {}", shown(MAX_AMPLITUDE_MM));
        let remedy = "give it in millimetres, such as the gap of a guide or a share of the kerf";
        let key = "max_amplitude_mm";
        Err(RefusedValue::new(key, given, allowed, remedy))
    }

    /// The usual 85 % rule and the usual speed of the rim at an operating speed, and nothing else.
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

    /// Numbers that no saw has: those of a scene, and speeds that are asked for and not in it.
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
                "the least flutter speed",
                "sweep.to_rpm",
                self.min_flutter_rad_per_s.map(rpm),
            ),
            (
                "the least critical speed",
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

    /// How far a sweep has to go at least: past every speed asked for, so that a band that begins
    /// there is seen to.
    pub fn reach_rad_per_s(&self) -> f64 {
        let asked = [
            Some(self.operating_rad_per_s / self.margin),
            self.min_flutter_rad_per_s,
            self.min_critical_rad_per_s,
        ];
        BEYOND * asked.into_iter().flatten().fold(0.0, f64::max)
    }
}
