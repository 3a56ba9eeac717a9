//! One saw of a study.

use std::panic::{AssertUnwindSafe, catch_unwind};

use serde::{Deserialize, Serialize};

use super::plan::Study;
use crate::scene::{Scene, rpm};
use crate::stability::{AnalysisError, Evidence, Onsets};

/// A saw and what became of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saw {
    /// Its number in the study, from 0.
    pub index: usize,
    /// The numbers that vary, in the order of the study.
    pub values: Vec<f64>,
    /// What was found.
    pub outcome: Outcome,
}

/// What became of a saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// It was analysed.
    Analysed(Found),
    /// No saw can have these numbers, for this reason.
    Refused(String),
    /// It could not be analysed, for this reason.
    Failed(String),
}

/// Speeds of a saw, and whether it keeps its limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Lowest critical speed; none where no wave has one.
    pub lowest_critical_rpm: Option<f64>,
    /// Flutter speed; none within the speeds of the study.
    pub flutter_rpm: Option<f64>,
    /// Onset of the first flutter band of all, however slowly it grows.
    pub first_merge_rpm: Option<f64>,
    /// Which of the limits are kept, in their order; empty without limits.
    pub kept: Vec<bool>,
    /// Functions of the basis.
    pub functions: usize,
    /// Estimated relative error of the critical speeds.
    pub estimated_relative_error: f64,
    /// Speeds at which the Krein index did not match; expected 0.
    pub krein_violations: usize,
}

impl Outcome {
    /// It could not be analysed, for a reason of any length and number of lines.
    pub fn failed(reason: &str) -> Self {
        Outcome::Failed(one_line(reason))
    }
}

impl Found {
    /// Whether every limit is kept; `None` without limits.
    pub fn passed(&self) -> Option<bool> {
        (!self.kept.is_empty()).then(|| self.kept.iter().all(|kept| *kept))
    }
}

impl Saw {
    /// What was found, of a saw that was analysed.
    pub fn found(&self) -> Option<&Found> {
        match &self.outcome {
            Outcome::Analysed(found) => Some(found),
            Outcome::Refused(_) | Outcome::Failed(_) => None,
        }
    }
}

impl Study {
    /// Analyses one saw. Whatever goes wrong is its outcome: one saw of thousands must not
    /// take the others with it.
    pub fn saw(&self, index: usize) -> Saw {
        let values = self.values(index);
        let outcome = match self.scene_of(&values) {
            Err(error) => Outcome::Refused(one_line(&error.to_string())),
            Ok(scene) => match catch_unwind(AssertUnwindSafe(|| self.found(&scene))) {
                Ok(Ok(found)) => Outcome::Analysed(found),
                Ok(Err(error)) => Outcome::failed(&error.to_string()),
                Err(_) => Outcome::Failed("a fault of the program: please report this saw".into()),
            },
        };
        Saw {
            index,
            values,
            outcome,
        }
    }

    fn found(&self, scene: &Scene) -> Result<Found, AnalysisError> {
        let onsets = match self.basis() {
            Some(basis) => Onsets::beside(scene, basis)?,
            None => Onsets::new(scene)?,
        };
        let evidence = Evidence {
            bands: &onsets.instabilities,
            critical_rad_per_s: onsets.lowest_critical_rad_per_s.as_slice(),
            threshold_per_s: scene.flutter_threshold_per_s(),
            range_rad_per_s: (0.0, self.to_rad_per_s()),
        };
        let criteria = self.limits().map(|limits| limits.criteria(&evidence));
        Ok(Found {
            lowest_critical_rpm: onsets.lowest_critical_rad_per_s.map(rpm),
            flutter_rpm: onsets.flutter_speed_rad_per_s.map(rpm),
            first_merge_rpm: onsets.first_merge_rad_per_s.map(rpm),
            kept: criteria.iter().flatten().map(|c| c.passed).collect(),
            functions: onsets.functions,
            estimated_relative_error: onsets.estimated_relative_error,
            krein_violations: onsets.certificate.violations_rad_per_s.len()
                + onsets.certificate.mismatches.len(),
        })
    }
}

/// A row of a log is a line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
