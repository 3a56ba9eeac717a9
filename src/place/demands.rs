//! What is wanted of a place, and how hard to look for it.

use crate::plate::Resolution;
use crate::scene::{RefusedValue, Scene, rad_per_s, speed_rad_per_s};

/// What is to be made large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// Onset of the first flutter band that reaches the scene's threshold.
    FlutterSpeed,
    /// Distance from the end of the last band below a speed to the onset of the first above it.
    StableWindow {
        /// The speed.
        around_rad_per_s: f64,
    },
}

impl Goal {
    /// The widest stable window around the operating speed of a scene.
    ///
    /// # Errors
    /// [`RefusedValue`] where the scene has no operating speed.
    pub fn window_of(scene: &Scene) -> Result<Self, RefusedValue> {
        let around_rad_per_s = rad_per_s(scene.needed_operating_rpm(None)?);
        Ok(Goal::StableWindow { around_rad_per_s })
    }
}

/// The goal of a placement, and the limit that it has to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demands {
    /// What is to be made large.
    pub goal: Goal,
    /// Lower limit of the first critical speed.
    pub min_critical_rad_per_s: Option<f64>,
}

impl Demands {
    /// A goal under a limit in rpm.
    ///
    /// # Errors
    /// [`RefusedValue`] where the limit is no speed.
    pub fn new(goal: Goal, min_critical_rpm: Option<f64>) -> Result<Self, RefusedValue> {
        let limit = min_critical_rpm.map(|rpm| speed_rad_per_s("min_critical_rpm", rpm));
        Ok(Demands {
            goal,
            min_critical_rad_per_s: limit.transpose()?,
        })
    }
}

impl Default for Demands {
    fn default() -> Self {
        Demands {
            goal: Goal::FlutterSpeed,
            min_critical_rad_per_s: None,
        }
    }
}

/// How many saws are tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Saws spread over the bounds at first.
    pub samples: usize,
    /// How many of the best of them, if apart, are refined.
    pub places: usize,
    /// Steps that each refinement may take: a saw, and as many of those around it as it takes to say what it is worth.
    pub refine: u64,
    /// Points of the map along each axis; 0 for none.
    pub map: usize,
    /// A basis instead of the one that the scene's tolerance asks for.
    pub resolution: Option<Resolution>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            samples: 64,
            places: 3,
            refine: 60,
            map: 17,
            resolution: None,
        }
    }
}

/// A search of this many saws takes a day.
const MAX_SAMPLES: usize = 100_000;
/// A map of this many points along each axis is finer than it is drawn.
const MAX_MAP: usize = 400;

impl Options {
    /// The same, if a search can have them.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option that no search can have.
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
        Ok(self)
    }
}
