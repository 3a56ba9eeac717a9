//! The number to be sized, and the limits.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{SizeError, SizeReport, size};
use crate::analyses::check;
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::{Freed, NamedBounds, RefusedValue, Scene, SceneFile};

/// Finds the values of a number of the scene with which the saw keeps all its limits at its operating speed: how thick,
/// how stiff, how tight, how fast?
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// The number, by its path in the scene, with or without bounds; `guides[*]` are all guides at once.
    #[schemars(extend("x-kind" = "bounds"))]
    pub vary: Vec<NamedBounds>,
    /// Number of saws between the bounds among which ranges are searched.
    pub points: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            vary: Vec::new(),
            points: 17,
        }
    }
}

/// Smallest and largest number of saws between the bounds.
const POINTS: (usize, usize) = (3, 1000);

impl Options {
    /// The number with its bounds.
    ///
    /// # Errors
    /// [`CommandError`] if there is none or several, or the scene has no such number.
    fn freed(&self, scene: &Scene) -> Result<Vec<Freed>, CommandError> {
        if !(POINTS.0..=POINTS.1).contains(&self.points) {
            let allowed = format!("from {} to {}", POINTS.0, POINTS.1);
            let remedy = "17 is usual";
            return Err(RefusedValue::new("points", self.points, allowed, remedy).into());
        }
        let [(path, bounds)] = self.vary.as_slice() else {
            let given = match self.vary.len() {
                0 => "missing".to_owned(),
                count => format!("{count} numbers"),
            };
            let allowed = "the path of one number of the scene";
            let remedy = "write it like blade.thickness_m or blade.thickness_m=1.8mm..3.2mm";
            return Err(RefusedValue::new("vary", given, allowed, remedy).into());
        };
        let paths = match path.split_once("[*]") {
            None => vec![path.clone()],
            Some((list, rest)) => (0..scene.file().guides.len())
                .map(|index| format!("{list}[{index}]{rest}"))
                .collect(),
        };
        let freed = |path: &String| match bounds {
            None => Freed::with_usual_bounds(scene, path),
            Some((from, to)) => Freed::new(scene.file(), path, *from, *to),
        };
        let all = paths.iter().map(freed).collect::<Result<Vec<_>, _>>()?;
        if all.is_empty() {
            let allowed = "given, with a guide";
            return Err(RefusedValue::missing("guides", allowed, "add one to the scene").into());
        }
        Ok(all)
    }
}

impl CommandOptions for Options {
    type Report = SizeReport;
    const COMMAND: &str = "size";
    const METHOD: &str = "size";
    const SETS: &[SceneNumber] = &[
        SceneNumber::new(
            "operating_rpm",
            "rpm",
            "operating_rpm",
            "Operating speed, in place of that of the scene",
        ),
        check::MARGIN,
        check::MIN_FLUTTER,
        SceneNumber::MIN_CRITICAL,
        check::MAX_RIM,
        check::MAX_AMPLITUDE,
        SceneNumber::MAX_DEVIATION,
        SceneNumber::FORCE,
    ];

    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<SizeReport, CommandError> {
        let freed = self.freed(scene)?;
        Ok(size(scene, &freed, self.points, progress)?)
    }

    fn resulting_scene(report: &SizeReport) -> Option<(&'static str, Option<&SceneFile>)> {
        let sized = report.answer.as_ref().map(|answer| &answer.scene);
        Some(("sized-scene.json", sized))
    }

    fn is_kept(report: &SizeReport) -> bool {
        !report.windows.is_empty()
    }
}

impl From<SizeError> for CommandError {
    fn from(error: SizeError) -> Self {
        match error {
            SizeError::Refused(refused) => refused.into(),
            SizeError::Check(error) => error.into(),
            SizeError::Spectrum(error) => error.into(),
        }
    }
}
