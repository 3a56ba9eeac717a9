//! Rotation speeds and their ranges.

use serde::{Deserialize, Serialize};

use super::quantities::quantity;
use super::quantity::TURNS_THE_OTHER_WAY;
use super::rule::refuse;
use super::{RefusedValue, SceneError, rad_per_s, rpm};
use crate::page::text::shown;

/// Range of rotation speeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpeedRange {
    /// First speed.
    pub from_rad_per_s: f64,
    /// Last speed.
    pub to_rad_per_s: f64,
}

/// Checks that the speed rises from `from_rpm` to `to_rpm` of a block of the scene.
pub fn check_rise(
    block: &str,
    from_rpm: f64,
    to_rpm: f64,
    remedy: &'static str,
) -> Result<(), SceneError> {
    if to_rpm > from_rpm {
        return Ok(());
    }
    let allowed = format!("more than {block}.from_rpm ({})", shown(from_rpm));
    Err(refuse(&format!("{block}.to_rpm"), to_rpm, allowed, remedy))
}

/// Converts a speed to rpm and removes the rounding error of the conversion.
fn rounded_rpm(rad_per_s: f64) -> f64 {
    (1e3 * rpm(rad_per_s)).round() / 1e3
}

impl SpeedRange {
    /// The range between two speeds, in rad/s.
    pub const fn new(from_rad_per_s: f64, to_rad_per_s: f64) -> Self {
        SpeedRange {
            from_rad_per_s,
            to_rad_per_s,
        }
    }

    /// The range between two speeds in rpm.
    pub fn between_rpm(from_rpm: f64, to_rpm: f64) -> Self {
        Self::new(rad_per_s(from_rpm), rad_per_s(to_rpm))
    }

    /// First and last speed, in rad/s.
    pub const fn ends(&self) -> [f64; 2] {
        [self.from_rad_per_s, self.to_rad_per_s]
    }

    /// Last minus first speed, in rad/s.
    pub const fn width(&self) -> f64 {
        self.to_rad_per_s - self.from_rad_per_s
    }

    /// The part of the range that lies in another one; it ends before it begins if there is none.
    pub const fn within(&self, other: SpeedRange) -> Self {
        Self::new(
            self.from_rad_per_s.max(other.from_rad_per_s),
            self.to_rad_per_s.min(other.to_rad_per_s),
        )
    }

    /// Whether a speed lies in the range, in rad/s.
    pub fn contains(&self, speed_rad_per_s: f64) -> bool {
        (self.from_rad_per_s..=self.to_rad_per_s).contains(&speed_rad_per_s)
    }

    /// Converts an argument in rpm to rad/s.
    ///
    /// # Errors
    /// [`RefusedValue`] if the speed is outside the range; `key` names the argument.
    pub fn speed_at(&self, key: &str, rpm: f64) -> Result<f64, RefusedValue> {
        let speed = rad_per_s(rpm);
        let [from, to] = self.ends();
        // Rounding in the conversion from rpm must not exclude the ends of the sweep.
        if from <= speed * (1.0 + 1e-12) && speed * (1.0 - 1e-12) <= to {
            return Ok(speed);
        }
        let allowed = format!(
            "from {} to {}, the speeds of the sweep",
            shown(rounded_rpm(from)),
            shown(rounded_rpm(to))
        );
        let remedy = "name one of these, or widen `sweep` in the scene";
        Err(RefusedValue::new(key, rpm, allowed, remedy))
    }
}

/// Converts an argument in rpm, which must be positive, to rad/s; `key` names it in the error.
pub(crate) fn speed_rad_per_s(key: &str, rpm: f64) -> Result<f64, RefusedValue> {
    const MAX_RPM: f64 = quantity("operating_rpm").allowed.to;
    if rpm > 0.0 && rpm <= MAX_RPM {
        return Ok(rad_per_s(rpm));
    }
    let allowed = format!("above 0 and at most {}", shown(MAX_RPM));
    let remedy = if rpm < 0.0 {
        TURNS_THE_OTHER_WAY
    } else {
        "give it in revolutions per minute"
    };
    Err(RefusedValue::new(key, rpm, allowed, remedy))
}
