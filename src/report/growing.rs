//! The map of a placement while its saws are computed, for the live page.

use super::{GoalEntry, MapEntry};
use crate::place::{Goal, GrowingMap};
use crate::scene::rpm;

/// The part of a map that is known so far.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrowingMapEntry {
    /// The goal.
    pub goal: GoalEntry,
    /// The map; cells that are not computed are empty.
    pub map: MapEntry,
    /// Whether a cell is computed; one row for each value of y.
    pub is_computed: Vec<Vec<bool>>,
    /// Initial samples: position along both axes, and the goal, `None` if there is no saw that keeps the
    /// limit.
    pub samples: Vec<([f64; 2], Option<f64>)>,
}

impl GrowingMapEntry {
    /// The entry for a search.
    pub(crate) fn new(goal: Goal, growing: &GrowingMap) -> Self {
        let samples = growing.samples.iter().map(|sample| {
            let kept = sample.outcome.as_ref().filter(|outcome| outcome.is_kept());
            (sample.at, kept.map(|outcome| rpm(outcome.value_rad_per_s)))
        });
        GrowingMapEntry {
            goal: goal.into(),
            map: MapEntry::from(&growing.map),
            is_computed: growing.is_computed.clone(),
            samples: samples.collect(),
        }
    }
}
