//! What is known of a saw, and the limits by which it is judged.

use super::criterion::STABILITY;
use super::critical::{of_critical, of_margin, source};
use super::words::{apart, by_floquet, too_close, typed_rpm};
use super::{Answer, Criterion, LimitSource};
use crate::model::scene::{Accuracy, LimitsFile, rad_per_s, rpm};
use crate::page::text::shown_to;
use crate::stability::{Evidence, InstabilityKind, ListedBand, StabilityState};

/// A saw before its verdict.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Judge<'a> {
    /// Critical speeds and bands.
    pub found: &'a Evidence<'a>,
    /// Limits of the saw.
    pub limits: &'a LimitsFile,
    /// Radius of the rim.
    pub rim_radius_m: f64,
    /// Whether something holds every rigid motion of the blade.
    pub is_held: bool,
    /// Accuracy with which critical speeds and bands were computed.
    pub accuracy: Accuracy,
}

impl Judge<'_> {
    /// Every limit at a speed that follows from critical speeds and bands.
    pub fn criteria(&self, speed_rad_per_s: f64) -> Vec<Criterion> {
        let mut criteria = vec![self.of_stability(speed_rad_per_s)];
        let critical = self.found.critical_rad_per_s;
        criteria.push(of_critical(critical, speed_rad_per_s));
        criteria.push(of_margin(self.limits, critical.first(), speed_rad_per_s));
        criteria.extend(self.of_all_speeds());
        criteria.push(self.of_rim(speed_rad_per_s));
        criteria.push(self.of_rigid_motions(speed_rad_per_s));
        criteria
    }

    /// Whether the blade has an equilibrium under a constant force at a speed, and away from critical speeds.
    pub fn has_equilibrium(&self, speed_rad_per_s: f64) -> bool {
        let verdict = self.found.verdict(speed_rad_per_s);
        self.is_held && verdict.state == StabilityState::Stable && verdict.critical.is_none()
    }

    /// Limits of the user that no operating speed changes.
    pub fn of_all_speeds(&self) -> Vec<Criterion> {
        let critical = self.limits.min_critical_rpm.map(|asked| {
            let lowest = self.found.critical_rad_per_s.first().copied().map(rpm);
            let nowhere = "no critical speed was found".to_owned();
            at_least(
                "min_critical",
                "first critical speed",
                asked,
                lowest,
                nowhere,
            )
        });
        let flutter = self
            .limits
            .min_flutter_rpm
            .map(|asked| self.of_flutter(asked));
        critical.into_iter().chain(flutter).collect()
    }

    /// No motion grows.
    fn of_stability(&self, speed_rad_per_s: f64) -> Criterion {
        let found = self.found;
        let verdict = found.verdict(speed_rad_per_s);
        let weak = || {
            let mut bands = found.bands.iter();
            bands.find(|band| {
                let mut felt = band.felt.iter();
                felt.any(|stretch| stretch.contains(speed_rad_per_s))
            })
        };
        let (answer, finding, from) = match (verdict.state, verdict.band, verdict.undecided) {
            (StabilityState::TooClose, _, Some(edge)) => {
                let why = too_close(rpm(edge.speed), edge.error.map(rpm), self.accuracy);
                (Answer::AtRisk, format!("too close to call: {why}"), None)
            }
            (StabilityState::NotDetermined, ..) => (Answer::AtRisk, SEARCH_FAILED.to_owned(), None),
            (StabilityState::NotCovered, ..) => {
                let words = match &verdict.floquet {
                    Some(found) => format!(
                        "not certain: by Floquet multipliers the growth of {} ± {} 1/s is too close to {} 1/s to call",
                        shown_to(3, found.growth_per_s),
                        shown_to(2, found.error_per_s),
                        self.found.threshold_per_s
                    ),
                    None => "unstable or not certain: slots pass guides, which the model does not cover at this speed".to_owned(),
                };
                (Answer::AtRisk, words, None)
            }
            (StabilityState::OutsideSweep, ..) => {
                let [from, to] = found.range_rad_per_s.ends().map(rpm);
                let words = format!(
                    "not known: the speeds from {from:.0} to {to:.0} rpm were analysed (`sweep`)"
                );
                (Answer::AtRisk, words, None)
            }
            (_, Some(index), _) if verdict.floquet.is_none() => {
                let band = &found.bands[index];
                (
                    Answer::No,
                    grows(band),
                    Some(rpm(band.range.from_rad_per_s)),
                )
            }
            (StabilityState::Flutter | StabilityState::Divergence, ..) => {
                let words = verdict.floquet.as_ref().map(by_floquet);
                let at = verdict.floquet.map(|growth| rpm(growth.speed_rad_per_s));
                (Answer::No, words.unwrap_or_default(), at)
            }
            _ => match weak().filter(|_| verdict.floquet.is_none()) {
                Some(band) => {
                    let threshold = found.threshold_per_s;
                    let words = format!("{}, less than {threshold} 1/s", grows(band));
                    (Answer::AtRisk, words, Some(rpm(band.range.from_rad_per_s)))
                }
                None => match &verdict.floquet {
                    Some(growth) if growth.is_felt(found.threshold_per_s) => {
                        let threshold = found.threshold_per_s;
                        let words = format!("{}, less than {threshold} 1/s", by_floquet(growth));
                        (Answer::AtRisk, words, Some(rpm(growth.speed_rad_per_s)))
                    }
                    Some(_) => (Answer::Yes, QUIET_BY_FLOQUET.to_owned(), None),
                    None => (Answer::Yes, "no motion grows".to_owned(), None),
                },
            },
        };
        Criterion {
            key: STABILITY.to_owned(),
            name: "no growing motion at the operating speed".to_owned(),
            finding,
            found_rpm: from,
            asked_rpm: rpm(speed_rad_per_s),
            source: LimitSource::Stability,
            answer,
        }
    }

    /// The stiffness against rigid motions of the blade, which no speed changes.
    fn of_rigid_motions(&self, speed_rad_per_s: f64) -> Criterion {
        let finding = if self.is_held {
            "every rigid motion of the blade is held"
        } else {
            FREE
        };
        Criterion {
            key: "held".to_owned(),
            name: "static stiffness".to_owned(),
            finding: finding.to_owned(),
            found_rpm: None,
            asked_rpm: rpm(speed_rad_per_s),
            source: LimitSource::Practice,
            answer: Answer::Yes,
        }
        .kept_if(self.is_held)
    }

    /// The lower limit of the flutter speed.
    fn of_flutter(&self, asked_rpm: f64) -> Criterion {
        let found = self.found;
        let flutter = found.bands.iter();
        let flutter = flutter.filter(|band| band.kind == InstabilityKind::Flutter);
        let onsets = flutter.filter_map(|band| Some(band.counted.first()?.from_rad_per_s));
        let end = rpm(found.range_rad_per_s.to_rad_per_s);
        let nowhere = format!("none up to {end:.0} rpm, where the search ends");
        let flutter_rpm = onsets.reduce(f64::min).map(rpm);
        let criterion = at_least(
            "min_flutter",
            "flutter speed",
            asked_rpm,
            flutter_rpm,
            nowhere,
        );
        if found.has_failed {
            return Criterion {
                finding: "not determined: the search for bands failed".to_owned(),
                found_rpm: None,
                answer: Answer::AtRisk,
                ..criterion
            };
        }
        if criterion.is_kept() && self.is_open_below(rad_per_s(asked_rpm)) {
            return Criterion {
                finding:
                    "not certain: slots pass guides, which the model does not cover up to this speed"
                        .to_owned(),
                answer: Answer::AtRisk,
                ..criterion
            };
        }
        criterion
    }

    /// Whether some speed below another one is not covered.
    fn is_open_below(&self, speed_rad_per_s: f64) -> bool {
        let mut open = self.found.not_covered.iter();
        open.any(|range| range.from_rad_per_s < speed_rad_per_s)
    }

    /// The rim speed, with the rotation speed at which the rim reaches its limit.
    fn of_rim(&self, speed_rad_per_s: f64) -> Criterion {
        let limit = self.limits.max_rim_m_per_s();
        let found = limit / self.rim_radius_m;
        let [now, most] = apart(speed_rad_per_s * self.rim_radius_m, limit);
        Criterion {
            key: "rim_speed".to_owned(),
            name: format!("rim speed of at most {most} m/s"),
            finding: format!("{now} m/s at {} rpm", typed_rpm(speed_rad_per_s)),
            found_rpm: Some(rpm(found)),
            asked_rpm: rpm(speed_rad_per_s),
            source: source(self.limits.max_rim_m_per_s),
            answer: Answer::Yes,
        }
        .kept_if(found >= speed_rad_per_s)
    }
}

