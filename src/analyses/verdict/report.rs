//! The verdict of a report.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Answer, Criterion, FloquetEntry};
use crate::page::text::shown_to;

/// Whether a saw can run at its operating speed, and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VerdictEntry")]
pub struct Verdict {
    /// The answer: the worst of those of all limits; null without an operating speed.
    pub answer: Option<Answer>,
    /// Speed that is judged; null without an operating speed.
    pub rpm: Option<f64>,
    /// Short name of what decides: divergence, flutter, weak_flutter, too_close, not_determined, not_covered, outside_sweep, or the key of
    /// a limit; null if the answer is yes.
    pub cause: Option<String>,
    /// What decides, in words.
    pub reason: String,
    /// Highest speed up to which the answer is yes at every speed of the sweep from its start on; null if it is so at none.
    pub allowed_to_rpm: Option<f64>,
    /// What ends these speeds, in words; null without such speeds.
    pub allowed_by: Option<String>,
    /// All ranges of speed in the sweep with the answer yes.
    pub windows_rpm: Vec<[f64; 2]>,
    /// Every limit, with its result at the operating speed; empty without one.
    pub limits: Vec<Criterion>,
    /// Growth of a slotted saw beside guides, by Floquet multipliers; absent for other saws, without an operating speed, and for guides
    /// that they do not cover.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floquet: Option<FloquetEntry>,
}

impl Verdict {
    /// The verdict at one speed by its limits alone, the first of which is that no motion grows; nothing is known at other speeds.
    pub(crate) fn at_one_speed(rpm: f64, limits: Vec<Criterion>) -> Self {
        let decides = Criterion::deciding(&limits);
        let of_motion = limits.first().map(|criterion| criterion.finding.clone());
        Verdict {
            answer: limits.iter().map(|criterion| criterion.answer).max(),
            rpm: Some(rpm),
            cause: decides.map(|criterion| criterion.key.clone()),
            reason: decides.map_or(of_motion.unwrap_or_default(), Criterion::in_words),
            allowed_to_rpm: None,
            allowed_by: None,
            windows_rpm: Vec::new(),
            limits,
            floquet: None,
        }
    }

    /// The question and its answer: "Can it run at 2400 rpm? AT RISK: 91 % of the first critical speed (2632 rpm); run it up to 2237 rpm
    /// (85 % of the first critical speed)".
    pub fn headline(&self) -> String {
        let line = self.in_one_line();
        match self.answer.zip(self.rpm) {
            Some((answer, rpm)) => {
                let word = answer.in_words().to_uppercase();
                format!("Can it run at {} rpm? {word}: {line}", shown_to(6, rpm))
            }
            None => line,
        }
    }

    /// What decides, and the speeds that are allowed.
    pub fn in_one_line(&self) -> String {
        let reason = &self.reason;
        match (self.allowed(), self.answer) {
            (Some(allowed), None) => format!("It can run up to {allowed}"),
            (None, None) => format!("No speed is safe: {reason}"),
            (None, Some(_)) => reason.clone(),
            (Some(allowed), Some(Answer::Yes)) => format!("{reason}; it can run up to {allowed}"),
            (Some(allowed), Some(_)) => format!("{reason}; run it up to {allowed}"),
        }
    }

    /// The highest speed, rounded down so that it is allowed, and what ends it: "2237 rpm (85 % of the first critical speed)".
    fn allowed(&self) -> Option<String> {
        let rpm = self.allowed_to_rpm?;
        let by = self.allowed_by.as_deref()?;
        let decimals = if rpm < 100.0 { 1 } else { 0 };
        let unit = 10_f64.powi(decimals);
        let floor = (rpm * unit * (1.0 + 1e-12)).floor() / unit;
        Some(format!("{floor} rpm ({by})"))
    }

    /// The answer for a table: "at risk, margin"; a dash without an operating speed.
    pub fn in_table(&self) -> String {
        match (self.answer, &self.cause) {
            (None, _) => "-".to_owned(),
            (Some(answer), None) => answer.in_words().to_owned(),
            (Some(answer), Some(cause)) => {
                format!("{}, {}", answer.in_words(), cause.replace('_', " "))
            }
        }
    }

    /// Limits that are not kept, the worst first, except the one that is the reason.
    pub fn other_reasons(&self) -> impl Iterator<Item = &Criterion> {
        let mut broken: Vec<&Criterion> = self.limits.iter().filter(|c| !c.is_kept()).collect();
        broken.sort_by_key(|criterion| std::cmp::Reverse(criterion.answer));
        broken.into_iter().skip(1)
    }
}
