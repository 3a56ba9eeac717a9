//! One saw of a study.

use std::panic::{AssertUnwindSafe, catch_unwind};

use serde::{Deserialize, Serialize};

use super::plan::Study;
use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::check::{Judged, Limits, of_deviation};
use crate::analyses::gap::{GapError, GapNumbers};
use crate::analyses::verdict::{Criterion, Judge};
use crate::model::scene::{Scene, SpeedRange, rad_per_s, rpm};
use crate::stability::{AnalysisError, CRITICAL_MARGIN, Evidence, ListedBand, Onsets};

/// A saw and its result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saw {
    /// Number in the study, from 0.
    pub index: usize,
    /// Values of the varying numbers, in the order of the study.
    pub values: Vec<f64>,
    /// Result of the saw.
    pub outcome: Outcome,
}

/// Result of a saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// The saw was analysed.
    Analysed(Found),
    /// The scene refuses these numbers, for this reason.
    Refused(String),
    /// The analysis failed, for this reason.
    Failed(String),
}

/// Speeds of a saw, and the limits that it keeps.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// First critical speed; `None` if the blade has none.
    pub first_critical_rpm: Option<f64>,
    /// Flutter speed; `None` if it exceeds the speeds of the study.
    pub flutter_rpm: Option<f64>,
    /// Onset of the first flutter band, including weak ones.
    pub first_merge_rpm: Option<f64>,
    /// Whether each limit is kept, in the order of the limits; empty without limits.
    pub kept: Vec<bool>,
    /// Numbers of guides with a gap: deflection at the cut in m, largest force of a pad in N, and, if the study has an
    /// amplitude, the first critical speed at this amplitude in rpm; empty if the study has no block `gap`.
    #[serde(default)]
    pub gap: Vec<Option<f64>>,
    /// Number of basis functions.
    pub functions: usize,
    /// Estimated relative error of the critical speeds.
    pub estimated_relative_error: f64,
    /// Number of speeds at which the Krein index disagrees; 0 is expected.
    pub krein_violations: usize,
    /// Critical speeds within the speeds of the study, and beyond them those of which the last speed is within 5 %,
    /// ascending; empty in a study that does not list bands.
    #[serde(default)]
    pub critical_rpm: Vec<f64>,
    /// Bands of instability by onset; empty in a study that does not list them.
    #[serde(default)]
    pub bands: Vec<InstabilityBand>,
}

/// Values of the column `status`.
pub(super) const STATUS: [&str; 3] = ["analysed", "refused", "failed"];

impl Outcome {
    /// A failure whose reason is shortened to one line.
    pub fn failed(reason: &str) -> Self {
        Outcome::Failed(one_line(reason))
    }

    /// Name of the variant in the tables.
    pub(super) fn status(&self) -> &'static str {
        match self {
            Outcome::Analysed(_) => STATUS[0],
            Outcome::Refused(_) => STATUS[1],
            Outcome::Failed(_) => STATUS[2],
        }
    }

    /// Reason for which the saw was not analysed; `None` if it was.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Outcome::Analysed(_) => None,
            Outcome::Refused(reason) | Outcome::Failed(reason) => Some(reason),
        }
    }
}

impl Found {
    /// Critical speeds, ascending, in rad/s: those listed, or the lowest one beyond the speeds of the study.
    pub(crate) fn critical_rad_per_s(&self) -> Vec<f64> {
        let listed = self.critical_rpm.iter().copied();
        let beyond = self
            .first_critical_rpm
            .filter(|_| self.critical_rpm.is_empty());
        listed.chain(beyond).map(rad_per_s).collect()
    }

    /// Whether every limit is kept; `None` without limits.
    pub fn passed(&self) -> Option<bool> {
        (!self.kept.is_empty()).then(|| self.kept.iter().all(|kept| *kept))
    }
}

impl Saw {
    /// The speeds, if the saw was analysed.
    pub fn found(&self) -> Option<&Found> {
        match &self.outcome {
            Outcome::Analysed(found) => Some(found),
            Outcome::Refused(_) | Outcome::Failed(_) => None,
        }
    }
}

impl Study {
    /// Analyses one saw. Every error becomes its result, so that it does not end the computation of other
    /// saws.
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

    /// Speeds of a saw over the speeds of the study, on a basis that is at least as large as that of the saw without
    /// deviations.
    ///
    /// # Errors
    /// [`GapError`] if the saw cannot be analysed.
    pub fn speeds(&self, scene: &Scene) -> Result<Found, GapError> {
        self.found(&scene.swept(SpeedRange::new(0.0, self.to_rad_per_s()))?)
    }

    /// Speeds of the saw without deviations, on a basis of its own: no other saw needs that of the study.
    ///
    /// # Errors
    /// [`GapError`] if the saw cannot be analysed.
    pub fn own_speeds(&self) -> Result<Found, GapError> {
        let scene = self
            .scene()
            .swept(SpeedRange::new(0.0, self.to_rad_per_s()))?;
        self.with_onsets(&scene, Onsets::new(&scene)?)
    }

    fn found(&self, scene: &Scene) -> Result<Found, GapError> {
        let onsets = match self.basis() {
            Some(basis) => Onsets::beside(scene, basis)?,
            None => Onsets::new(scene)?,
        };
        self.with_onsets(scene, onsets)
    }

