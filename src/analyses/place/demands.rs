//! The goal of a placement, its limits, and the extent of the search.

use std::path::PathBuf;

use super::Goal;
use crate::analyses::gap::{self, GapCase};
use crate::model::plate::Resolution;
use crate::model::scene::{
    Kind, Parameter, Quantity, RefusedValue, Scene, rad_per_s, speed_rad_per_s,
};
use crate::page::text::shown;

/// The goal of a placement, and its limits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Demands {
    /// Speed inside a window without instability, from the end of the last band below it to the onset of the first
    /// above it, whose width is maximized; without it, the flutter speed is.
    pub around_rad_per_s: Option<f64>,
    /// Lower limit of the first critical speed.
    pub min_critical_rad_per_s: Option<f64>,
    /// Limit of the deflection, and amplitude, for guides with a gap.
    pub gap: Option<GapDemands>,
}

/// Limit of the deflection of a saw whose guides have a gap, and the amplitude for their mean stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapDemands {
    pub(crate) case: GapCase,
    /// Upper limit of the deflection at the cut.
    pub(crate) max_deflection_m: Option<f64>,
}

impl GapDemands {
    /// Demands that bands and critical speeds are those with the mean stiffness of the guides over an oscillation of an
    /// amplitude, and that the deflection at the cut under the side force of the scene at the operating speed keeps the scene's limit;
    /// `None` without an amplitude, if the scene has no guide with a gap or no limit.
    ///
    /// # Errors
    /// [`RefusedValue`] if no guide is one-sided, or a number is invalid.
    pub fn new(scene: &Scene, amplitude_m: Option<f64>) -> Result<Option<Self>, RefusedValue> {
        let max_deviation_m = scene.limits().max_deviation_m;
        let is_limited = max_deviation_m.is_some() && scene.file().has_gaps();
        if amplitude_m.is_none() && !is_limited {
            return Ok(None);
        }
        Ok(Some(GapDemands {
            case: GapCase::new(scene, &gap::Options::default(), amplitude_m)?,
            max_deflection_m: max_deviation_m,
        }))
    }
}

impl Demands {
    /// The window around a speed in rpm as goal, or else the flutter speed, with a lower limit of the first critical
    /// speed in rpm.
    ///
    /// # Errors
    /// [`RefusedValue`] if the limit is not a valid speed.
    pub fn new(
        around_rpm: Option<f64>,
        min_critical_rpm: Option<f64>,
    ) -> Result<Self, RefusedValue> {
        let limit = min_critical_rpm.map(|rpm| speed_rad_per_s("min_critical_rpm", rpm));
        Ok(Demands {
            around_rad_per_s: around_rpm.map(rad_per_s),
            min_critical_rad_per_s: limit.transpose()?,
            gap: None,
        })
    }

    /// The quantity to maximize.
    pub fn goal(&self) -> Goal {
        match self.around_rad_per_s {
            None => Goal::FlutterSpeed,
            Some(_) => Goal::StableWindow,
        }
    }
}

/// Extent of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Number of initial samples.
    pub samples: usize,
    /// Number of samples, at a distance from each other, that are refined.
    pub places: usize,
    /// Number of steps of each refinement. A step computes a saw and those of its neighbours that are needed
    /// to find its worst case.
    pub refine: u64,
    /// Number of points of the map along each axis; the search draws no map if it is 0.
    pub map: usize,
    /// A basis to use instead of the one chosen by the tolerance of the scene.
    pub resolution: Option<Resolution>,
    /// Tolerances of production.
    pub tolerances: Tolerances,
    /// Folder in which the saws are kept, so that a stopped search goes on with them, and the best scene found so far.
    pub folder: Option<PathBuf>,
}

/// Tolerances of production, to either side of the nominal value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Tolerance of a radius.
    pub radius_m: f64,
    /// Tolerance of an angle.
    pub angle_deg: f64,
    /// Relative tolerance of the stiffness, damping or gap of a guide.
    pub guide_share: f64,
    /// Relative tolerance of other numbers.
    pub other_share: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Tolerances::USUAL
    }
}

impl Tolerances {
    /// Usual tolerances.
    pub const USUAL: Self = Tolerances {
        radius_m: 0.002,
        angle_deg: 1.0,
        guide_share: 0.1,
        other_share: 0.01,
    };

    /// Checks that production can achieve these tolerances.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the tolerance.
    pub fn checked(self) -> Result<Self, RefusedValue> {
        let all = [
            ("radius_tolerance_m", self.radius_m, 0.1, "0.002 is usual"),
            ("angle_tolerance_deg", self.angle_deg, 45.0, "1 is usual"),
            (
                "guide_tolerance_share",
                self.guide_share,
                0.9,
                "0.1 is usual",
            ),
            (
                "other_tolerance_share",
                self.other_share,
                0.5,
                "0.01 is usual",
            ),
        ];
        for (key, value, most, remedy) in all {
            if !(0.0..=most).contains(&value) {
                let allowed = format!("from 0 to {}", shown(most));
                return Err(RefusedValue::new(key, value, allowed, remedy));
            }
        }
        Ok(self)
    }

    /// The tolerance of a number with this value, in its unit.
    pub(crate) fn of(&self, parameter: &Parameter, value: f64) -> f64 {
        match Quantity::kind_of(parameter.path()) {
            Kind::GuideRadius | Kind::Radius => self.radius_m,
            Kind::Angle => self.angle_deg,
            Kind::Stiffness | Kind::Damping | Kind::Gap => self.guide_share * value,
            Kind::Count | Kind::Other => self.other_share * value.abs(),
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            samples: 64,
            places: 3,
            refine: 60,
            map: 0,
            resolution: None,
            tolerances: Tolerances::default(),
            folder: None,
        }
    }
}

/// Largest number of samples: with more a search takes longer than a day.
const MAX_SAMPLES: usize = 100_000;
/// Largest number of points along an axis of the map: a finer one exceeds the resolution of its picture.
const MAX_MAP: usize = 400;

impl Options {
    /// Checks that the options are within their ranges.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option.
    pub fn checked(self) -> Result<Self, RefusedValue> {
        if !(1..=MAX_SAMPLES).contains(&self.samples) {
            let allowed = format!("from 1 to {MAX_SAMPLES}");
            let remedy = "a hundred is usual";
            return Err(RefusedValue::new("samples", self.samples, allowed, remedy));
        }
        if self.map == 1 || self.map > MAX_MAP {
            let allowed = format!("0 or from 2 to {MAX_MAP}");
            let remedy = "17 is usual, 0 draws none";
            return Err(RefusedValue::new("map", self.map, allowed, remedy));
        }
        self.tolerances.checked()?;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_that_no_production_has_are_refused() {
        let usual = Tolerances::default();
        assert_eq!(usual.checked(), Ok(usual));
        for (tolerances, key) in [
            (
                Tolerances {
                    radius_m: -0.001,
                    ..usual
                },
                "radius_tolerance_m",
            ),
            (
                Tolerances {
                    angle_deg: f64::NAN,
                    ..usual
                },
                "angle_tolerance_deg",
            ),
            (
                Tolerances {
                    guide_share: 10.0,
                    ..usual
                },
                "guide_tolerance_share",
            ),
            (
                Tolerances {
                    other_share: 1.0,
                    ..usual
                },
                "other_tolerance_share",
            ),
        ] {
            let options = Options {
                tolerances,
                ..Options::default()
            };
            let error = options.checked().unwrap_err();
            assert_eq!(error.key, key);
            assert!(error.to_string().contains("from 0 to "), "{error}");
        }
    }
}
