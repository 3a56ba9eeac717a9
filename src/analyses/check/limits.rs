//! Limits that a saw has to keep.

use crate::model::scene::{
    LimitsFile, RefusedValue, Scene, rad_per_s, rpm, speed_rad_per_s, unusual_number,
};

/// Limits that a saw has to keep at an operating speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Operating speed.
    pub operating_rad_per_s: f64,
    /// The limits.
    pub limits: LimitsFile,
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
        Ok(Limits {
            limits: scene.limits(),
            ..Limits::at(speed_rad_per_s("operating_rpm", operating_rpm)?)
        })
    }

    /// The limits of practice at an operating speed.
    pub fn at(operating_rad_per_s: f64) -> Self {
        Limits {
            operating_rad_per_s,
            limits: LimitsFile::default(),
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
                Some(rpm(self.operating_rad_per_s)),
                scene.operating_rad_per_s().map(rpm),
            ),
            (
                "the lower limit of the flutter speed",
                "sweep.to_rpm",
                self.limits.min_flutter_rpm,
                of_scene.min_flutter_rpm,
            ),
            (
                "the lower limit of the first critical speed",
                "sweep.to_rpm",
                self.limits.min_critical_rpm,
                of_scene.min_critical_rpm,
            ),
        ];
        // Those of the scene are among its own numbers.
        let of_limits = asked
            .into_iter()
            .filter(|(_, _, asked, of_scene)| asked != of_scene)
            .filter_map(|(label, path, asked, _)| unusual_number(file, label, path, asked?));
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
            BEYOND / self.limits.margin(),
            Some(self.operating_rad_per_s),
        );
        let others = [
            reach(
                "min_flutter_rpm",
                BEYOND,
                self.limits.min_flutter_rpm.map(rad_per_s),
            ),
            reach(
                "min_critical_rpm",
                BEYOND,
                self.limits.min_critical_rpm.map(rad_per_s),
            ),
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
