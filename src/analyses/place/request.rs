//! Goal, limits, tolerances and extent of a placement as options of the command.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::memory::PLACED;
use super::{Demands, GapDemands, Options, PlaceError, PlaceReport, Tolerances, place};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::{Freed, NamedBounds, Scene, SceneFile};

/// Finds the place of the guides with the highest flutter speed. This takes minutes.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Request {
    /// Number to vary, or several, by its path in the scene, with or without bounds; by default radius, angle and stiffness
    /// of the first guide.
    #[schemars(extend("x-kind" = "bounds"))]
    pub free: Vec<NamedBounds>,
    /// Quantity to maximize: the flutter speed, or the stable window around the operating speed.
    pub goal: GoalName,
    /// Amplitude at guides with a gap, with whose mean stiffness bands and critical speeds are computed; by default guides
    /// have their full stiffness.
    pub amplitude_m: Option<f64>,
    /// Saws in the first sampling of the bounds.
    pub samples: usize,
    /// Steps of the refinement of each of the best places, each a saw and those around it.
    pub refine: u64,
    /// Points of the map along each axis; 0 for no map.
    pub map: usize,
    /// Manufacturing tolerance of radii; a saw is rated by the worst of its neighbours within the tolerances.
    pub radius_tolerance_m: f64,
    /// Tolerance of angles.
    pub angle_tolerance_deg: f64,
    /// Tolerance of the stiffness, damping or gap of a guide, as a share of it.
    pub guide_tolerance_share: f64,
    /// Tolerance of other numbers, as a share of each.
    pub other_tolerance_share: f64,
    /// Folder in which the saws are kept, so that a stopped search goes on with them; set by the command line.
    #[serde(skip)]
    pub folder: Option<PathBuf>,
}

/// Quantity to maximize.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GoalName {
    /// The flutter speed.
    #[default]
    Flutter,
    /// The stable window around the operating speed.
    Window,
}

impl Default for Request {
    fn default() -> Self {
        let options = Options::default();
        Request {
            free: Vec::new(),
            goal: GoalName::Flutter,
            amplitude_m: None,
            samples: options.samples,
            refine: options.refine,
            map: options.map,
            radius_tolerance_m: options.tolerances.radius_m,
            angle_tolerance_deg: options.tolerances.angle_deg,
            guide_tolerance_share: options.tolerances.guide_share,
            other_tolerance_share: options.tolerances.other_share,
            folder: None,
        }
    }
}

impl CommandOptions for Request {
    type Report = PlaceReport;
    const COMMAND: &str = "place";
    const METHOD: &str = "place";
    const SETS: &[SceneNumber] = &[
        SceneNumber::MIN_CRITICAL,
        SceneNumber::MAX_DEVIATION,
        SceneNumber {
            requires: Some("max_deviation_m"),
            ..SceneNumber::FORCE
        },
    ];

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<PlaceReport, CommandError> {
        let around_rpm = match self.goal {
            GoalName::Flutter => None,
            GoalName::Window => Some(scene.needed_operating_rpm(None)?),
        };
        let demands = Demands {
            gap: GapDemands::new(scene, self.amplitude_m)?,
            ..Demands::new(around_rpm, scene.limits().min_critical_rpm)?
        };
        let options = Options {
            samples: self.samples,
            refine: self.refine.max(1),
            map: self.map,
            tolerances: Tolerances {
                radius_m: self.radius_tolerance_m,
                angle_deg: self.angle_tolerance_deg,
                guide_share: self.guide_tolerance_share,
                other_share: self.other_tolerance_share,
            },
            folder: self.folder.clone(),
            ..Options::default()
        }
        .checked()?;
        let freed = Freed::to_place(scene, &self.free)?;
        Ok(place(scene, &freed, &demands, &options, progress)?)
    }

    fn keep_in(&mut self, folder: &Path) {
        self.folder = Some(folder.to_owned());
    }

    /// A saw that misses a limit is no result to go on with.
    fn resulting_scene(report: &PlaceReport) -> Option<(&'static str, Option<&SceneFile>)> {
        Some((PLACED, report.kept.then_some(&report.scene)))
    }

    fn is_kept(report: &PlaceReport) -> bool {
        report.kept
    }
}

impl From<PlaceError> for CommandError {
    fn from(error: PlaceError) -> Self {
        match error {
            PlaceError::Scene(source) => source.into(),
            PlaceError::Gap(source) => source.into(),
            PlaceError::Analysis(source) => source.into(),
            PlaceError::Spectrum(source) => source.into(),
            other => CommandError::unanswered(other),
        }
    }
}
