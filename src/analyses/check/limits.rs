//! Limits that a saw has to keep, in rad/s.

use crate::model::scene::{
    RefusedValue, Scene, USUAL_MARGIN, USUAL_MAX_RIM_M_PER_S, rad_per_s, rpm, speed_rad_per_s,
    unusual_number,
};

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
    /// Largest deflection of the rim at the cut.
    pub max_deviation_m: Option<f64>,
    /// Whether a saw with unusual numbers may pass.
    pub accept_unusual: bool,
}

/// Factor by which the sweep exceeds the speeds of the limits.
const BEYOND: f64 = 1.02;
impl Limits {
    /// The limits of a scene at an operating speed, in rpm.
    ///
    /// # Errors
    /// [`RefusedValue`] if there is no such speed.
    pub fn of(scene: &Scene, operating_rpm: f64) -> Result<Self, RefusedValue> {
        let limits = scene.limits();
        Ok(Limits {
            margin: limits.margin(),
            min_flutter_rad_per_s: limits.min_flutter_rpm.map(rad_per_s),
            min_critical_rad_per_s: limits.min_critical_rpm.map(rad_per_s),
            max_rim_m_per_s: limits.max_rim_m_per_s(),
            max_amplitude_m: limits.max_amplitude_m,
            max_deviation_m: limits.max_deviation_m,
            ..Limits::at(speed_rad_per_s("operating_rpm", operating_rpm)?)
        })
    }

    /// The 85 % rule and the usual limit of the rim speed for an operating speed, without other limits.
    pub fn at(operating_rad_per_s: f64) -> Self {
        Limits {
            operating_rad_per_s,
            margin: USUAL_MARGIN,
            min_flutter_rad_per_s: None,
            min_critical_rad_per_s: None,
            max_rim_m_per_s: USUAL_MAX_RIM_M_PER_S,
            max_amplitude_m: None,
            max_deviation_m: None,
            accept_unusual: false,
        }
    }

    /// Unusual numbers of a scene and of these limits.
    pub fn unusual_numbers(&self, scene: &Scene) -> Vec<String> {
        let file = scene.file();
        let of_scene = scene.limits();
        let asked = [
            (
                "the operating speed",
                "operating_rpm",
                Some(self.operating_rad_per_s),
                scene.operating_rad_per_s(),
            ),
            (
                "the lower limit of the flutter speed",
                "sweep.to_rpm",
                self.min_flutter_rad_per_s,
                of_scene.min_flutter_rpm.map(rad_per_s),
            ),
            (
                "the lower limit of the first critical speed",
                "sweep.to_rpm",
                self.min_critical_rad_per_s,
                of_scene.min_critical_rpm.map(rad_per_s),
            ),
        ];
        // Those of the scene are among its own numbers.
        let of_limits = asked
            .into_iter()
            .filter(|(_, _, asked, of_scene)| asked != of_scene)
            .filter_map(|(label, path, asked, _)| unusual_number(file, label, path, rpm(asked?)));
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
