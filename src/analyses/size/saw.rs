//! A saw with another value of the number, and its distance from its limits.

use crate::analyses::check::{CheckError, CheckReport, Limits, check, of_analysis};
use crate::analyses::verdict::{Answer, Criterion};
use crate::model::scene::{Freed, Parameter, Scene, SceneError, SweepFile, rad_per_s, rpm};
use crate::modes::Cancellation;
use crate::stability::Analysis;

use super::SizeError;

/// A checked saw.
#[derive(Debug, Clone)]
pub struct SizedSaw {
    /// Value of the number.
    pub value: f64,
    /// The check; the reason for which the saw was refused, or could not be analysed.
    pub found: Result<CheckReport, String>,
}

/// The question to every saw.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    pub scene: &'a Scene,
    pub freed: &'a [Freed],
    /// Relative tolerance of the critical speeds; that of the scene if it is absent.
    pub tolerance: Option<f64>,
    /// Analysis of the saw over all values, where they are operating speeds; otherwise every value is another saw.
    pub swept: Option<&'a Analysis>,
    /// Whether bands are searched over the whole sweep, and not only as far as the limits require.
    pub is_whole: bool,
}

/// Distance that stands for a limit without one that is not kept, such as stability.
const BROKEN: f64 = -1.0;

impl Question<'_> {
    /// Checks the saw with a value of the number.
    ///
    /// # Errors
    /// [`SizeError`] if the computation was cancelled.
    pub fn ask(&self, value: f64) -> Result<SizedSaw, SizeError> {
        let found = self.scene_at(value).map_err(|error| error.to_string());
        let found = found.and_then(|scene| self.checked(&scene).map_err(|error| error.to_string()));
        Cancellation::current().check()?;
        Ok(SizedSaw { value, found })
    }

    fn checked(&self, scene: &Scene) -> Result<CheckReport, CheckError> {
        let rpm = scene.needed_operating_rpm(None).map_err(SceneError::from)?;
        let limits = Limits::of(scene, rpm).map_err(SceneError::from)?;
        if self.is_whole {
            return check(scene, &limits);
        }
        if let Some(analysis) = self.swept {
            return of_analysis(analysis, scene, &limits);
        }
        // A check goes on to the speeds that its limits require.
        let short = scene.edited(|file| {
            file.tolerance = self.tolerance.or(file.tolerance);
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: rpm,
            });
        });
        check(&short?, &limits)
    }

    /// The analysis of the saw from rest to an operating speed, and as far as its other limits require.
    ///
    /// # Errors
    /// [`CheckError`] if the saw cannot be analysed that far.
    pub fn analysed_to(&self, to_rpm: f64) -> Result<Analysis, CheckError> {
        let least = Limits {
            limits: self.scene.limits(),
            ..Limits::at(0.0)
        };
        let end = least.reach().end_rad_per_s.max(rad_per_s(to_rpm));
        let swept = self.scene.edited(|file| {
            file.tolerance = self.tolerance.or(file.tolerance);
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: rpm(end),
            });
        });
        Ok(Analysis::new(&swept?)?)
    }

    /// The scene with a value of the number.
    ///
    /// # Errors
    /// [`SceneError`] if it is refused.
    pub fn scene_at(&self, value: f64) -> Result<Scene, SceneError> {
        let numbers: Vec<(&Parameter, f64)> = self
            .freed
            .iter()
            .map(|freed| (&freed.parameter, value))
            .collect();
        self.scene.file().with(&numbers)
    }
}

impl SizedSaw {
    /// Whether all limits are kept.
    pub fn is_kept(&self) -> bool {
        let found = self.found.as_ref();
        found.is_ok_and(|report| report.verdict.answer == Some(Answer::Yes))
    }

    /// Smallest distance from a limit, negative if one is not kept.
    pub fn margin(&self) -> f64 {
        let Ok(report) = &self.found else {
            return BROKEN;
        };
        let all = report.verdict.limits.iter().map(|criterion| {
            let broken = if criterion.is_kept() { 1.0 } else { BROKEN };
            margin(report, criterion).unwrap_or(broken)
        });
        all.fold(1.0, f64::min)
    }

    /// The limit that is broken most, in words.
    pub fn broken(&self) -> Option<String> {
        let report = match &self.found {
            Ok(report) => report,
            Err(reason) => return Some(reason.clone()),
        };
        let limits = report.verdict.limits.iter();
        let broken = limits.filter(|criterion| !criterion.is_kept());
        let depth = |criterion: &Criterion| margin(report, criterion).unwrap_or(BROKEN);
        let worst = broken.min_by(|x, y| depth(x).total_cmp(&depth(y)))?;
        Some(format!("{}: {}", worst.name, worst.finding))
    }
}

/// Distance from a limit relative to it; `None` for a limit that is kept or not without a number.
pub fn margin(report: &CheckReport, criterion: &Criterion) -> Option<f64> {
    match criterion.key.as_str() {
        "max_deviation" => {
            let found = report.deviation.as_ref()?.deflection_m?;
            let limit = report.limits.max_deviation_m?;
            Some(limit / found - 1.0)
        }
        _ => criterion.distance(),
    }
}
