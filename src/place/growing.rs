//! The map of a search while its saws are computed, for whoever watches.

use std::sync::{Mutex, PoisonError};

use super::map::Map;
use super::outcome::Outcome;
use super::search::{Search, Seen};

/// The goal over two freed numbers as far as it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct GrowingMap {
    /// The map; a cell that is not computed yet has no outcome.
    pub map: Map,
    /// Which cells are computed, one row for each value of y.
    pub is_computed: Vec<Vec<bool>>,
    /// The samples of the bounds, from which the search begins.
    pub samples: Vec<Sample>,
}

/// A saw somewhere between the bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Its numbers along the axes of the map.
    pub at: [f64; 2],
    /// What it is worth; `None` where there is no saw.
    pub outcome: Option<Outcome>,
}

/// Called with the map whenever it has grown.
pub type Watch<'a> = &'a (dyn Fn(&GrowingMap) + Sync);

/// Takes what the threads of a search find into one map.
pub(super) struct Grower<'a> {
    growing: Mutex<GrowingMap>,
    watch: Watch<'a>,
}

impl<'a> Grower<'a> {
    /// With nothing known yet; `points` along each axis.
    pub fn new(search: &Search<'_>, points: usize, watch: Watch<'a>) -> Self {
        // A search without a map has its samples to show, between the bounds.
        let map = Map::unknown(search, points.max(2));
        let growing = GrowingMap {
            is_computed: unknown(&map),
            samples: Vec::new(),
            map,
        };
        Grower {
            growing: Mutex::new(growing),
            watch,
        }
    }

    fn grown(&self, grow: impl FnOnce(&mut GrowingMap)) {
        let mut growing = self.growing.lock().unwrap_or_else(PoisonError::into_inner);
        grow(&mut growing);
        (self.watch)(&growing);
    }

    /// A sample is known.
    pub fn sampled(&self, search: &Search<'_>, seen: &Seen<'_>) {
        self.grown(|growing| {
            let sample = Sample {
                at: growing.map.place_of(search, seen.shares),
                outcome: seen.outcome.cloned(),
            };
            growing.samples.push(sample);
        });
    }

    /// A map is begun, through another saw than the last one: every cell is unknown again.
    pub fn begun(&self, map: &Map) {
        self.grown(|growing| {
            growing.is_computed = unknown(map);
            growing.map = map.clone();
        });
    }

    /// A cell is known.
    pub fn filled(&self, seen: &Seen<'_>) {
        self.grown(|growing| {
            let columns = growing.map.x.len();
            let (row, column) = (seen.index / columns, seen.index % columns);
            growing.map.outcomes[row][column] = seen.outcome.cloned();
            growing.is_computed[row][column] = true;
        });
    }
}

fn unknown(map: &Map) -> Vec<Vec<bool>> {
    vec![vec![false; map.x.len()]; map.y.len()]
}
