//! Maps of a scene: over one number and the speed, or over two numbers.
//!
//! A [`Map`] is a grid of saws, which the engine of [`study`](crate::study) computes, logs and resumes. Every saw lists its
//! bands, from which stable, divergence and flutter areas follow at any speed, and contours of its flutter speed and of its
//! lowest critical speed.
//!
//! ```
//! use sawflutter::map::{Map, Options, Range};
//! use sawflutter::scene::{Accuracy, Scene};
//!
//! let scene = Scene::paper().edited(|saw| {
//!     saw.accuracy = Accuracy::Draft;
//!     saw.guides.clear();
//! })?;
//! let x = Range { path: "blade.thickness_m".into(), from: 0.0025, to: 0.0030 };
//! let map = Map::new(scene, &Options { points: Some(3), ..Options::over(x) })?;
//! let saws: Vec<_> = (0..map.study().count()).map(|index| map.study().saw(index)).collect();
//! let rpm = |saw: usize| saws[saw].found().unwrap().lowest_critical_rpm.unwrap();
//! // The critical speed of a blade without guides is proportional to its thickness.
//! assert!((rpm(2) / rpm(0) / 1.2 - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contour;

pub use contour::{Contour, contours};

use crate::scene::{Freed, RefusedValue, Scene, is_logarithmic, rpm, speed_rad_per_s};
use crate::stability::{StabilityState, end_of_sweep};
use crate::study::{DistributionFile, FoundBand, ParameterFile, Study, StudyError, StudyFile};
use crate::text::shown;

/// Numbers of points along an axis, of a map over the speed and of a map over two numbers, if none is given.
const USUAL_POINTS: [usize; 2] = [41, 17];
/// Range of the number of points along an axis.
const POINTS: (usize, usize) = (2, 401);

/// Path of the speed at which the saws are judged. It changes no band, and every saw is judged at the same one.
const OPERATING_SPEED: &str = "operating_rpm";

/// A number of the scene and the ends of its axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// JSON path in the scene.
    pub path: String,
    /// First value, in the unit of the path.
    pub from: f64,
    /// Last value.
    pub to: f64,
}

/// Options of [`Map::new`].
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The number along the horizontal axis.
    pub x: Range,
    /// The number along the vertical axis; without it, the vertical axis is the speed.
    pub y: Option<Range>,
    /// Number of points along each axis of a number; 41 over one number and 17 over two by default.
    pub points: Option<usize>,
    /// Speed at which the saws are judged; the operating speed by default.
    pub rpm: Option<f64>,
    /// Last speed; the end of the scene's sweep by default.
    pub to_rpm: Option<f64>,
}

impl Options {
    /// Options of a map over one number and the speed.
    pub fn over(x: Range) -> Self {
        Options {
            x,
            y: None,
            points: None,
            rpm: None,
            to_rpm: None,
        }
    }
}

/// A grid of saws over one or two numbers.
#[derive(Debug)]
pub struct Map {
    study: Study,
    x: Along,
    y: Option<Along>,
    rpm: Option<f64>,
}

/// A number along an axis of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Along {
    /// JSON path in the scene.
    pub path: String,
    /// Values, ascending; on a logarithmic scale if the last is at least ten times the first.
    pub values: Vec<f64>,
    /// Value in the scene.
    pub of_scene: f64,
}