    /// The limit of the deflection at the cut; `None` without one.
    fn deviation(
        &self,
        scene: &Scene,
        evidence: &Evidence<'_>,
        limits: &Limits,
        estimated_relative_error: Option<f64>,
    ) -> Option<Criterion> {
        limits.limits.max_deviation_m?;
        let speed_rad_per_s = limits.operating_rad_per_s;
        let own = evidence.verdict(speed_rad_per_s);
        let judged = Judged {
            speed_rad_per_s,
            state: own.state,
            critical_rad_per_s: own.critical.map(|place| evidence.critical_rad_per_s[place]),
            estimated_relative_error,
        };
        let basis = self.basis();
        let found = basis.map(|basis| BoardDeviation::of_judged(scene, basis, &judged));
        of_deviation(&limits.limits, rpm(speed_rad_per_s), found.as_ref())
    }

    fn with_onsets(&self, scene: &Scene, onsets: Onsets) -> Result<Found, GapError> {
        let certificate = &onsets.certificate;
        if certificate.has_failed() {
            return Err(GapError::from(AnalysisError::SearchFailed {
                contradicted: certificate.contradicted(),
                speeds: certificate.speeds_checked,
            }));
        }
        // Speeds of edges have at least the error of the critical speeds.
        let edge_error = Some(onsets.estimated_relative_error);
        let threshold_per_s = scene.flutter_threshold_per_s();
        let listed = onsets.instabilities.iter();
        let listed = listed.map(|band| ListedBand::new(band, threshold_per_s, edge_error));
        let evidence = Evidence {
            bands: listed.collect(),
            has_failed: false,
            critical_rad_per_s: &onsets.critical_rad_per_s,
            threshold_per_s,
            range_rad_per_s: SpeedRange::new(0.0, self.to_rad_per_s()),
            not_covered: scene
                .file()
                .not_covered(onsets.critical_rad_per_s.first().copied()),
            floquet: None,
        };
        let gap = match (self.gap(), self.basis()) {
            (Some(case), Some(basis)) => {
                let GapNumbers {
                    deflection_m,
                    largest_pad_force_n,
                    critical_at_amplitude_rpm,
                } = case.numbers(scene, basis)?;
                let mut numbers =
                    vec![deflection_m, largest_pad_force_n, critical_at_amplitude_rpm];
                numbers.truncate(self.gap_columns().len());
                numbers
            }
            _ => vec![None; self.gap_columns().len()],
        };
        let criteria = self.limits().map(|limits| {
            let judge = Judge {
                found: &evidence,
                limits: &limits.limits,
                rim_radius_m: scene.blade().outer_radius_m,
                is_held: !onsets.has_free_motions,
                accuracy: scene.accuracy(),
            };
            let operating = limits.operating_rad_per_s;
            let deviation = self.deviation(scene, &evidence, limits, edge_error);
            let criteria = judge.criteria(operating).into_iter();
            criteria.chain(deviation).collect::<Vec<_>>()
        });
        let (mut bands, mut critical_rpm) = (Vec::new(), Vec::new());
        if self.file().bands {
            let listed = onsets.instabilities.iter();
            bands.extend(listed.map(|band| InstabilityBand {
                estimated_relative_error: edge_error,
                ..InstabilityBand::new(band, threshold_per_s)
            }));
            let end = self.to_rad_per_s();
            let critical = onsets.critical_rad_per_s.iter();
            let near = critical.take_while(|speed| (1.0 - CRITICAL_MARGIN) * **speed <= end);
            critical_rpm.extend(near.map(|speed| rpm(*speed)));
        }
        Ok(Found {
            critical_rpm,
            bands,
            first_critical_rpm: onsets.first_critical_rad_per_s.map(rpm),
            flutter_rpm: onsets.flutter_speed_rad_per_s.map(rpm),
            first_merge_rpm: onsets.first_merge_rad_per_s.map(rpm),
            kept: criteria.iter().flatten().map(Criterion::is_kept).collect(),
            gap,
            functions: onsets.functions,
            estimated_relative_error: onsets.estimated_relative_error,
            krein_violations: certificate.contradicted(),
        })
    }
}

/// Replaces line ends by spaces, because a row of the log is a single line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::study::StudyFile;
    use crate::model::scene::Accuracy;

    /// Bands that contradict the eigenvalues are neither listed nor counted, and the saw has a reason.
    #[test]
    fn a_saw_whose_search_failed_is_not_judged_by_its_bands() {
        let text = r#"{ "name": "failed", "saws": 2, "bands": true, "parameters": [
            { "path": "blade.thickness_m", "distribution": { "kind": "uniform", "from": 2.7e-3, "to": 2.9e-3 } } ] }"#;
        let scene = Scene::paper().edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            saw.sweep.as_mut().unwrap().to_rpm = 1500.0;
        });
        let file = StudyFile::from_json(text).unwrap();
        let study = Study::new(scene.unwrap(), file).unwrap();
        let onsets = || Onsets::new(study.scene()).unwrap();
        assert!(study.with_onsets(study.scene(), onsets()).is_ok());
        let mut failed = onsets();
        failed.certificate.speeds_checked = 40;
        failed.certificate.violations_rad_per_s = vec![100.0; 4];
        let found = study.with_onsets(study.scene(), failed);
        let reason = found.unwrap_err().to_string();
        assert!(reason.contains("at 4 of 40 speeds"), "{reason}");
    }
}
