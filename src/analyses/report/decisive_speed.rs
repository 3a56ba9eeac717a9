//! Critical speed and flutter speed, with their distance from the operating speed and what tolerances take of it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::{Report, Sensitivity};
use crate::analyses::place::Tolerances;
use crate::analyses::verdict::MARGIN;
use crate::model::scene::{Parameter, rpm};
use crate::stability::Onsets;

/// A speed that decides on a saw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DecidedSpeed {
    /// First critical speed.
    FirstCritical,
    /// Flutter speed.
    Flutter,
}

impl DecidedSpeed {
    /// The speed that a change of the saw should raise: the flutter speed if the saw breaks the 85 % rule and the effects of changes on
    /// it are known, else the first critical speed.
    pub(super) fn to_raise(report: &Report) -> Self {
        let mut limits = report.verdict.limits.iter();
        let breaks_rule = limits.any(|limit| limit.key == MARGIN && !limit.is_kept());
        let mut sensitivities = report.sensitivities.iter();
        let is_known = sensitivities.any(|by| DecidedSpeed::Flutter.percent(by).is_some());
        if breaks_rule && is_known {
            DecidedSpeed::Flutter
        } else {
            DecidedSpeed::FirstCritical
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            DecidedSpeed::FirstCritical => "first critical speed",
            DecidedSpeed::Flutter => "flutter speed",
        }
    }

    /// Its value in a diagram, in rpm; `None` if the sweep has none.
    pub(super) fn rpm(self, report: &Report) -> Option<f64> {
        match self {
            DecidedSpeed::FirstCritical => report.critical_speeds.first().map(|first| first.rpm),
            DecidedSpeed::Flutter => report.flutter_rpm,
        }
    }

    /// Its value for a saw without a diagram, in rpm; infinite if it has none.
    pub(super) fn of_onsets(self, onsets: &Onsets) -> f64 {
        let found = match self {
            DecidedSpeed::FirstCritical => onsets.first_critical_rad_per_s,
            DecidedSpeed::Flutter => onsets.flutter_speed_rad_per_s,
        };
        found.map_or(f64::INFINITY, rpm)
    }

    /// Its relative change by a sensitivity, in percent.
    pub(super) fn percent(self, by: &Sensitivity) -> Option<f64> {
        match self {
            DecidedSpeed::FirstCritical => by.of_first_critical(),
            DecidedSpeed::Flutter => by.flutter_speed_percent,
        }
    }
}

/// A speed that decides on a saw, in one condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "DecisiveSpeedEntry")]
pub struct DecisiveSpeed {
    /// The speed.
    pub speed: DecidedSpeed,
    /// Condition of the saw: "idling", or "in the cut at 1800 rpm (3.77 teeth)".
    pub condition: String,
    /// Its value; null if the sweep contains none.
    pub rpm: Option<f64>,
    /// Distance above the operating speed, negative below it; null without one of both.
    pub margin_rpm: Option<f64>,
    /// Change of the speed by usual tolerances of production, to first order: the root of the sum of the squares of the changes by each
    /// number. Null if the speed has no derivative.
    pub tolerance_rpm: Option<f64>,
}

impl DecisiveSpeed {
    /// Both speeds of an analysis.
    pub(super) fn of(report: &Report) -> [Self; 2] {
        [DecidedSpeed::FirstCritical, DecidedSpeed::Flutter].map(|speed| {
            let rpm = speed.rpm(report);
            let operating = report.operating.as_ref().map(|operating| operating.rpm);
            DecisiveSpeed {
                speed,
                condition: report.condition.clone(),
                rpm,
                margin_rpm: rpm.zip(operating).map(|(rpm, operating)| rpm - operating),
                tolerance_rpm: rpm.and_then(|rpm| Some(rpm * tolerated_share(report, speed)?)),
            }
        })
    }
}

/// Relative change of a speed by the usual tolerances of all numbers with a sensitivity.
fn tolerated_share(report: &Report, speed: DecidedSpeed) -> Option<f64> {
    let mut square = 0.0;
    for sensitivity in &report.sensitivities {
        let parameter = Parameter::new(&sensitivity.parameter);
        let value = parameter.get(&report.scene).ok()?;
        let steps = Tolerances::USUAL.of(&parameter, value) / sensitivity.step(value);
        let percent = speed.percent(sensitivity)? * steps;
        square += percent * percent;
    }
    Some(1e-2 * f64::sqrt(square))
}
