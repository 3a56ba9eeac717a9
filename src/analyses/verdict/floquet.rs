//! The growth of a slotted saw beside guides, in a verdict.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::scene::rpm;
use crate::page::text::shown_to;
use crate::stability::NearbyGrowth;

/// Growth of a slotted saw beside guides by Floquet multipliers, at the operating speed and 1 % below and above it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FloquetEntry")]
pub struct FloquetEntry {
    /// The three speeds.
    pub speeds_rpm: Vec<f64>,
    /// Largest growth rate ln|μ|/T at each, with the multipliers μ over the time T in which one slot takes the place of the next;
    /// negative if every motion decays.
    pub growth_per_s: Vec<f64>,
    /// Estimated error of each: its change with half as long steps of time, plus three times that with a third of the coordinates left out.
    pub error_per_s: Vec<f64>,
    /// Number of coordinates of the blade.
    pub coordinates: usize,
    /// Number of steps of time in T, at the operating speed.
    pub steps: usize,
}

impl FloquetEntry {
    pub(super) fn new(nearby: &NearbyGrowth) -> Self {
        let at = &nearby.at;
        FloquetEntry {
            speeds_rpm: at.iter().map(|own| rpm(own.speed_rad_per_s)).collect(),
            growth_per_s: at.iter().map(|own| own.growth_per_s).collect(),
            error_per_s: at.iter().map(|own| own.error_per_s).collect(),
            coordinates: at[1].coordinates,
            steps: at[1].steps,
        }
    }

    /// The largest growth in words: "slots pass the guides: by Floquet multipliers at 1980, 2000 and 2020 rpm the largest growth is 0.5 1/s".
    pub(crate) fn in_words(&self) -> String {
        let speeds: Vec<String> = self.speeds_rpm.iter().map(|x| shown_to(6, *x)).collect();
        let rates = self.growth_per_s.iter().copied();
        let largest = rates.fold(f64::NEG_INFINITY, f64::max);
        let found = if largest > NEUTRAL_PER_S {
            format!("the largest growth is {} 1/s", shown_to(3, largest))
        } else if largest < -NEUTRAL_PER_S {
            format!(
                "every motion decays, the slowest by {} 1/s",
                shown_to(3, -largest)
            )
        } else {
            "no motion grows".to_owned()
        };
        format!(
            "slots pass the guides: by Floquet multipliers at {} rpm {found}",
            speeds.join(", ")
        )
    }
}

/// Growth rate below which a motion neither grows nor decays: rounding of double multipliers.
const NEUTRAL_PER_S: f64 = 1e-3;
