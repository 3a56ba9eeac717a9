//! One limit, and whether it is kept.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Answer;

/// Who demands that a limit is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LimitSource {
    /// No motion may grow.
    Stability,
    /// A rule of practice, or the range of the model.
    Practice,
    /// The scene, or an option.
    User,
}

/// One limit and its result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CriterionEntry")]
pub struct Criterion {
    /// Short name of the limit, for programs.
    pub key: String,
    /// Requirement in words.
    pub name: String,
    /// Result in words.
    pub finding: String,
    /// Speed that was found: the critical or flutter speed itself, or the speed above which another limit is
    /// exceeded; null if it exceeds the sweep.
    pub found_rpm: Option<f64>,
    /// Speed with which the found one is compared.
    pub asked_rpm: f64,
    /// Who demands it.
    pub source: LimitSource,
    /// Yes if the limit is kept; no if a motion grows or a limit of the user is not kept; otherwise at risk.
    pub answer: Answer,
}

impl Criterion {
    /// Whether the limit is kept.
    pub fn is_kept(&self) -> bool {
        self.answer == Answer::Yes
    }

    /// Distance of the found speed from the asked one relative to it, negative if the limit is not kept; `None` for a limit of
    /// another kind, and where the found speed exceeds the sweep.
    pub(crate) fn distance(&self) -> Option<f64> {
        match self.key.as_str() {
            MARGIN | "min_critical" | "min_flutter" | "rim_speed" => {
                Some(self.found_rpm? / self.asked_rpm - 1.0)
            }
            _ => None,
        }
    }

    /// The criterion with the answer that follows from whether it is kept.
    pub(crate) fn kept_if(self, is_kept: bool) -> Self {
        let broken = match self.source {
            LimitSource::Practice => Answer::AtRisk,
            LimitSource::Stability | LimitSource::User => Answer::No,
        };
        Criterion {
            answer: if is_kept { Answer::Yes } else { broken },
            ..self
        }
    }

    /// The criterion that decides: the first of those with the worst answer; `None` if all are kept.
    pub(super) fn deciding(limits: &[Criterion]) -> Option<&Criterion> {
        let worst = limits.iter().map(|criterion| criterion.answer).max();
        let mut broken = limits.iter().filter(|criterion| !criterion.is_kept());
        broken.find(|criterion| Some(criterion.answer) == worst)
    }

    /// The result as the reason of a verdict.
    pub(crate) fn in_words(&self) -> String {
        match self.key.as_str() {
            // Their results say what they are compared with.
            STABILITY | CRITICAL | MARGIN => self.finding.clone(),
            _ => format!("{}: {}", self.name, self.finding),
        }
    }
}

/// Key of the criterion that no motion grows.
pub(crate) const STABILITY: &str = "operating";
/// Key of the distance from critical speeds.
pub(crate) const CRITICAL: &str = "critical";
/// Key of the ratio to the first critical speed.
pub(crate) const MARGIN: &str = "margin";
