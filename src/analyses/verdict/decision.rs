//! The verdict from the limits of a saw.

use super::allowed::allowed;
use super::criterion::{MARGIN, STABILITY};
use super::judge::{FREE, Judge, SEARCH_FAILED};
use super::{Criterion, FloquetEntry, Verdict};
use crate::model::scene::rpm;
use crate::stability::StabilityState;

impl Judge<'_> {
    /// The verdict at a speed in rad/s, with `further` limits that were evaluated elsewhere.
    pub fn verdict(&self, speed_rad_per_s: Option<f64>, further: Vec<Criterion>) -> Verdict {
        let own = speed_rad_per_s.map(|speed| self.criteria(speed));
        let limits: Vec<Criterion> = own.into_iter().flatten().chain(further).collect();
        let allowed = allowed(self, &limits);
        let answer = limits.iter().map(|criterion| criterion.answer).max();
        let decides = Criterion::deciding(&limits);
        Verdict {
            answer,
            rpm: speed_rad_per_s.map(rpm),
            cause: decides.map(|criterion| self.cause(criterion, speed_rad_per_s)),
            reason: match (decides, answer) {
                (Some(criterion), _) => criterion.in_words(),
                (None, Some(_)) => self.why_yes(&limits),
                (None, None) if self.found.has_failed => SEARCH_FAILED.to_owned(),
                (None, None) => {
                    let broken = self.of_all_speeds().into_iter().find(|c| !c.is_kept());
                    let unasked = || {
                        let reason = if self.is_held {
                            "the scene has no operating_rpm"
                        } else {
                            FREE
                        };
                        reason.to_owned()
                    };
                    broken.map_or_else(unasked, |criterion| criterion.in_words())
                }
            },
            allowed_to_rpm: allowed.first_end_rad_per_s.map(rpm),
            allowed_by: allowed.first_end_rad_per_s.and(allowed.ended_by),
            windows_rpm: allowed
                .windows_rad_per_s
                .iter()
                .map(|w| w.map(rpm))
                .collect(),
            limits,
            floquet: speed_rad_per_s.and_then(|speed| {
                let nearby = self.found.floquet.filter(|nearby| nearby.contains(speed));
                nearby.as_ref().map(FloquetEntry::new)
            }),
        }
    }

    /// Short name of what is not kept.
    fn cause(&self, criterion: &Criterion, speed_rad_per_s: Option<f64>) -> String {
        let state = speed_rad_per_s.map(|speed| self.found.verdict(speed).state);
        let cause = match state {
            Some(state) if criterion.key == STABILITY => match state {
                StabilityState::Stable => "weak_flutter",
                StabilityState::Divergence => "divergence",
                StabilityState::Flutter => "flutter",
                StabilityState::TooClose => "too_close",
                StabilityState::NotDetermined => "not_determined",
                StabilityState::NotCovered => "not_covered",
                StabilityState::OutsideSweep => "outside_sweep",
            },
            _ => &criterion.key,
        };
        cause.to_owned()
    }

    /// The reason of a yes: the ratio to the first critical speed, or that there is none.
    fn why_yes(&self, limits: &[Criterion]) -> String {
        let is_compared = !self.found.critical_rad_per_s.is_empty();
        let key = if is_compared { MARGIN } else { STABILITY };
        let shown = limits.iter().find(|criterion| criterion.key == key);
        shown.map_or(String::new(), |criterion| criterion.finding.clone())
    }
}