/// Causes of a verdict that leave open whether a motion grows.
pub(crate) const OPEN_CAUSES: [&str; 4] = [
    "too_close",
    "not_determined",
    "not_covered",
    "outside_sweep",
];

/// The finding for a slotted saw beside guides of which no motion grows.
const QUIET_BY_FLOQUET: &str = "no motion grows while slots pass the guides, by Floquet multipliers at this speed and 1 % beside it";

pub(super) const FREE: &str = "nothing holds the blade's rigid motions";

pub(super) const SEARCH_FAILED: &str = "not determined: the search for bands failed; a shorter sweep or another accuracy may avoid this";

/// What grows in a band.
fn grows(band: &ListedBand) -> String {
    let [from, to] = band.range.ends().map(rpm);
    format!(
        "{} grows by up to {} 1/s from {from:.1} to {to:.1} rpm",
        band.kind,
        shown_to(3, band.peak_growth_per_s)
    )
}

/// A lower limit of a speed, set by the user. A speed that is not reached within the sweep exceeds every limit.
fn at_least(
    key: &str,
    name: &str,
    asked_rpm: f64,
    found_rpm: Option<f64>,
    nowhere: String,
) -> Criterion {
    let [found, asked] = apart(found_rpm.unwrap_or(asked_rpm), asked_rpm);
    Criterion {
        key: key.to_owned(),
        name: format!("{name} of at least {asked} rpm"),
        finding: found_rpm.map_or(nowhere, |_| format!("{found} rpm")),
        found_rpm,
        asked_rpm,
        source: LimitSource::User,
        answer: Answer::Yes,
    }
    .kept_if(found_rpm.is_none_or(|found| found >= asked_rpm))
}
