//! The number to be sized, and the limits.

use schemars::JsonSchema;
use serde::Deserialize;

use super::each::Each;
use super::{SizeError, SizeReport, ranges, size};
use crate::analyses::check;
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::{Freed, NamedBounds, NamedValues, RefusedValue, Scene, SceneFile, rpm};
use crate::stability::end_of_sweep;

/// Finds the values of a number of the scene with which the saw keeps all its limits at its operating speed: how thick,
/// how stiff, how tight, how fast?
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// The number, by its path in the scene, with or without bounds; `guides[*]` are all guides at once.
    #[schemars(extend("x-kind" = "bounds"))]
    pub vary: Vec<NamedBounds>,
    /// Another number of the scene, with values, for each of which the ranges are found too.
    #[schemars(extend("x-kind" = "values", "x-option" = "for"))]
    pub each: Vec<NamedValues>,
    /// Number of saws between the bounds among which ranges are searched.
    pub points: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            vary: Vec::new(),
            each: Vec::new(),
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
        let paths = paths_of(scene, path);
        let freed = |path: &String| match bounds {
            None if path == SPEED => of_sweep(scene),
            None => Ok(Freed::with_usual_bounds(scene, path)?),
            Some((from, to)) => Ok(Freed::new(scene.file(), path, *from, *to)?),
        };
        let all = paths
            .iter()
            .map(freed)
            .collect::<Result<Vec<_>, CommandError>>()?;
        if all.is_empty() {
            let allowed = "given, with a guide";
            return Err(RefusedValue::missing("guides", allowed, "add one to the scene").into());
        }
        Ok(all)
    }

    /// The saws with other values of another number; `None` if none is asked for.
    ///
    /// # Errors
    /// [`CommandError`] if there are several, the scene has no such number, or refuses a value.
    fn each(&self, scene: &Scene, freed: &[Freed]) -> Result<Option<Each>, CommandError> {
        let named = match self.each.as_slice() {
            [] => return Ok(None),
            [named] => named,
            several => {
                let given = format!("{} numbers", several.len());
                let remedy = "name one, with all its values";
                return Err(RefusedValue::new("each", given, "one number", remedy).into());
            }
        };
        let paths = paths_of(scene, &named.0);
        if freed
            .iter()
            .any(|freed| paths.iter().any(|path| path == freed.parameter.path()))
        {
            let given = format!("{} again", named.0);
            let remedy = "name another one than that which varies";
            return Err(RefusedValue::new("each", given, "another number", remedy).into());
        }
        Ok(Some(Each::new(scene, &paths, named)?))
    }
}

/// Path of the operating speed.
const SPEED: &str = "operating_rpm";
/// Lowest operating speed that is tried without bounds, as a share of the end of the sweep: the scale is linear.
const SLOWEST: f64 = 0.12;

/// The operating speed over the sweep, because it matters at which speeds the saw can run, and not how far from its own.
///
/// # Errors
/// [`CommandError`] if the scene has none, or the end of its sweep is unknown.
fn of_sweep(scene: &Scene) -> Result<Freed, CommandError> {
    let end = end_of_sweep(scene).map_err(CommandError::failed)?;
    Ok(Freed::new(
        scene.file(),
        SPEED,
        SLOWEST * rpm(end),
        rpm(end),
    )?)
}

/// The path of a number, or of that of every guide: `guides[*].gap_m`.
fn paths_of(scene: &Scene, path: &str) -> Vec<String> {
    match path.split_once("[*]") {
        None => vec![path.to_owned()],
        Some((list, rest)) => (0..scene.file().guides.len())
            .map(|index| format!("{list}[{index}]{rest}"))
            .collect(),
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
        let each = self.each(scene, &freed)?;
        let mut found = size(scene, &freed, self.points, progress)?;
        if let Some(each) = each {
            each.beside(&mut found, |scene| {
                let freed = self.freed(scene)?;
                Ok::<_, CommandError>(ranges(scene, &freed, self.points, progress)?)
            })?;
        }
        Ok(found)
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
