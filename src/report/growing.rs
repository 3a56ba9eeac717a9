//! The map of a placement while its saws are computed, for the page that draws it.

use super::{GoalEntry, MapEntry};
use crate::place::{Goal, GrowingMap};
use crate::scene::rpm;

/// The map as far as it is known, of a search that goes on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrowingMapEntry {
    /// What is made large.
    pub goal: GoalEntry,
    /// The map; nothing is known yet of the other cells.
    pub map: MapEntry,
    /// Which cells are computed, one row for each value of y.
    pub is_computed: Vec<Vec<bool>>,
    /// The samples from which the search begins: place along both axes, and the goal there, or none
    /// where there is no saw that keeps the limit.
    pub samples: Vec<([f64; 2], Option<f64>)>,
}

impl GrowingMapEntry {
    /// Of a search for a goal.
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
