//! Maps of a scene: over one number and the speed, or over two numbers.
//!
//! A [`Map`] is a grid of saws, which the engine of [`study`](crate::analyses::study) computes, logs and resumes; [`map()`]
//! computes all of them at once. Every saw lists its
//! bands, from which stable, divergence and flutter areas follow at any speed, and contours of its flutter speed and of its
//! first critical speed.
//!
//! ```
//! use sawflutter::analyses::map::{Options, Range, map};
//! use sawflutter::model::scene::{Accuracy, Scene};
//!
//! let scene = Scene::paper().edited(|saw| {
//!     saw.accuracy = Accuracy::Draft;
//!     saw.guides.clear();
//! })?;
//! let x = Range { path: "blade.thickness_m".into(), from: 0.0025, to: 0.0030 };
//! let options = Options { points: Some(3), ..Options::over(x) };
//! let saws = map(scene, &options, &|_, _| ())?.saws;
//! // The saw of the scene, of 2.8 mm, is one of the row.
//! assert_eq!(saws.len(), 4);
//! let rpm = |saw: usize| saws[saw].first_critical_rpm.unwrap();
//! // The critical speed of a blade without guides is proportional to its thickness.
//! assert!((rpm(3) / rpm(0) / 1.2 - 1.0).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
pub(crate) mod chart;
mod contour;
mod outline;
mod report;
mod saws;

pub(crate) use outline::outline;
pub use report::{Contour, Contoured, MapAxis, MapReport, MappedSaw};

use crate::analyses::study::{Study, StudyError, StudyFile};
use crate::model::scene::{RefusedValue, Scene, rpm, speed_rad_per_s};
use crate::modes::branches::Progress;
use crate::stability::end_of_sweep;

/// Numbers of points along an axis, of a map over the speed and of a map over two numbers, if none is given.
const USUAL_POINTS: [usize; 2] = [41, 17];
/// Range of the number of points along an axis.
const POINTS: (usize, usize) = (2, 401);

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

/// Options of a map.
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
    x: MapAxis,
    y: Option<MapAxis>,
    rpm: Option<f64>,
}

/// Analyses the saws of a map on all threads.
///
/// # Errors
/// [`StudyError`] that names the option, what is allowed and what to do.
pub fn map(
    scene: Scene,
    options: &Options,
    progress: Progress<'_>,
) -> Result<MapReport, StudyError> {
    let map = Map::new(scene, options)?;
    let count = map.study.count();
    let saws = map.study.saws(&|done| progress(done.len(), count));
    Ok(map.report(&saws))
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
        let axis = |key, range| MapAxis::new(&scene, key, range, points);
        let x = axis("x", &options.x)?;
        // The saw of the scene is one of the row.
        let x = if options.y.is_none() {
            x.with_scene()
        } else {
            x
        };
        let y = options
            .y
            .as_ref()
            .map(|range| axis("y", range))
            .transpose()?;
        if y.as_ref().is_some_and(|y| y.path == x.path) {
            let given = format!("{} again", x.path);
            let remedy = "leave it out for a map over the speed";
            return Err(RefusedValue::new("y", given, "another number than x", remedy).into());
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
            parameters: y.iter().chain([&x]).map(MapAxis::grid).collect(),
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
}

#[cfg(test)]
mod tests;
