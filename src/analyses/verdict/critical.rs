//! Limits of a speed beside the critical speeds.

use super::criterion::{CRITICAL, MARGIN};
use super::words::{apart, near_critical};
use super::{Answer, Criterion, LimitSource};
use crate::model::scene::{LimitsFile, rpm};
use crate::page::text::shown;
use crate::stability::{CRITICAL_MARGIN, critical_at};

/// The distance of a speed from critical speeds, all in rad/s.
pub(crate) fn of_critical(critical_rad_per_s: &[f64], speed_rad_per_s: f64) -> Criterion {
    let percent = shown(100.0 * CRITICAL_MARGIN);
    let near = critical_at(critical_rad_per_s, speed_rad_per_s);
    let near_rpm = near.map(|place| rpm(critical_rad_per_s[place]));
    Criterion {
        key: CRITICAL.to_owned(),
        name: format!("no critical speed within {percent} %"),
        finding: near_rpm.map_or("none".to_owned(), near_critical),
        found_rpm: near_rpm,
        asked_rpm: rpm(speed_rad_per_s),
        source: LimitSource::Practice,
        answer: Answer::Yes,
    }
    .kept_if(near_rpm.is_none())
}

/// The ratio of a speed to the first critical speed.
pub(crate) fn of_margin(
    limits: &LimitsFile,
    first_rad_per_s: Option<&f64>,
    speed_rad_per_s: f64,
) -> Criterion {
    let margin = limits.margin();
    let asked = speed_rad_per_s / margin;
    let finding = match first_rad_per_s {
        None => "no critical speed was found".to_owned(),
        Some(critical) => {
            let [share, _] = apart(1e2 * speed_rad_per_s / critical, 1e2 * margin);
            format!(
                "{share} % of the first critical speed ({:.0} rpm)",
                rpm(*critical)
            )
        }
    };
    Criterion {
        key: MARGIN.to_owned(),
        name: format!("{} % rule", shown(1e2 * margin)),
        finding,
        found_rpm: first_rad_per_s.copied().map(rpm),
        asked_rpm: rpm(asked),
        source: source(limits.margin),
        answer: Answer::Yes,
    }
    .kept_if(first_rad_per_s.is_none_or(|found| *found >= asked))
}

/// Whose limit it is, if practice has one where the user sets none.
pub(super) fn source(of_user: Option<f64>) -> LimitSource {
    match of_user {
        Some(_) => LimitSource::User,
        None => LimitSource::Practice,
    }
}
