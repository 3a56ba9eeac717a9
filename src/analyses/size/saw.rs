//! A saw with another value of the number, and its distance from its limits.

use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::check::{CheckError, CheckReport, Limits, Searched, check, required_range};
use crate::analyses::verdict::{Answer, Criterion, Verdict};
use crate::model::scene::{
    Freed, LimitsFile, Parameter, Scene, SceneError, SpeedRange, SweepFile, rad_per_s,
};
use crate::modes::Cancellation;
use crate::stability::Onsets;

use super::SizeError;

/// A judged saw.
#[derive(Debug, Clone)]
pub struct SizedSaw {
    /// Value of the number.
    pub value: f64,
    /// How it keeps its limits; the reason for which the saw was refused, or could not be analysed.
    pub found: Result<Judged, String>,
}

/// A saw at its operating speed.
#[derive(Debug, Clone)]
pub struct Judged {
    pub verdict: Verdict,
    pub limits: LimitsFile,
    /// The deflection at the cut, where the verdict depends on it.
    pub deviation: Option<BoardDeviation>,
}

/// The question to every saw.
#[derive(Debug, Clone, Copy)]
pub struct Question<'a> {
    pub scene: &'a Scene,
    pub freed: &'a [Freed],
    /// Relative tolerance of the critical speeds; that of the scene if it is absent.
    pub tolerance: Option<f64>,
    /// Critical speeds and bands of the saw over all values, where they are operating speeds; otherwise every value is another saw.
    pub swept: Option<&'a Swept>,
}

/// Critical speeds and bands of a saw from rest to the highest of several operating speeds, and as far as its other limits require.
#[derive(Debug)]
pub struct Swept {
    onsets: Onsets,
    range_rad_per_s: SpeedRange,
}

/// Distance that stands for a limit without one that is not kept, such as stability.
const BROKEN: f64 = -1.0;