impl Map {
    /// Plans the grid of a map.
    ///
    /// # Errors
    /// [`StudyError`] that names the option, what is allowed and what to do.
    pub fn new(scene: Scene, options: &Options) -> Result<Self, StudyError> {
        let usual = USUAL_POINTS[usize::from(options.y.is_some())];
        let points = options.points.unwrap_or(usual);
        if !(POINTS.0..=POINTS.1).contains(&points) {
            let allowed = format!("between {} and {}", POINTS.0, POINTS.1);
            let remedy = "every point is a saw, or a row of saws if there are two numbers";
            return Err(RefusedValue::new("points", points, allowed, remedy).into());
        }
        let x = Along::new(&scene, "x", &options.x, points)?;
        let y = options.y.as_ref();
        let y = y
            .map(|range| Along::new(&scene, "y", range, points))
            .transpose()?;
        if y.as_ref().is_some_and(|y| y.path == x.path) {
            let given = format!("{} again", x.path);
            let remedy = "leave it out for a map over the speed";
            return Err(RefusedValue::new("y", given, "another number than x", remedy).into());
        }
        for (key, along) in std::iter::once(("x", &x)).chain(y.as_ref().map(|y| ("y", y))) {
            if along.path == OPERATING_SPEED {
                let allowed = "a number that changes critical speeds or bands";
                let remedy =
                    "name another one; a map over one number has the speed as its vertical axis";
                return Err(RefusedValue::new(key, OPERATING_SPEED, allowed, remedy).into());
            }
        }
        if let Some(asked) = options.rpm {
            speed_rad_per_s("rpm", asked)?;
        }
        let speed = options.rpm.or(scene.file().operating_rpm);
        let end = match options.to_rpm {
            Some(to) => {
                speed_rad_per_s("to_rpm", to)?;
                to
            }
            None => rpm(end_of_sweep(&scene)?),
        };
        let file = StudyFile {
            name: format!("Map of {}", scene.file().name),
            notes: Vec::new(),
            // The last parameter varies fastest, so that the saws are rows along x.
            parameters: y.iter().chain([&x]).map(Along::grid).collect(),
            saws: None,
            seed: 0,
            to_rpm: Some(end.max(speed.unwrap_or(0.0))),
            limits: None,
            quantiles: vec![0.5],
            confidence: 0.95,
            bands: true,
            gap: None,
        };
        Ok(Map {
            study: Study::new(scene, file)?,
            x,
            y,
            rpm: speed,
        })
    }

    /// The saws, row by row: `x` varies fastest.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// The number along the horizontal axis.
    pub fn x(&self) -> &Along {
        &self.x
    }

    /// The number along the vertical axis; `None` if that is the speed.
    pub fn y(&self) -> Option<&Along> {
        self.y.as_ref()
    }

    /// Speed at which the saws are judged; `None` if neither the options nor the scene have one.
    pub fn rpm(&self) -> Option<f64> {
        self.rpm
    }
}

impl Along {
    fn new(scene: &Scene, key: &str, range: &Range, points: usize) -> Result<Self, StudyError> {
        let refused = |source| StudyError::Scene {
            key: key.to_owned(),
            source,
        };
        let freed = Freed::new(scene.file(), &range.path, range.from, range.to).map_err(refused)?;
        let value = |k: usize| match k {
            0 => range.from,
            _ if k + 1 == points => range.to,
            _ => rounded(freed.value(k as f64 / (points - 1) as f64)),
        };
        Ok(Along {
            path: range.path.clone(),
            values: (0..points).map(value).collect(),
            of_scene: freed.parameter.get(scene.file()).map_err(refused)?,
        })
    }

    /// The value at a place of the grid, counted in points from 0, between two points on the scale of the axis.
    pub fn at(&self, place: f64) -> f64 {
        let last = self.values.len() - 1;
        let below = (place.max(0.0) as usize).min(last.saturating_sub(1));
        let (from, to) = (self.values[below], self.values[(below + 1).min(last)]);
        let share = place - below as f64;
        match self.is_logarithmic() {
            true => from * (to / from).powf(share),
            false => from + share * (to - from),
        }
    }

    fn is_logarithmic(&self) -> bool {
        let (first, last) = (self.values[0], self.values[self.values.len() - 1]);
        is_logarithmic(first, last)
    }

    fn grid(&self) -> ParameterFile {
        ParameterFile {
            path: self.path.clone(),
            distribution: DistributionFile::Grid {
                values: self.values.clone(),
            },
        }
    }
}

/// Rounds a number to the digits of a message, so that 0.66 is not 0.6599999999999999.
fn rounded(value: f64) -> f64 {
    shown(value).parse().unwrap_or(value)
}

/// Whether a saw with these bands is stable at a speed within its sweep, decided as [`Evidence::verdict`] does for an
/// analysis.
///
/// [`Evidence::verdict`]: crate::stability::Evidence::verdict
pub fn state_at(bands: &[FoundBand], rpm: f64) -> StabilityState {
    let around = |[from, to]: &[f64; 2]| (*from..=*to).contains(&rpm);
    let counted = bands
        .iter()
        .filter(|band| band.counted_rpm.iter().any(around));
    StabilityState::within(counted.map(|band| band.kind))
}

#[cfg(test)]
mod tests;
