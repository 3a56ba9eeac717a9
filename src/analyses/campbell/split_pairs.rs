//! What a report says of the pairs of waves that slots split.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::scene::rpm;
use crate::stability::Analysis;

/// Results of a slotted blade with other branches of its split pairs than the lower one, for which the critical speeds and bands of the
/// report hold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "SplitPairsEntry")]
pub struct SplitPairs {
    /// Critical speeds within the sweep with the upper branch of every pair, without those that both branches share; ascending.
    pub upper_critical_speeds: Vec<UpperCriticalSpeed>,
    /// Speeds of the sweep at which slots pass guides and the saw is unstable or not certain, unless the Floquet multipliers of `verdict`
    /// decide. For guides that end well inside the slots they are the filled hull of the bands with the lower branch, the mean and the
    /// upper branch, and 1 % beside it; without that hull all speeds above the first critical one. They are all speeds for guides
    /// beside the slots, and for an undamped saw without multipliers. Null if nothing is fixed in space.
    pub not_certain_rpm: Option<Vec<[f64; 2]>>,
}

/// A critical speed of upper branches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "UpperCriticalSpeedEntry")]
pub struct UpperCriticalSpeed {
    /// Rotation speed.
    pub rpm: f64,
    /// The wave that stands still.
    pub name: String,
}

/// Distance of two speeds of one wave of a blade without guides, relative to them: a pair that is not split stands still twice.
const ONE_WAVE: f64 = 1e-6;

impl SplitPairs {
    /// The results of an analysis; `None` without slots.
    pub(super) fn of(analysis: &Analysis) -> Option<Self> {
        let found = analysis.split_pairs.as_ref()?;
        let mut upper_critical_speeds: Vec<UpperCriticalSpeed> = Vec::new();
        for critical in &found.upper_critical {
            let entry = UpperCriticalSpeed {
                rpm: rpm(critical.speed_rad_per_s),
                name: critical.name.in_words(),
            };
            let is_one = |last: &UpperCriticalSpeed| {
                last.name == entry.name && (entry.rpm / last.rpm - 1.0).abs() < ONE_WAVE
            };
            if !upper_critical_speeds.last().is_some_and(is_one) {
                upper_critical_speeds.push(entry);
            }
        }
        let open = analysis.not_certain();
        Some(SplitPairs {
            upper_critical_speeds,
            not_certain_rpm: open.map(|open| open.iter().map(|own| own.ends().map(rpm)).collect()),
        })
    }

    /// The critical speeds of upper branches in words; `None` without any.
    pub(super) fn upper_in_words(&self) -> Option<String> {
        let speeds = self.upper_critical_speeds.iter();
        let speeds: Vec<String> = speeds
            .map(|own| format!("{:.1} rpm ({})", own.rpm, own.name))
            .collect();
        let is_any = !speeds.is_empty();
        is_any.then(|| {
            format!(
                "Critical speeds of the upper branches of pairs that slots split: {}",
                speeds.join(", ")
            )
        })
    }

    /// The speeds that are not certain in words; `None` if there are none.
    pub(super) fn not_certain_in_words(&self) -> Option<String> {
        let open = self.not_certain_rpm.as_ref()?;
        let ranges: Vec<String> = open.iter().map(between).collect();
        let is_any = !ranges.is_empty();
        is_any.then(|| {
            format!(
                "Unstable or not certain, because slots pass guides: {} rpm",
                ranges.join(", ")
            )
        })
    }
}

fn between([from, to]: &[f64; 2]) -> String {
    format!("{from:.0} to {to:.0}")
}