impl Question<'_> {
    /// Judges the saw with a value of the number, by its critical speeds and bands where its limits need no more.
    ///
    /// # Errors
    /// [`SizeError`] if the computation was cancelled.
    pub fn ask(&self, value: f64) -> Result<SizedSaw, SizeError> {
        let found = self.scene_at(value).map_err(|error| error.to_string());
        let found = found.and_then(|scene| self.judged(&scene).map_err(|error| error.to_string()));
        Cancellation::current().check()?;
        Ok(SizedSaw { value, found })
    }

    fn judged(&self, scene: &Scene) -> Result<Judged, CheckError> {
        let limits = limits_of(scene)?;
        if let Some(swept) = self.swept {
            return Ok(swept.judged(scene, &limits));
        }
        if Searched::suffices(scene) {
            let swept = self.onsets(scene, &limits, limits.operating_rad_per_s)?;
            return Ok(swept.judged(scene, &limits));
        }
        Ok(self.short_check(scene)?.into())
    }

    /// Checks the saw with a value of the number, up to the speeds that its limits require, or over its whole sweep; `None` if it was
    /// refused.
    ///
    /// # Errors
    /// [`SizeError`] if the computation was cancelled.
    pub fn check(&self, value: f64, is_whole: bool) -> Result<Option<CheckReport>, SizeError> {
        let checked = |scene: Scene| {
            if is_whole {
                check(&scene, &limits_of(&scene)?)
            } else {
                self.short_check(&scene)
            }
        };
        let found = self.scene_at(value).ok();
        let found = found.and_then(|scene| checked(scene).ok());
        Cancellation::current().check()?;
        Ok(found)
    }

    fn short_check(&self, scene: &Scene) -> Result<CheckReport, CheckError> {
        // A check goes on to the speeds that its limits require.
        let short = scene.edited(|file| {
            file.tolerance = self.tolerance.or(file.tolerance);
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: file.operating_rpm.unwrap_or(0.0),
            });
        })?;
        check(&short, &limits_of(scene)?)
    }

    /// Critical speeds and bands of the saw of the scene up to a speed, and as far as its other limits require.
    ///
    /// # Errors
    /// [`CheckError`] if the saw cannot be analysed that far.
    pub fn swept_to(&self, to_rpm: f64) -> Result<Swept, CheckError> {
        let others = Limits {
            limits: self.scene.limits(),
            ..Limits::at(0.0)
        };
        let end = rad_per_s(to_rpm);
        let is_last = end > others.reach().end_rad_per_s;
        let found = self.onsets(self.scene, &others, end);
        found.map_err(|error| match error {
            CheckError::Analysis(error) if is_last => error.due_to("operating_rpm", 1.0).into(),
            other => other,
        })
    }

    fn onsets(
        &self,
        scene: &Scene,
        limits: &Limits,
        end_rad_per_s: f64,
    ) -> Result<Swept, CheckError> {
        let range_rad_per_s = required_range(scene, limits, end_rad_per_s)?;
        let scene = scene.edited(|file| file.tolerance = self.tolerance.or(file.tolerance))?;
        Ok(Swept {
            onsets: Onsets::new(&scene.swept(range_rad_per_s)?)?,
            range_rad_per_s,
        })
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

impl Swept {
    /// The saw at an operating speed.
    fn judged(&self, scene: &Scene, limits: &Limits) -> Judged {
        let Swept {
            onsets,
            range_rad_per_s,
        } = self;
        let searched = Searched {
            scene,
            basis: onsets.resolution,
            evidence: &onsets.evidence(scene, *range_rad_per_s),
            limits: &limits.limits,
            is_held: !onsets.has_free_motions,
            estimated_relative_error: onsets.estimated_relative_error,
        };
        let (verdict, deviation) = searched.judged(Some(limits.operating_rad_per_s));
        Judged {
            verdict,
            limits: limits.limits,
            deviation,
        }
    }
}

impl From<CheckReport> for Judged {
    fn from(report: CheckReport) -> Self {
        Judged {
            verdict: report.verdict,
            limits: report.limits,
            deviation: report.deviation,
        }
    }
}

/// The limits of a saw at its operating speed.
fn limits_of(scene: &Scene) -> Result<Limits, CheckError> {
    let rpm = scene.needed_operating_rpm(None).map_err(SceneError::from)?;
    Ok(Limits::of(scene, rpm).map_err(SceneError::from)?)
}

impl SizedSaw {
    /// Whether the saw can run; `None` if it was refused.
    pub fn answer(&self) -> Option<Answer> {
        self.found.as_ref().ok()?.verdict.answer
    }

    /// Whether all limits are kept.
    pub fn is_kept(&self) -> bool {
        self.answer() == Some(Answer::Yes)
    }

    /// Smallest distance from a limit, negative if one is not kept.
    pub fn margin(&self) -> f64 {
        let Ok(judged) = &self.found else {
            return BROKEN;
        };
        let all = judged.verdict.limits.iter().map(|criterion| {
            let broken = if criterion.is_kept() { 1.0 } else { BROKEN };
            judged.margin(criterion).unwrap_or(broken)
        });
        all.fold(1.0, f64::min)
    }

    /// The limit that is broken most, in words.
    pub fn broken(&self) -> Option<String> {
        let judged = match &self.found {
            Ok(judged) => judged,
            Err(reason) => return Some(reason.clone()),
        };
        let limits = judged.verdict.limits.iter();
        let broken = limits.filter(|criterion| !criterion.is_kept());
        let depth = |criterion: &Criterion| judged.margin(criterion).unwrap_or(BROKEN);
        let worst = broken.min_by(|x, y| depth(x).total_cmp(&depth(y)))?;
        Some(format!("{}: {}", worst.name, worst.finding))
    }
}

impl Judged {
    /// Distance from a limit relative to it; `None` for a limit that is kept or not without a number.
    pub fn margin(&self, criterion: &Criterion) -> Option<f64> {
        match criterion.key.as_str() {
            "max_deviation" => {
                let found = self.deviation.as_ref()?.deflection_m?;
                let limit = self.limits.max_deviation_m?;
                Some(limit / found - 1.0)
            }
            _ => criterion.distance(),
        }
    }
}
